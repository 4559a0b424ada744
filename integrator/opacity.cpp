#include "integrator/opacity.h"

#include "integrator/bsdf.h"
#include "integrator/sobol.h"
#include "integrator/traced_scene.h"

namespace lumivec {
namespace {

struct FilteredHit {
  unsigned lane;
  V3f origin, direction;
  RayHit hit;
  RayMask mask;
};

FilteredHit filtered_hit(const RTCFilterFunctionNArguments& arguments, unsigned i) {
  RTCRayN* ray = arguments.ray;
  RTCHitN* hit = arguments.hit;
  const unsigned n = arguments.N;
  FilteredHit result;
  result.lane = RTCRayN_id(ray, n, i);
  result.origin = {RTCRayN_org_x(ray, n, i), RTCRayN_org_y(ray, n, i), RTCRayN_org_z(ray, n, i)};
  result.direction = {RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i), RTCRayN_dir_z(ray, n, i)};
  result.hit = {RTCRayN_tfar(ray, n, i),   RTCHitN_u(hit, n, i),      RTCHitN_v(hit, n, i),
                RTCHitN_geomID(hit, n, i), RTCHitN_primID(hit, n, i), RTCHitN_instID(hit, n, i, 0)};
  result.mask = RTCRayN_mask(ray, n, i);
  return result;
}

// Embree shows the filters of instanced geometry the ray in object space.
void bring_to_traced_space(const TracedScene& scene, int instance, FilteredHit& f) {
  if (f.hit.instance == RTC_INVALID_GEOMETRY_ID) return;
  const M44d m = scene.object_to_traced(instance);
  const int sphere = scene.scene().instances[std::size_t(instance)].sphere;
  const double unit = sphere >= 0 ? scene.scene().spheres[std::size_t(sphere)].radius : 1.0;
  V3d direction;
  m.multDirMatrix(V3d(f.direction) * unit, direction);
  f.origin = V3f(V3d(f.origin) * unit * m);
  f.direction = V3f(direction);
}

bool hidden(const TracedInstance& instance, RayMask mask) {
  return (instance.seen_by & mask & ray_kinds) == 0;
}

// Whether the ray with this seed finds the surface there.
bool is_hit(const TracedScene& scene, const SurfacePoint& point, std::uint32_t seed) {
  const float opacity = scene.opacity(point);
  if (opacity >= 1.0f) return true;
  if (opacity <= 0.0f) return false;
  const std::uint32_t hash =
      hash_combine(hash_combine(seed, point.primitive), static_cast<std::uint32_t>(point.instance));
  return static_cast<float>(hash >> 8) * 0x1p-24f < opacity;
}

}  // namespace

void filter_intersection(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *reinterpret_cast<const TraceQuery*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) continue;
    FilteredHit f = filtered_hit(*arguments, i);
    const int index = query.scene->instance_of(f.hit);
    const TracedInstance& instance = query.scene->instances()[std::size_t(index)];
    if (hidden(instance, f.mask)) {
      arguments->valid[i] = 0;
      continue;
    }
    if (instance.material->alpha_mode == AlphaMode::opaque) continue;
    bring_to_traced_space(*query.scene, index, f);
    const SurfacePoint point = query.scene->surface(f.hit, f.origin, f.direction);
    if (!is_hit(*query.scene, point, query.seeds ? query.seeds[f.lane] : 0))
      arguments->valid[i] = 0;
  }
}

void filter_occlusion(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *reinterpret_cast<const TraceQuery*>(arguments->context);
  for (unsigned i = 0; i < arguments->N; ++i) {
    if (arguments->valid[i] == 0) continue;
    FilteredHit f = filtered_hit(*arguments, i);
    const int index = query.scene->instance_of(f.hit);
    const TracedInstance& instance = query.scene->instances()[std::size_t(index)];
    if (hidden(instance, f.mask)) {
      arguments->valid[i] = 0;
      continue;
    }
    const Material& material = *instance.material;
    const bool maybe_thin = query.transmittance && material.transmission > 0.0f &&
                            material.thin_walled && !material.unlit;
    if (material.alpha_mode == AlphaMode::opaque && !maybe_thin) continue;
    bring_to_traced_space(*query.scene, index, f);
    const SurfacePoint point = query.scene->surface(f.hit, f.origin, f.direction);
    if (!is_hit(*query.scene, point, query.seeds ? query.seeds[f.lane] : 0)) {
      arguments->valid[i] = 0;
      continue;
    }
    if (!maybe_thin) continue;
    const Color passed = query.scene->thin_transmittance(point, -f.direction.normalized());
    if (passed == Color(0.0f)) continue;
    query.transmittance[f.lane] *= passed;
    query.passed_thin[f.lane] = 1;
    arguments->valid[i] = 0;
  }
}

}  // namespace lumivec
