#include "integrator/photon_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "integrator/frame.h"
#include "integrator/ray_packet.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

// Discs' areas fall with the number n of the map as the product of (i + α) / (i + 1) (Knaus and
// Zwicker 2011, eq. 15): as its square root, so that both noise and bias of the mean keep falling.
constexpr double area_rate = 0.5;
// Discs need no more photons than this in the first map; those of paths that gather light, fewer.
constexpr float enough_seen = 128.0f, enough_gathered = 8.0f;
// Where paths that gather light find fewer, they look in discs so many times as wide.
constexpr float radius_growth = 4.0f;
// Photons count if they are no further off the tangent plane than this share of the radius, and if
// their surface leans no more than this.
constexpr float off_plane_share = 0.2f;
constexpr float least_normal_cosine = 0.7f;
// A surface that light grazes, by its geometric normal, would be brightened without bound.
constexpr float least_cosine = 0.05f;
// Edges are looked for so far above and below the surface, in radii.
constexpr float edge_height = 0.1f;

// Epanechnikov's kernel, of squared distance over squared radius; its integral over the disc is 1
// times the disc's area.
float kernel(float t2) {
  return 2.0f * (1.0f - t2);
}
// Its integral over a sector of the disc up to a share t of the radius, over that of the sector.
float kernel_share(float t) {
  const float t2 = t * t;
  return t2 * (2.0f - t2);
}

}  // namespace

void PhotonMap::build(std::vector<Photon> photons, std::uint64_t paths, std::uint32_t number,
                      float widen, std::uint32_t gather_stride) {
  photons_ = std::move(photons);
  std::vector<V3f> positions;
  positions.reserve(photons_.size());
  for (const Photon& p : photons_) positions.push_back(p.position);
  tree_.assign(positions);
  std::vector<V3f> few;
  gather_stride_ = gather_stride;
  for (std::size_t i = 0; i < positions.size(); i += gather_stride) few.push_back(positions[i]);
  few_tree_.assign(few);
  flux_scale_ = paths > 0 ? static_cast<float>(1.0 / static_cast<double>(paths)) : 0.0f;
  double area = widen;
  for (std::uint32_t i = 1; i <= number; ++i) area *= (i + area_rate) / (i + 1.0);
  shrink_ = static_cast<float>(area);
}

// In each of so many directions: how far the surface goes on, at most the radius.
void PhotonMap::find_edges(const PhotonQuery& query, const Frame& frame, float radius, float turn,
                           std::array<float, directions>& edges,
                           RenderStatistics& statistics) const {
  const float height = edge_height * radius + query.error;
  alignas(64) int valid[directions];
  std::uint32_t seeds[directions];
  V3f along[directions];
  RTCRayHit8 rays;
  set_constants(rays.ray);
  const V3f above = query.position + frame.n * height;
  for (int i = 0; i < directions; ++i) {
    const V2f c = unit_circle((static_cast<float>(i) + turn) / directions);
    along[i] = frame.t * c.x + frame.b * c.y;
    valid[i] = -1;
    seeds[i] = query.seed;
    set_ray(rays, i, above, along[i], 0.0f, radius);
  }
  TraceQuery trace = scene_.query();
  trace.seeds = seeds;
  embree::intersect8(valid, scene_.handle(), trace.context, rays);
  for (int i = 0; i < directions; ++i) edges[std::size_t(i)] = rays.ray.tfar[i];
  // Back along the underside of the surface: what is met there is where a solid body ends.
  const V3f below = query.position - frame.n * height;
  for (int i = 0; i < directions; ++i) {
    const float out = edges[std::size_t(i)];
    set_ray(rays, i, below + along[i] * out, -along[i], 0.0f, out);
  }
  embree::intersect8(valid, scene_.handle(), trace.context, rays);
  for (int i = 0; i < directions; ++i) {
    if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    // What is met from its back was entered somewhere else: something else lies below.
    const V3f normal(rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]);
    if (rays.hit.instID[0][i] == RTC_INVALID_GEOMETRY_ID && normal.dot(along[i]) <= 0.0f) continue;
    edges[std::size_t(i)] -= rays.ray.tfar[i];
  }
  statistics.rays_visibility += 2 * directions;
}

