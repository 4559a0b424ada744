#include "integrator/traced_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "integrator/opacity.h"
#include "integrator/render.h"
#include "integrator/solid_geometry.h"

namespace lumivec {
namespace {

// Meshes that are used several times are still flattened up to this many triangles in all: a second
// level of the hierarchy costs every ray more than these triangles cost memory.
constexpr std::size_t max_flattened_triangles = 1u << 16;

// Above this many triangles, memory comes before speed: the compact hierarchy keeps the peak below
// three times the raw geometry (else nearly five times), and costs packets of rays about a tenth.
constexpr std::size_t max_fast_triangles = 1u << 19;

// Robust, because a ray that slips through an edge lights the dark side of a wall.
RTCSceneFlags scene_flags(const Scene& scene) {
  std::size_t triangles = 0;
  for (const Mesh& mesh : scene.meshes) triangles += mesh.triangles.size();
  const bool compact = triangles > max_fast_triangles;
  return static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                    (compact ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE));
}

// Uneven scale below this is rounding, not intent.
constexpr double similarity_tolerance = 1e-5;

// The factor by which a similarity scales lengths; 0 if the transform is none.
double similarity_scale(const M44d& m) {
  const V3d x(m[0][0], m[0][1], m[0][2]);
  const V3d y(m[1][0], m[1][1], m[1][2]);
  const V3d z(m[2][0], m[2][1], m[2][2]);
  const double s2 = x.length2();
  const double tolerance = similarity_tolerance * s2;
  const bool even = std::abs(y.length2() - s2) <= 2.0 * tolerance &&
                    std::abs(z.length2() - s2) <= 2.0 * tolerance;
  const bool right_angles = std::abs(x.dot(y)) <= tolerance && std::abs(y.dot(z)) <= tolerance &&
                            std::abs(z.dot(x)) <= tolerance;
  return even && right_angles ? std::sqrt(s2) : 0.0;
}

double determinant3(const M44d& m) {
  const V3d x(m[0][0], m[0][1], m[0][2]);
  const V3d y(m[1][0], m[1][1], m[1][2]);
  const V3d z(m[2][0], m[2][1], m[2][2]);
  return x.cross(y).dot(z);
}

const Material& default_material() {
  static const Material material;
  return material;
}

bool has_flat_normals(const Mesh& mesh) {
  if (mesh.normals.empty()) return true;
  constexpr float same_direction = 1.0f - 1e-6f;
  for (const Imath::Vec3<std::uint32_t>& t : mesh.triangles) {
    const V3f& a = mesh.positions[t.x];
    const V3f face = (mesh.positions[t.y] - a).cross(mesh.positions[t.z] - a).normalized();
    for (const std::uint32_t corner : {t.x, t.y, t.z}) {
      if (!(mesh.normals[corner].dot(face) > same_direction)) return false;
    }
  }
  return true;
}

struct Bounds {
  V3d min{std::numeric_limits<double>::infinity()};
  V3d max{-std::numeric_limits<double>::infinity()};
  void extend(const V3d& p) {
    for (int i = 0; i < 3; ++i) {
      min[i] = std::min(min[i], p[i]);
      max[i] = std::max(max[i], p[i]);
    }
  }
  bool empty() const { return min.x > max.x; }
};

Bounds object_bounds(const Scene& scene, const Instance& instance) {
  Bounds bounds;
  if (instance.sphere >= 0) {
    const double r = scene.spheres[std::size_t(instance.sphere)].radius;
    bounds.extend(V3d(-r));
    bounds.extend(V3d(r));
  } else if (instance.solid >= 0) {
    const Imath::Box3d& box = scene.solids[std::size_t(instance.solid)].bounds;
    bounds.extend(box.min);
    bounds.extend(box.max);
  } else {
    for (const V3f& p : scene.meshes[std::size_t(instance.mesh)].positions) bounds.extend(V3d(p));
  }
  return bounds;
}

// The error callback only keeps the first message: exceptions must not cross Embree's frames.
void note_error(void* user, RTCError, const char* message) {
  auto& text = *static_cast<std::string*>(user);
  if (text.empty()) text = message ? message : "unknown error";
}

RayMask seen_by(const Instance& instance) {
  RayMask mask = all_rays;
  if (!instance.seen_by_eye) mask &= ~eye_ray;
  if (!instance.seen_in_reflections) mask &= ~mirror_ray;
  if (!instance.casts_shadows) mask &= ~shadow_ray;
  return mask;
}

}  // namespace

