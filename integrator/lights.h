// All light sources of a scene: emissive triangles, rectangles, spheres, punctual and infinite
// lights, sampled by their estimated contribution at the receiving point.
#pragma once

#include <cstdint>
#include <vector>

#include "integrator/environment_light.h"
#include "integrator/light_tree.h"
#include "integrator/traced_scene.h"

namespace lumivec {

enum class EmitterKind : std::uint8_t { triangle, rectangle, sphere, ellipsoid, point, spot, beam };

// A light of finite position, traced space.
struct Emitter {
  EmitterKind kind = EmitterKind::triangle;
  bool two_sided = false;
  bool varying = false;                      // radiance or opacity depends on the point
  int instance = -1;                         // Scene::instances; -1 for punctual lights
  unsigned primitive = 0;                    // triangle: of the mesh
  V3f origin{0.0f};                          // first corner; centre; position
  V3f edge_u{0.0f}, edge_v{0.0f};            // triangle, rectangle; spot, beam: edge_u is the axis
  float radius = 0.0f;                       // sphere
  float cos_inner = 1.0f, cos_outer = 0.0f;  // spot
  float error = 0.0f;                        // how far shadow rays must end before its surface
  bool light_traced = false;                 // caustics from here are left to light paths
  Color emission{0.0f};          // mean radiance, cd·m⁻²; punctual: intensity, cd, or
                                 // that of light
  const Light* light = nullptr;  // punctual: what it was made from
};

// A light so far away that its rays are parallel.
struct DirectionalLight {
  V3f direction;      // unit, toward the light
  Color illuminance;  // on a facing surface, lx
  bool casts_shadows = true;
};

// The ramp between a spot's cones, [0, 1]; direction: unit, away from the light
// (KHR_lights_punctual).
float spot_falloff(const Emitter& spot, const V3f& direction);

// Illuminance of a facing surface at a distance (> 0, scene units) by a punctual light's intensity.
float faded(const Light& light, float distance);

// From the middle of a light to the point where shadow rays to it end, by random numbers in [0, 1).
V3f shadow_offset(const Light& light, const V2f& u);

// One way in which light may reach the receiving point, unoccluded.
struct LightSample {
  V3f direction;  // unit, from the receiving point
  V3f target;     // end of the shadow ray, traced space; infinite lights: a direction to far away
  float distance = 0.0f;  // scene units; inf for infinite lights
  Color radiance;  // cd·m⁻² from that direction; delta lights: illuminance, lx, on a facing surface
  float pdf = 0.0f;  // sr⁻¹, including the choice of the light; delta lights: the choice alone
  bool light_traced = false;  // its caustics are left to light paths
  bool delta = false;         // no scattered ray can find this light
  bool environment = false;
  bool shadowed = true;  // false: nothing is in its way
};

class Lights {
 public:
  // The traced scene must outlive this.
  explicit Lights(const TracedScene& scene);

  bool empty() const { return emitters_.empty() && directional_.empty() && environment_.black(); }
  // Whether there is no light but the environment.
  bool environment_alone() const { return emitters_.empty() && directional_.empty(); }
  // Punctual and directional lights: scattered rays cannot find them.
  bool has_delta() const { return has_delta_; }

  // Draws a light and a point on it. p in traced space; normal: of the receiving surface if light
  // from its other side cannot matter, else (0, 0, 0). False: nothing to sample there.
  bool sample(const V3f& p, const V3f& normal, float u_light, const V2f& u,
              LightSample& sample) const;

  // Density with which sample() at p finds the emissive surface point hit, sr⁻¹; 0 if it never
  // does.
  float pdf(const V3f& p, const V3f& normal, const SurfacePoint& hit) const;
  float pdf_environment(const V3f& p, const V3f& normal, const V3f& direction) const;

  // Where shadow rays from p end that go to something infinitely far away; direction: unit.
  V3f far_along(const V3f& p, const V3f& direction) const;

  const EnvironmentLight& environment() const { return environment_; }
  const std::vector<Emitter>& emitters() const { return emitters_; }
  const std::vector<DirectionalLight>& directional() const { return directional_; }

  // Leaves the caustics of punctual and small lights and of the environment's brightest parts to
  // light paths (light_tracer.h); of the whole environment too, and of large lights unless they are
  // too many, if these bring photons (photon_map.h).
  void leave_caustics_to_light_paths(bool of_large_lights);
  bool leaves_caustics() const { return leaves_caustics_; }
  // Whether that holds for all lights there are.
  bool leaves_all_caustics() const;
  // Whether the emissive surface hit is one of those.
  bool light_traced(const SurfacePoint& hit) const;
  // Whether what arrives from a unit direction of the environment is.
  bool environment_light_traced(const V3f& direction) const;
  // The share of the environment's light that is, or a little more.
  float environment_light_traced_share() const;

 private:
  // Probabilities of drawing from the tree, the environment, and each directional light.
  struct Shares {
    float tree = 0.0f, environment = 0.0f, directional_scale = 0.0f;
  };

  void add_instance(int instance);
  void add_mesh(int instance, const Material& material);
  void add_sphere(int instance, const Material& material);
  void add_light(const Light& light);
  void add(const Emitter& emitter, const LightBounds& bounds);
  Shares shares(const V3f& p, const V3f& normal) const;
  float directional_weight(const DirectionalLight& light, const V3f& normal) const;
  bool sample_emitter(const Emitter& emitter, const V3f& p, const V2f& u,
                      LightSample& sample) const;
  int emitter_of(const SurfacePoint& hit) const;
  float emitter_pdf(const Emitter& emitter, const V3f& p, const SurfacePoint& hit) const;

  const TracedScene& scene_;
  EnvironmentLight environment_;
  std::vector<Emitter> emitters_;
  std::vector<LightBounds> bounds_;  // emptied after the tree is built
  std::vector<DirectionalLight> directional_;
  LightTree tree_;
  std::vector<std::int64_t>
      first_triangle_;  // by instance: offset into triangle_emitter_; sphere: emitter; -1: none
  std::vector<int> triangle_emitter_;  // emitter of each triangle of emissive meshes; -1: none
  bool has_delta_ = false;
  bool leaves_caustics_ = false;
  bool leaves_environment_ = false;  // the whole of it
};

}  // namespace lumivec