PhotonLight PhotonMap::reflect(const PhotonQuery& query, const Bsdf& bsdf,
                               RenderStatistics& statistics) const {
  struct Found {
    std::uint32_t photon;
    float distance2;
  };
  thread_local std::vector<Found> found;
  PhotonLight light;
  if (photons_.empty()) return light;
  const Frame frame = make_frame(query.geometric_normal);
  float radius = query.radius * std::sqrt(shrink_);
  const std::uint32_t stride = query.gathering ? gather_stride_ : 1;
  const PointTree& tree = query.gathering ? few_tree_ : tree_;
  const auto search = [&] {
    found.clear();
    tree.for_each_within(query.position, radius, [&](std::uint32_t found_at, float distance2) {
      const std::uint32_t i = found_at * stride;
      const Photon& p = photons_[i];
      if (std::abs(p.normal.dot(frame.n)) < least_normal_cosine) return;
      if (std::abs((p.position - query.position).dot(frame.n)) > off_plane_share * radius) return;
      if (query.max_events > 0 && p.events >= query.max_events) return;
      found.push_back({i, distance2});
    });
  };
  search();
  const float enough = std::max(1.0f, (query.gathering ? enough_gathered : enough_seen) * shrink_);
  // Near where a path begins its footprint is smaller than what lies between photons: one that it
  // happens to meet there would outshine all else that the path's record gathers.
  const float most = query.most_radius * std::sqrt(shrink_);
  while (query.gathering && radius < most && static_cast<float>(found.size()) < enough) {
    radius = std::min(radius_growth * radius, most);
    search();
  }
  if (found.empty()) return light;
  const float share = enough / static_cast<float>(found.size());
  if (share < 1.0f) radius *= std::sqrt(share);
  const float radius2 = radius * radius;

  std::array<float, directions> edges;
  edges.fill(radius);
  float area = 1.0f;  // of the disc that is surface, weighed by the kernel, as a share
  const float turn = static_cast<float>(mix_bits(query.seed) >> 8) * 0x1p-24f;
  bool cut = false;
  if (!query.gathering) {
    find_edges(query, frame, radius, turn, edges, statistics);
    area = 0.0f;
    for (const float edge : edges) {
      area += kernel_share(std::clamp(edge / radius, 0.0f, 1.0f)) / directions;
      cut = cut || edge < radius;
    }
  }
  if (!(area > 0.0f)) return light;

  Color caustic(0.0f), patchy(0.0f);
  for (const Found& f : found) {
    if (f.distance2 >= radius2) continue;
    const Photon& p = photons_[f.photon];
    if (cut) {
      const V3f offset = p.position - query.position;
      const float x = offset.dot(frame.t), y = offset.dot(frame.b);
      const float turns = std::atan2(y, x) / (2.0f * pi) + 1.0f - (turn - 0.5f) / directions;
      const auto sector = static_cast<std::size_t>(turns * directions) % directions;
      if (x * x + y * y > edges[sector] * edges[sector]) continue;
    }
    const float weight = kernel(f.distance2 / radius2);
    if (bsdf.lambertian()) {
      const float side = p.direction.dot(query.geometric_normal);
      if (side <= 0.0f) continue;
      const float cosine = p.direction.dot(bsdf.normal());
      if (cosine <= 0.0f) continue;
      const float relief = cosine / std::max(std::abs(p.direction.dot(p.normal)), least_cosine);
      (p.caustic ? caustic : patchy) += p.flux * (weight * relief);
      continue;
    }
    const BsdfValue f_cos = bsdf.eval(p.direction);
    Color reflected = f_cos.of_broad();
    if (p.caustic && query.glossy) reflected += f_cos.of(LobeKind::glossy);
    const float flat = std::max(std::abs(p.direction.dot(p.normal)), least_cosine);
    (p.caustic ? caustic : patchy) += p.flux * reflected * (weight / flat);
  }
  const float scale = flux_scale_ * static_cast<float>(stride) / (pi * radius2 * area);
  const Color brdf = bsdf.lambertian() ? bsdf.diffuse_brdf(bsdf.normal()) : Color(1.0f);
  light.caustic = brdf * caustic * scale;
  light.patchy = brdf * patchy * scale;
  return light;
}

}  // namespace lumivec