TracedScene::TracedScene(const Scene& scene, int threads, const Frame* frame) : scene_(scene) {
  std::string failure;
  device_.reset(
      rtcNewDevice(threads > 0 ? ("threads=" + std::to_string(threads)).c_str() : nullptr));
  if (!device_) throw RenderError("Embree cannot start on this processor; it needs SSE2 or NEON");
  rtcSetDeviceErrorFunction(device_.get(), note_error, &failure);
  top_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(top_.get(), scene_flags(scene));

  for (const Material& material : scene.materials) indices_.push_back(material.ior);
  indices_.push_back(default_material().ior);
  if (frame && frame->indices == indices_) {
    albedo_tables_ = frame->albedo_tables;
  } else {
    albedo_tables_ = std::make_shared<AlbedoTables>(indices_);
  }

  place(frame);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const int instance = static_cast<int>(i);
    if (!scene.instances[i].visible) continue;
    if (scene.instances[i].sphere >= 0) {
      add_sphere(instance);
    } else if (scene.instances[i].solid >= 0) {
      add_solid(instance);
    } else {
      add_mesh(instance);
    }
  }
  finish_spheres();
  finish_solids();
  prepare_constants();
  rtcCommitScene(top_.get());
  rtcSetDeviceErrorFunction(device_.get(), nullptr, nullptr);
  if (!failure.empty()) {
    throw RenderError("the scene cannot be prepared for ray tracing (" + failure +
                      "); it may need more memory than there is");
  }
}

// Finds the origin of traced space if it is not given, and counts how often each mesh is used.
void TracedScene::place(const Frame* frame) {
  uses_.assign(scene_.meshes.size(), 0);
  std::vector<Bounds> mesh_bounds(scene_.meshes.size());
  std::vector<Bounds> around(scene_.instances.size());
  Bounds world;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Instance& instance = scene_.instances[i];
    if (!instance.visible) continue;
    Bounds object;
    if (instance.mesh >= 0) {
      const auto mesh = std::size_t(instance.mesh);
      if (uses_[mesh]++ == 0) mesh_bounds[mesh] = object_bounds(scene_, instance);
      object = mesh_bounds[mesh];
    } else {
      object = object_bounds(scene_, instance);
    }
    if (object.empty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const V3d p((corner & 1) ? object.max.x : object.min.x,
                  (corner & 2) ? object.max.y : object.min.y,
                  (corner & 4) ? object.max.z : object.min.z);
      around[i].extend(p * instance.object_to_world);
    }
    world.extend(around[i].min);
    world.extend(around[i].max);
  }
  if (frame) {
    origin_ = frame->origin;
    radius_ = frame->radius;
  } else if (!world.empty()) {
    origin_ = (world.min + world.max) * 0.5;
    radius_ = std::max(static_cast<float>((world.max - origin_).length()),
                       std::numeric_limits<float>::min());
  }
  for (const Bounds& b : around) {
    bounds_.emplace_back();
    if (!b.empty()) bounds_.back() = Imath::Box3f(V3f(b.min - origin_), V3f(b.max - origin_));
  }
  base_meshes_.resize(scene_.meshes.size());
  base_vertices_.resize(scene_.meshes.size(), nullptr);
  instances_.resize(scene_.instances.size());
}

M44d TracedScene::object_to_traced(int instance) const {
  M44d m = scene_.instances[std::size_t(instance)].object_to_world;
  for (int i = 0; i < 3; ++i) m[3][i] -= origin_[i];
  return m;
}

bool TracedScene::filtered(const TracedInstance& instance) const {
  const Material& material = *instance.material;
  return instance.seen_by != all_rays || material.alpha_mode != AlphaMode::opaque ||
         (material.transmission > 0.0f && material.thin_walled && !material.unlit);
}

void TracedScene::use_filters(RTCGeometry geometry) {
  has_filters_ = true;
  rtcSetGeometryIntersectFilterFunction(geometry, filter_intersection);
  rtcSetGeometryOccludedFilterFunction(geometry, filter_occlusion);
}

// Commits geometry, hands it to the top level, and notes what its id stands for.
void TracedScene::attach(RTCGeometry geometry, Slot slot) {
  rtcCommitGeometry(geometry);
  const unsigned id = rtcAttachGeometry(top_.get(), geometry);
  rtcReleaseGeometry(geometry);
  if (slots_.size() <= id) slots_.resize(std::size_t(id) + 1);
  slots_[id] = slot;
}

