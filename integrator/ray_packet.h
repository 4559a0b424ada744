// Embree's packets of eight rays, filled ray by ray.
#pragma once

#include "integrator/embree_api.h"
#include "loader/scene.h"

namespace lumivec {

// Rays are traced in packets of so many, the width that AVX2 and AVX-512 machines both trace
// natively.
constexpr int packet_size = 8;

// What a ray is for, in the lowest bits of its mask: instances may be hidden from some of them.
using RayMask = unsigned;
constexpr RayMask eye_ray = 1, shadow_ray = 2, mirror_ray = 4, other_ray = 8;
constexpr RayMask all_rays = ~0u, ray_kinds = 15;
constexpr RayMask mask_of(RayMask kind) {
  return (all_rays & ~ray_kinds) | kind;
}

// What Embree does not change.
inline void set_constants(RTCRay8& rays) {
  for (int i = 0; i < packet_size; ++i) {
    rays.time[i] = 0.0f;
    rays.mask[i] = all_rays;
    rays.id[i] = static_cast<unsigned>(i);
    rays.flags[i] = 0;
  }
}

inline void set_ray(RTCRay8& rays, int i, const V3f& origin, const V3f& direction, float near,
                    float far) {
  rays.org_x[i] = origin.x;
  rays.org_y[i] = origin.y;
  rays.org_z[i] = origin.z;
  rays.dir_x[i] = direction.x;
  rays.dir_y[i] = direction.y;
  rays.dir_z[i] = direction.z;
  rays.tnear[i] = near;
  rays.tfar[i] = far;
}
inline void set_ray(RTCRayHit8& rays, int i, const V3f& origin, const V3f& direction, float near,
                    float far) {
  set_ray(rays.ray, i, origin, direction, near, far);
  rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
}

// The first `count` rays are valid; the others are emptied, as some of Embree's packet kernels look
// at them all the same.
inline void set_valid(RTCRay8& rays, int count, int* valid) {
  for (int i = 0; i < packet_size; ++i) {
    valid[i] = i < count ? -1 : 0;
    if (i >= count) set_ray(rays, i, V3f(0.0f), V3f(0.0f, 0.0f, 1.0f), 0.0f, -1.0f);
  }
}

}  // namespace lumivec
