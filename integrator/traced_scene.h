// A Scene made ready for ray tracing: Embree geometry, and from Embree's hits back to surfaces and
// materials.
//
// Meshes that are used once, or are small, are stored in traced space at the top level; others
// become Embree instances. Spheres under similarity transforms become sphere points (one geometry
// for all); other spheres, instanced ones; solids are one user geometry. The Scene must outlive
// this. Immutable after
// construction; all queries may run at once from many threads.
#pragma once

#include <ImathBox.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "integrator/embree_api.h"
#include "integrator/ray_packet.h"
#include "integrator/solid_boundaries.h"
#include "integrator/surface.h"
#include "loader/scene.h"

namespace lumivec {

// What Embree says of a hit.
struct RayHit {
  float distance = 0.0f;
  float u = 0.0f, v = 0.0f;
  unsigned geometry = RTC_INVALID_GEOMETRY_ID;
  unsigned primitive = 0;
  unsigned instance = RTC_INVALID_GEOMETRY_ID;
  bool valid() const { return geometry != RTC_INVALID_GEOMETRY_ID; }
};

// Embree's context with what the opacity filters need; lanes are told apart by RTCRay::id.
struct TraceQuery {
  embree::QueryContext context;  // first, so that the filters find the rest behind it
  const class TracedScene* scene = nullptr;
  const std::uint32_t* seeds = nullptr;  // per lane; decides where partly opaque surfaces are hit
  Color* transmittance =
      nullptr;  // per lane, occlusion only: multiplied by thin walls that were passed
  std::uint8_t* passed_thin =
      nullptr;  // per lane, occlusion only: set where a thin wall was passed
};

// What is fixed about one instance.
struct TracedInstance {
  const Mesh* mesh = nullptr;     // null: sphere or solid
  const V3f* vertices = nullptr;  // of the mesh; traced space if flattened, else object space
  const Material* material = nullptr;
  int constant = -1;  // index into the parameters of materials without textures; -1: look them up
  bool flattened = false;
  bool mirrored = false;
  bool flat_shaded = true;  // vertex normals are missing or equal to the geometric ones
  int transform = -1;       // index of its Transforms; -1 for similarity spheres
  int sphere = -1;          // index into spheres(), similarity spheres only
  int solid = -1;           // index into solids()
  RayMask seen_by = all_rays;
};

struct TracedSphere {
  V3f center;  // traced space
  float radius = 0.0f;
};

class TracedScene {
 public:
  // What the next state of a scene that changes takes over, so that places in traced space stay
  // what they are.
  struct Frame {
    V3d origin{0.0};
    float radius = 1.0f;
    std::vector<float> indices;  // of refraction, of all materials
    std::shared_ptr<const AlbedoTables> albedo_tables;
  };

  // threads: for building. Throws RenderError if Embree refuses the scene (memory).
  TracedScene(const Scene& scene, int threads, const Frame* frame = nullptr);
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  const Scene& scene() const { return scene_; }
  const V3d& origin() const { return origin_; }  // world-space position of traced space's origin
  float radius() const {
    return radius_;
  }  // of a sphere around traced space's origin that holds the scene
  Frame frame() const { return {origin_, radius_, indices_, albedo_tables_}; }
  // Around each instance, traced space; empty for those that are not visible.
  const std::vector<Imath::Box3f>& bounds() const { return bounds_; }
  RTCScene handle() const { return top_.get(); }
  // Whether anything has partial opacity or thin walls, or is hidden from some rays, so that
  // queries need seeds.
  bool has_filters() const { return has_filters_; }

  const std::vector<TracedInstance>& instances() const { return instances_; }
  const std::vector<TracedSphere>& spheres() const { return spheres_; }
  // Hits on them have the index here as their primitive, and the leaf as u.
  const std::vector<TracedSolid>& solids() const { return solids_; }
  bool solid_has_filter(unsigned solid) const {
    return filtered(instances_[std::size_t(solid_instances_[solid])]);
  }
  // Index into Scene::instances of what was hit.
  int instance_of(const RayHit& hit) const;

  // The nearest hit of one ray origin + t · direction, near ≤ t ≤ far. seed: as in TraceQuery.
  RayHit intersect(const V3f& origin, const V3f& direction, float near, float far,
                   std::uint32_t seed, RayMask mask = all_rays) const;

