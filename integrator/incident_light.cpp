#include "integrator/incident_light.h"

#include <algorithm>
#include <cmath>

#include "integrator/icosahedron.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

constexpr int face_level = 2;  // 320 faces, 17° wide
constexpr std::uint32_t paths_a_face = 32;
constexpr float path_spread = 0.02f;  // radians: the light that a path stands for
constexpr std::uint32_t incident_stream = 0x1ac1du;

// Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle".
float solid_angle(const std::array<V3f, 3>& t) {
  const float volume = std::abs(t[0].dot(t[1].cross(t[2])));
  const float rest = 1.0f + t[0].dot(t[1]) + t[1].dot(t[2]) + t[2].dot(t[0]);
  return 2.0f * std::atan2(volume, rest);
}

// A direction in the face, nearly evenly spread: faces are small.
V3f direction_in(const std::array<V3f, 3>& t, float u, float v) {
  const float root = std::sqrt(u);
  return (t[0] * (1.0f - root) + t[1] * (root * (1.0f - v)) + t[2] * (root * v)).normalized();
}

}  // namespace

Color IncidentLight::irradiance_of_faces() const {
  Color sum(0.0f);
  for (const IncidentFace& face : faces) sum += face.irradiance;
  return sum;
}

Color IncidentLight::irradiance_of_vector() const {
  return {std::max(0.0f, vector[0].dot(normal)), std::max(0.0f, vector[1].dot(normal)),
          std::max(0.0f, vector[2].dot(normal))};
}

IncidentLight incident_light(const PathTracer& tracer, const SurfacePoint& point,
                             const CacheUse& use, float footprint) {
  IncidentLight result;
  result.normal = point.geometric_normal;
  const Icosahedron& sphere = icosahedron();
  const std::uint32_t first = Icosahedron::first_face(face_level);
  std::vector<GatherRay> rays;
  std::vector<std::size_t> face_of;
  for (std::uint32_t f = first; f < first + Icosahedron::face_count(face_level); ++f) {
    IncidentFace face;
    face.corners = sphere.triangle(f);
    for (V3f& corner : face.corners) corner.normalize();
    const auto& c = face.corners;
    if (std::max({c[0].dot(result.normal), c[1].dot(result.normal), c[2].dot(result.normal)}) <=
        0.0f) {
      continue;
    }
    face.solid_angle = solid_angle(c);
    for (std::uint32_t i = 0; i < paths_a_face; ++i) {
      const std::array<float, 4> u = sobol_point(i, hash_combine(incident_stream, f));
      const V3f direction = direction_in(c, u[0], u[1]);
      if (direction.dot(result.normal) <= 0.0f) continue;
      rays.push_back(
          {offset_origin(point, direction), direction, static_cast<std::uint32_t>(rays.size())});
      face_of.push_back(result.faces.size());
    }
    result.faces.push_back(face);
  }
  CacheUse ends = use;
  ends.spread = path_spread;
  std::vector<GatherResult> found;
  RenderStatistics statistics;
  tracer.gather(rays, {}, incident_stream, found, statistics, ends, Term::indirect);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    IncidentFace& face = result.faces[face_of[i]];
    const Color share = found[i].radiance * (1.0f / paths_a_face);
    face.radiance += share;
    face.irradiance += share * (face.solid_angle * rays[i].direction.dot(result.normal));
  }

  CachePoint at;
  at.position = point.position;
  at.geometric_normal = point.geometric_normal;
  at.normal = point.normal;
  at.error = point.error;
  at.footprint = footprint;
  at.instance = point.instance;
  CachedLight cached;
  std::uint64_t visibility_rays = 0;
  if (use.indirect && use.indirect->look_up(at, use.budget, 0.0f, cached, visibility_rays)) {
    result.vector = cached.light.vector;
    result.records = cached.records;
  }
  return result;
}

}  // namespace lumivec
