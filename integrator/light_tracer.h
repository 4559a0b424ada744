// Light paths for what eye paths find badly or never: light from punctual and small lights and from
// the environment's brightest parts that comes to a non-specular surface over specular ones,
// E … D S+ L; and what comes to a broad lobe over glossy and specular ones, and from there to the
// eye from a broad lobe, E B (… B)? (G|S)+ L, in which B and G are the two kinds of D (bsdf.h).
// Paths start at the light toward surfaces that have such lobes, and each later vertex is connected
// to the eye.
//
// The division of labour is exact: eye paths leave out just these paths (Lights::light_traced and
// environment_light_traced; straight passage through a thin wall does not count as an S event).
// What neither finds is light from a punctual light over a specular surface that the eye sees only
// in another specular surface, E S … D S+ L. Source: Veach 1997, sections 4 and 5 (particle
// tracing, shading normals).
#pragma once

#include <cstdint>
#include <vector>

#include "integrator/camera_view.h"
#include "integrator/framebuffer.h"
#include "integrator/lights.h"
#include "integrator/photon_map.h"
#include "integrator/pixel_filter.h"

namespace lumivec {

// A contribution to one pixel.
struct Splat {
  std::uint32_t pixel = 0;
  Term term = Term::caustic;
  Color value{0.0f};  // radiance, to be divided by the number of light paths
};

struct BoundingSphere {
  V3f center{0.0f};  // traced space
  float radius = 0.0f;
  float worth = 1.0f;  // of a path toward it, relative to others at the same solid angle
};

// Spheres around everything that may have specular or glossy lobes; near ones are joined until
// there are few.
std::vector<BoundingSphere> caustic_casters(const TracedScene& scene, float specular_roughness);

class LightTracer {
 public:
  // casters: from caustic_casters. All must outlive this.
  LightTracer(const TracedScene& scene, const Lights& lights, const CameraView& camera,
              const RenderSettings& settings, const std::vector<BoundingSphere>& casters);

  // Whether there is anything to do: lights to start from, casters to aim at, and terms that ask
  // for it.
  bool active() const { return !sources_.empty(); }

  // Traces light paths [first, first + count) and appends what they bring to splats. Depends on
  // nothing else.
  void trace(std::uint64_t first, std::uint32_t count, std::vector<Splat>& splats,
             RenderStatistics& statistics) const;

  // Likewise what they bring to the caches: photons where light lands on a non-specular lobe over
  // specular ones, and on a broad lobe over specular and glossy ones. Paths end at broad lobes.
  void trace(std::uint64_t first, std::uint32_t count, std::vector<Photon>& photons,
             RenderStatistics& statistics) const;

 private:
  struct Source {
    int emitter = -1;      // of Lights::emitters; -1: none of them
    int directional = -1;  // of Lights::directional; -1, like emitter: the environment
    float probability = 0.0f;
    float cumulative = 0.0f;
    std::vector<float> aim;  // probability of aiming at each caster
  };
  struct Start {
    V3f origin, direction;
    Color flux;  // radiance · cosine / density, or its analogue for punctual lights
    const Light* light = nullptr;  // punctual: where it fades in its own way
  };

  // Whether eye paths leave a path to light paths that goes on to the eye by a lobe of the kind.
  struct Covered {
    bool broad = false, glossy = false;
  };

  // A vertex of a light path from which the eye is looked for.
  struct Arrival {
    const SurfacePoint& point;
    V3f shading_normal;
    const Bsdf& bsdf;
    V3f wo;  // to where the light comes from
    Color flux;
    const Material* medium;  // that the path runs through; null: none
    Term term;
    Covered covered;
    std::uint32_t seed;
    int events;  // of scattering before
  };

  void add_source(Source source, float intensity, const V3f& position);
  // Of a light infinitely far away. illuminance: mean of the channels, lx.
  void add_distant_source(Source source, float illuminance);
  bool start(float u_source, const V2f& u_point, float u_aim, const V2f& u_direction,
             Start& start) const;
  // A path from unit direction toward_light. illuminance: across the beam, over the density with
  // which the direction was drawn.
  bool start_distant(const Source& source, const V3f& toward_light, const Color& illuminance,
                     float u_aim, const V2f& u, Start& start) const;
  bool aim(const Source& source, const V3f& origin, float u_aim, const V2f& u, V3f& direction,
           float& pdf) const;
  // past_broad: whether the path goes on by broad lobes.
  template <typename Arrive>
  void trace_path(std::uint64_t path, bool past_broad, RenderStatistics& statistics,
                  const Arrive& arrive) const;
  bool visible_to_eye(const SurfacePoint& point, const V3f& to_eye, float distance,
                      std::uint32_t seed, RenderStatistics& statistics) const;
  void connect(const Arrival& arrival, std::vector<Splat>& splats,
               RenderStatistics& statistics) const;

  const TracedScene& scene_;
  const Lights& lights_;
  const CameraView& camera_;
  const RenderSettings settings_;
  const std::vector<BoundingSphere>& casters_;
  PixelFilterSampler filter_;
  std::vector<Source> sources_;
};

}  // namespace lumivec