  // The surface at a hit of the ray origin + t · direction.
  SurfacePoint surface(const RayHit& hit, const V3f& origin, const V3f& direction) const;

  // The side that a hit's surface faces, traced space, not unit, from Embree's normal of the hit.
  V3f outward_normal(int instance, const V3f& embree_normal) const {
    const TracedInstance& i = instances_[std::size_t(instance)];
    if (i.sphere >= 0 || i.solid >= 0) return embree_normal;
    if (i.flattened) return i.mirrored ? -embree_normal : embree_normal;
    return embree_normal * transforms_[std::size_t(i.transform)].normal;
  }

  // The three corners of a triangle of a mesh instance, traced space.
  std::array<V3f, 3> triangle(int instance, unsigned primitive) const;

  M44d object_to_traced(int instance) const;

  // Texture coordinates of a surface point; (0, 0) where the mesh has no such set.
  V2f uv(const SurfacePoint& point, int set) const;

  // The opacity of the material at a point, [0, 1], masks already compared.
  float opacity(const SurfacePoint& point) const;

  // Radiance that the surface emits toward the side the ray came from.
  Color emission(const SurfacePoint& point) const;

  // The material at the point with its textures and normal maps. outside_ior: index of the medium
  // on the front side.
  SurfaceParameters parameters(const SurfacePoint& point, float outside_ior) const;

  // Share of the light from wo's side that passes straight through a smooth thin wall; 0 for all
  // other surfaces.
  Color thin_transmittance(const SurfacePoint& point, const V3f& wo) const;

  const AlbedoTables& albedo_tables() const { return *albedo_tables_; }

  TraceQuery query() const;

 private:
  struct Transforms {
    Imath::M44f object_to_traced;
    Imath::M44f traced_to_object;
    M33f normal;  // row vector n · normal is the traced-space normal, not unit
    float scale;  // largest stretch of object space
  };
  // What a geometry of the top level stands for.
  struct Slot {
    enum class Kind : std::uint8_t { mesh, spheres, solids, instance } kind = Kind::mesh;
    int instance = -1;  // mesh, instance
  };

  PatternedSurface patterned(const SurfacePoint& point) const;
  V3f bent_normal(const SurfacePoint& point) const;
  SurfaceParameters appearance(const SurfacePoint& point) const;
  void prepare_constants();
  void place(const Frame* frame);
  void add_mesh(int instance);
  void add_sphere(int instance);
  void add_instance(int instance, RTCScene base);
  void add_solid(int instance);
  void finish_spheres();
  void finish_solids();
  RTCScene base_scene(int mesh);
  RTCGeometry mesh_geometry(const TracedInstance& instance, const V3f* vertices);
  void attach(RTCGeometry geometry, Slot slot);
  void use_filters(RTCGeometry geometry);
  bool filtered(const TracedInstance& instance) const;
  SurfacePoint solid_surface(const TracedSolid& solid, const RayHit& hit, const V3f& origin,
                             const V3f& direction) const;
  SurfacePoint sphere_surface(const TracedSphere& sphere, const V3f& origin, const V3f& direction,
                              float distance) const;
  V3f mapped_normal(const SurfacePoint& point, const TextureMap& map, float scale,
                    const V3f& normal) const;
  V4f vertex_color(const SurfacePoint& point) const;

  const Scene& scene_;
  V3d origin_{0.0};
  float radius_ = 1.0f;
  bool has_filters_ = false;
  embree::Device device_;
  embree::SceneHandle top_;
  std::vector<TracedInstance> instances_;
  std::vector<Transforms> transforms_;
  std::vector<TracedSphere> spheres_;
  std::vector<int> sphere_instances_;  // TracedSphere to Scene::instances
  std::vector<TracedSolid> solids_;
  std::vector<int> solid_instances_;              // likewise
  std::vector<SurfaceParameters> constants_;      // by material, for those that do not vary
  std::vector<Slot> slots_;                       // by geometry id of the top level
  std::vector<embree::SceneHandle> base_meshes_;  // by mesh, where instanced
  std::vector<const V3f*> base_vertices_;         // likewise
  std::vector<std::uint32_t> uses_;               // of each mesh
  embree::SceneHandle base_sphere_;               // unit sphere at the origin, for ellipsoids
  std::vector<Imath::Box3f> bounds_;
  std::vector<float> indices_;  // of refraction, of all materials
  std::shared_ptr<const AlbedoTables> albedo_tables_;
};

}  // namespace lumivec
