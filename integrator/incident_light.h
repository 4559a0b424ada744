// Indirect light that arrives at a point, by direction: on the faces of a recursive icosahedron, as
// traced at the asking, beside the light vectors that the cache has for the point. What a light
// vector sums up can so be seen.
#pragma once

#include <array>
#include <vector>

#include "integrator/irradiance_cache.h"
#include "integrator/path_tracer.h"
#include "integrator/surface.h"

namespace lumivec {

struct IncidentFace {
  std::array<V3f, 3> corners;  // unit directions, world space; they may lie below the surface
  float solid_angle = 0.0f;    // of all of the face, sr
  Color radiance{0.0f};        // mean over it, cd·m⁻²; 0 below the surface
  Color irradiance{0.0f};      // that it gives the surface, lx
};

struct IncidentLight {
  V3f normal{0.0f};                 // unit, geometric, on the eye's side
  std::vector<IncidentFace> faces;  // that lie above the surface, or partly
  // What the cache has, by interpolation: ∫ L ω dω of each channel, cd·m⁻²·sr, and of how many
  // records. No records: nothing is cached there.
  std::array<V3f, 3> vector = {V3f(0.0f), V3f(0.0f), V3f(0.0f)};
  int records = 0;

  // On the surface, lx: by the faces, by the light vectors.
  Color irradiance_of_faces() const;
  Color irradiance_of_vector() const;
};

// Traces some thousand paths, which end in cached light where there is any; a few milliseconds.
// use: the caches; footprint: of a pixel there, scene units. Light that volumes take away on its
// way to the point is not counted.
IncidentLight incident_light(const PathTracer& tracer, const SurfacePoint& point,
                             const CacheUse& use, float footprint);

}  // namespace lumivec