void TracedScene::add_mesh(int instance) {
  const Instance& placed = scene_.instances[std::size_t(instance)];
  const auto mesh_index = std::size_t(placed.mesh);
  const Mesh& mesh = scene_.meshes[mesh_index];
  TracedInstance& traced = instances_[std::size_t(instance)];
  traced.mesh = &mesh;
  traced.material =
      placed.material >= 0 ? &scene_.materials[std::size_t(placed.material)] : &default_material();
  traced.seen_by = seen_by(placed);
  traced.mirrored = determinant3(placed.object_to_world) < 0.0;
  traced.flat_shaded = has_flat_normals(mesh);
  if (mesh.triangles.empty()) return;

  const M44d m = object_to_traced(instance);
  const M44d inverse = m.inverse();
  Transforms transforms;
  transforms.object_to_traced = Imath::M44f(m);
  transforms.traced_to_object = Imath::M44f(inverse);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      transforms.normal[row][column] = static_cast<float>(inverse[column][row]);
  }
  double stretch = 0.0;
  for (int row = 0; row < 3; ++row) stretch += V3d(m[row][0], m[row][1], m[row][2]).length2();
  transforms.scale = static_cast<float>(std::sqrt(stretch));
  traced.transform = static_cast<int>(transforms_.size());
  transforms_.push_back(transforms);

  traced.flattened = uses_[mesh_index] == 1 ||
                     mesh.triangles.size() * uses_[mesh_index] <= max_flattened_triangles;
  if (!traced.flattened) {
    add_instance(instance, base_scene(placed.mesh));
    traced.vertices = base_vertices_[mesh_index];
    return;
  }
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<V3f*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(V3f), mesh.positions.size()));
  if (!vertices)
    throw RenderError("not enough memory for the vertices of mesh '" + mesh.name + "'");
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    vertices[i] = V3f(V3d(mesh.positions[i]) * m);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, 3 * sizeof(std::uint32_t),
                             mesh.triangles.size());
  traced.vertices = vertices;
  if (filtered(traced)) use_filters(geometry);
  attach(geometry, {Slot::Kind::mesh, instance});
}

// The lower level of an instanced mesh, made when first asked for.
RTCScene TracedScene::base_scene(int mesh_index) {
  embree::SceneHandle& base = base_meshes_[std::size_t(mesh_index)];
  if (base) return base.get();
  const Mesh& mesh = scene_.meshes[std::size_t(mesh_index)];
  base.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(base.get(), scene_flags(scene_));
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<V3f*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(V3f), mesh.positions.size()));
  if (!vertices)
    throw RenderError("not enough memory for the vertices of mesh '" + mesh.name + "'");
  std::copy(mesh.positions.begin(), mesh.positions.end(), vertices);
  base_vertices_[std::size_t(mesh_index)] = vertices;
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, 3 * sizeof(std::uint32_t),
                             mesh.triangles.size());
  // The instances of a mesh may differ in material: the filters look at the instance that was hit.
  const bool any_filtered =
      std::any_of(scene_.instances.begin(), scene_.instances.end(), [&](const Instance& i) {
        TracedInstance like;
        like.material =
            i.material >= 0 ? &scene_.materials[std::size_t(i.material)] : &default_material();
        like.seen_by = seen_by(i);
        return i.mesh == mesh_index && filtered(like);
      });
  if (any_filtered) use_filters(geometry);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(base.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(base.get());
  return base.get();
}

void TracedScene::add_instance(int instance, RTCScene base) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, base);
  rtcSetGeometryTimeStepCount(geometry, 1);
  const Imath::M44f& m =
      transforms_[std::size_t(instances_[std::size_t(instance)].transform)].object_to_traced;
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, m.getValue());
  attach(geometry, {Slot::Kind::instance, instance});
}

