// A point that a ray hit: where it is, how it is turned, and what it is made of.
#pragma once

#include "integrator/bsdf.h"
#include "loader/scene.h"

namespace lumivec {

// Traced space is world space with the scene's centre moved to the origin (TracedScene::origin), so
// that single precision is spent on the scene's extent and not on its distance from the world's
// origin.
struct SurfacePoint {
  V3f position{0.0f};          // traced space, scene units
  V3f geometric_normal{0.0f};  // unit, on the side that the ray came from
  V3f normal{0.0f};            // unit shading normal, likewise; interpolated, before normal maps
  float error = 0.0f;  // scene units: rays that leave from here must start this far off the surface
  bool front = true;   // the ray came from the front side (counter-clockwise winding)
  int instance = -1;   // index into Scene::instances
  unsigned primitive = 0;    // triangle of the instance's mesh
  float u = 0.0f, v = 0.0f;  // barycentric weights of the triangle's second and third vertex
  const Material* material = nullptr;
};

// Whether the eye looks through the surface: the back of a one-sided one, unless it bounds a volume
// or is a thin wall. Light does not: it is stopped by either side.
inline bool culled(const Material& material, bool front) {
  return !front && !material.double_sided && material.transmission <= 0.0f;
}
inline bool culled(const SurfacePoint& p) {
  return culled(*p.material, p.front);
}

// Where a ray goes on that a surface at this distance does not stop.
inline float next_distance(float distance, float surface_error) {
  constexpr float rounding = 1.0f + 0x1p-20f;
  return distance * rounding + surface_error;
}

// Where a ray from p toward direction starts, so that it does not hit the surface it leaves.
inline V3f offset_origin(const SurfacePoint& p, const V3f& direction) {
  const float side = direction.dot(p.geometric_normal) < 0.0f ? -p.error : p.error;
  return p.position + p.geometric_normal * side;
}

}  // namespace lumivec
