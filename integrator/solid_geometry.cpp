#include "integrator/solid_geometry.h"

#include <cmath>

#include "integrator/opacity.h"
#include "integrator/traced_scene.h"

namespace lumivec {
namespace {

const TracedScene& scene_of(void* user) {
  return *static_cast<const TracedScene*>(user);
}

// The next float that is not nearer to zero than it, or beyond.
float below(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float above(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

void bounds(const RTCBoundsFunctionArguments* arguments) {
  const TracedScene& scene = scene_of(arguments->geometryUserPtr);
  const Imath::Box3d& box = scene.solids()[arguments->primID].bounds();
  RTCBounds& out = *arguments->bounds_o;
  out.lower_x = below(box.min.x);
  out.lower_y = below(box.min.y);
  out.lower_z = below(box.min.z);
  out.upper_x = above(box.max.x);
  out.upper_y = above(box.max.y);
  out.upper_z = above(box.max.z);
}

struct SolidRay {
  RTCRayHit single;
  Line line;
};

SolidRay ray_of(RTCRayN* rays, unsigned n, unsigned i) {
  SolidRay r;
  RTCRay& ray = r.single.ray;
  ray = rtcGetRayFromRayN(rays, n, i);
  r.line.origin = V3d(ray.org_x, ray.org_y, ray.org_z);
  r.line.direction = V3d(ray.dir_x, ray.dir_y, ray.dir_z);
  return r;
}

// Finds the first boundary that the filter leaves. True: it is in the ray and the hit.
bool find_boundary(const TracedScene& scene, unsigned primitive, unsigned geometry,
                   embree::QueryContext* context, RTCFilterFunctionN filter, SolidRay& r) {
  const TracedSolid& solid = scene.solids()[primitive];
  RTCRay& ray = r.single.ray;
  const float far = ray.tfar;
  double near = ray.tnear;
  const bool filtered = scene.solid_has_filter(primitive);
  while (const auto boundary = solid.first_boundary(r.line, near, far)) {
    const V3d outward = solid.place(boundary->leaf, r.line, boundary->t).outward;
    RTCHit& hit = r.single.hit;
    hit.Ng_x = static_cast<float>(outward.x);
    hit.Ng_y = static_cast<float>(outward.y);
    hit.Ng_z = static_cast<float>(outward.z);
    hit.u = static_cast<float>(boundary->leaf);
    hit.v = 0.0f;
    hit.primID = primitive;
    hit.geomID = geometry;
    hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    ray.tfar = static_cast<float>(boundary->t);
    if (!filtered) return true;
    int valid = -1;
    RTCFilterFunctionNArguments arguments{};
    arguments.valid = &valid;
    arguments.context = context;
    arguments.ray = reinterpret_cast<RTCRayN*>(&ray);
    arguments.hit = reinterpret_cast<RTCHitN*>(&hit);
    arguments.N = 1;
    filter(&arguments);
    if (valid != 0) return true;
    // As the paths do it: the boundary itself must not come again.
    const double size = solid.bounds().size().length() / r.line.direction.length();
    near = boundary->t + 0x1p-20 * (std::abs(boundary->t) + size);
  }
  ray.tfar = far;
  return false;
}

void intersect(const RTCIntersectFunctionNArguments* arguments) {
  const TracedScene& scene = scene_of(arguments->geometryUserPtr);
  const unsigned n = arguments->N;
  RTCRayN* rays = RTCRayHitN_RayN(arguments->rayhit, n);
  RTCHitN* hits = RTCRayHitN_HitN(arguments->rayhit, n);
  for (unsigned i = 0; i < n; ++i) {
    if (arguments->valid[i] == 0) continue;
    SolidRay r = ray_of(rays, n, i);
    if (!find_boundary(scene, arguments->primID, arguments->geomID, arguments->context,
                       filter_intersection, r))
      continue;
    RTCRayN_tfar(rays, n, i) = r.single.ray.tfar;
    rtcCopyHitToHitN(hits, &r.single.hit, n, i);
  }
}

void occlude(const RTCOccludedFunctionNArguments* arguments) {
  const TracedScene& scene = scene_of(arguments->geometryUserPtr);
  const unsigned n = arguments->N;
  for (unsigned i = 0; i < n; ++i) {
    if (arguments->valid[i] == 0) continue;
    SolidRay r = ray_of(arguments->ray, n, i);
    if (find_boundary(scene, arguments->primID, arguments->geomID, arguments->context,
                      filter_occlusion, r))
      RTCRayN_tfar(arguments->ray, n, i) = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

void set_solids(RTCGeometry geometry, const TracedScene& scene) {
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.solids().size()));
  rtcSetGeometryUserData(geometry, const_cast<TracedScene*>(&scene));
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occlude);
}

}  // namespace lumivec