void TracedScene::add_sphere(int instance) {
  const Instance& placed = scene_.instances[std::size_t(instance)];
  const float radius = scene_.spheres[std::size_t(placed.sphere)].radius;
  TracedInstance& traced = instances_[std::size_t(instance)];
  traced.material =
      placed.material >= 0 ? &scene_.materials[std::size_t(placed.material)] : &default_material();
  traced.seen_by = seen_by(placed);
  traced.mirrored = determinant3(placed.object_to_world) < 0.0;
  traced.flat_shaded = false;
  const M44d m = object_to_traced(instance);
  if (const double scale = similarity_scale(m); scale > 0.0) {
    traced.sphere = static_cast<int>(spheres_.size());
    spheres_.push_back({V3f(V3d(m[3][0], m[3][1], m[3][2])), static_cast<float>(scale * radius)});
    sphere_instances_.push_back(instance);
    return;
  }
  // An ellipsoid: the unit sphere under the transform times the radius.
  M44d unit = m;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) unit[row][column] *= radius;
  }
  const M44d inverse = unit.inverse();
  Transforms transforms;
  transforms.object_to_traced = Imath::M44f(unit);
  transforms.traced_to_object = Imath::M44f(inverse);
  double stretch = 0.0;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      transforms.normal[row][column] = static_cast<float>(inverse[column][row]);
      stretch += unit[row][column] * unit[row][column];
    }
  }
  transforms.scale = static_cast<float>(std::sqrt(stretch));
  traced.transform = static_cast<int>(transforms_.size());
  transforms_.push_back(transforms);
  if (!base_sphere_) {
    base_sphere_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(base_sphere_.get(), RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* vertex = static_cast<V4f*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT4, sizeof(V4f), 1));
    if (!vertex) throw RenderError("not enough memory for a sphere");
    *vertex = V4f(0.0f, 0.0f, 0.0f, 1.0f);
    use_filters(geometry);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(base_sphere_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(base_sphere_.get());
  }
  add_instance(instance, base_sphere_.get());
}

void TracedScene::finish_spheres() {
  if (spheres_.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* vertices = static_cast<V4f*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(V4f), spheres_.size()));
  if (!vertices)
    throw RenderError("not enough memory for " + std::to_string(spheres_.size()) + " spheres");
  bool any_filtered = false;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const TracedSphere& s = spheres_[i];
    vertices[i] = V4f(s.center.x, s.center.y, s.center.z, s.radius);
    any_filtered = any_filtered || filtered(instances_[std::size_t(sphere_instances_[i])]);
  }
  if (any_filtered) use_filters(geometry);
  attach(geometry, {Slot::Kind::spheres, -1});
}

void TracedScene::add_solid(int instance) {
  const Instance& placed = scene_.instances[std::size_t(instance)];
  TracedInstance& traced = instances_[std::size_t(instance)];
  traced.material =
      placed.material >= 0 ? &scene_.materials[std::size_t(placed.material)] : &default_material();
  traced.seen_by = seen_by(placed);
  traced.mirrored = determinant3(placed.object_to_world) < 0.0;
  traced.flat_shaded = false;
  traced.solid = static_cast<int>(solids_.size());
  solids_.emplace_back(scene_.solids[std::size_t(placed.solid)], placed.solid_part,
                       object_to_traced(instance));
  solid_instances_.push_back(instance);
}

void TracedScene::finish_solids() {
  if (solids_.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  set_solids(geometry, *this);
  for (const int instance : solid_instances_)
    has_filters_ = has_filters_ || filtered(instances_[std::size_t(instance)]);
  attach(geometry, {Slot::Kind::solids, -1});
}

int TracedScene::instance_of(const RayHit& hit) const {
  const unsigned top = hit.instance != RTC_INVALID_GEOMETRY_ID ? hit.instance : hit.geometry;
  const Slot& slot = slots_[top];
  if (slot.kind == Slot::Kind::solids) return solid_instances_[hit.primitive];
  return slot.kind == Slot::Kind::spheres ? sphere_instances_[hit.primitive] : slot.instance;
}

TraceQuery TracedScene::query() const {
  TraceQuery query;
  embree::init(query.context);
  query.scene = this;
  return query;
}

RayHit TracedScene::intersect(const V3f& origin, const V3f& direction, float near, float far,
                              std::uint32_t seed, RayMask mask) const {
  RTCRayHit ray;
  ray.ray.org_x = origin.x;
  ray.ray.org_y = origin.y;
  ray.ray.org_z = origin.z;
  ray.ray.dir_x = direction.x;
  ray.ray.dir_y = direction.y;
  ray.ray.dir_z = direction.z;
  ray.ray.tnear = near;
  ray.ray.tfar = far;
  ray.ray.time = 0.0f;
  ray.ray.mask = mask;
  ray.ray.id = 0;
  ray.ray.flags = 0;
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  TraceQuery query_of_one = query();
  query_of_one.seeds = &seed;
  embree::intersect1(top_.get(), query_of_one.context, ray);
  return {ray.ray.tfar, ray.hit.u, ray.hit.v, ray.hit.geomID, ray.hit.primID, ray.hit.instID[0]};
}

}  // namespace lumivec
