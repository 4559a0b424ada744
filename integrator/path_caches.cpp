#include <algorithm>
#include <cmath>

#include "integrator/bsdf_color.h"
#include "integrator/partition.h"
#include "integrator/path_stream.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

// A pixel's size grows so many times over where a path that has been scattered lands.
constexpr float scattered_footprint = 4.0f;
// Discs of photons that the eye sees have a radius of so many pixels, others of one footprint;
// none is larger than this share of the scene's radius.
constexpr float photon_pixels = 2.5f;
constexpr float longest_photon_radius = 0.05f;
constexpr std::uint32_t photon_stream = 0x9407u;

// What a diffuse lobe makes of cached light. The lobe's dependence on the direction of light is
// taken where the source stands, and for the sky at its mean cosine.
Color reflected_diffusely(const Bsdf& bsdf, const CachedLight& cached) {
  const V3f& normal = bsdf.normal();
  // Sky and source together are the irradiance where the normal is not bent.
  if (bsdf.lambertian() && normal == cached.sky_normal)
    return bsdf.diffuse_brdf(normal) * cached.light.irradiance(normal);
  const SkyAndSource light = split_light(cached.light, cached.sky_normal);
  const Color sky = light.sky_irradiance(cached.sky_normal, normal);
  const Color source = light.source_irradiance(normal);
  if (bsdf.lambertian()) return bsdf.diffuse_brdf(normal) * (sky + source);
  constexpr float sky_cosine = 2.0f / 3.0f;
  const V3f oblique =
      sky_cosine * normal + std::sqrt(1.0f - sky_cosine * sky_cosine) * make_frame(normal).t;
  return bsdf.diffuse_brdf(oblique) * sky + bsdf.diffuse_brdf(light.mean_direction) * source;
}

}  // namespace

float PathStream::footprint(const Lane& lane) const {
  if (results_) return cache_.spread * lane.length;
  const float pixel = t_.camera_.footprint(lane.length);
  return lane.caustic.scattered ? pixel * scattered_footprint : pixel;
}

void PathStream::add_photons(Lane& lane, const SurfacePoint& point, const Bsdf& bsdf) {
  const Term once = after_event(lane.term, LobeKind::diffuse);
  const Term caustic = after_event(once, LobeKind::specular);
  const Term patchy = after_event(once, LobeKind::diffuse);
  if (((term_bit(caustic) | term_bit(patchy)) & terms_) == 0) return;
  const bool seen = !results_ && !lane.caustic.scattered;
  PhotonQuery query;
  query.position = point.position;
  query.geometric_normal = point.geometric_normal;
  query.error = point.error;
  query.most_radius = longest_photon_radius * t_.scene_.radius();
  query.radius = std::min((seen ? photon_pixels : 1.0f) * footprint(lane), query.most_radius);
  query.gathering = !seen;
  query.glossy = !lane.caustic.broad;
  query.seed = hash_combine(hash_combine(lane.seed, lane.sample),
                            photon_stream + static_cast<std::uint32_t>(lane.depth));
  if (t_.settings_.max_depth > 0) query.max_events = t_.settings_.max_depth - lane.depth;
  const PhotonLight light = cache_.photons->reflect(query, bsdf, statistics_);
  const auto add = [&](Term to, const Color& reflected) {
    const Color brought = lane.throughput * reflected;
    lane.add(to, brought);
    if ((terms_ & term_bit(to)) != 0) lane.photons += mean(brought);
  };
  add(caustic, light.caustic);
  add(patchy, light.patchy);
}

std::uint32_t PathStream::cached_kinds(const Bsdf& bsdf,
                                       const SurfaceParameters& parameters) const {
  if (cache_.paper) return paper_kinds(bsdf, parameters);
  const bool any = cache_.indirect || (cache_.direct && cache_.asks());
  return any && bsdf.has(LobeKind::diffuse) ? kind_bit(LobeKind::diffuse) : 0;
}

bool PathStream::use_cache(Lane& lane, const SurfacePoint& point,
                           const SurfaceParameters& parameters, const Bsdf& bsdf) {
  CachePoint at;
  at.position = point.position;
  at.geometric_normal = point.geometric_normal;
  at.normal = point.normal;
  at.error = point.error;
  at.footprint = footprint(lane);
  at.instance = point.instance;
  if (cache_.paper)
    return use_paper_cache(lane, {at, -lane.direction, parameters, lane.media}, bsdf);
  CachedLight light;
  const Term direct = after_event(lane.term, LobeKind::diffuse);
  if (cache_.requests && cache_.requested == Term::direct) {
    if (!lane.media.top()) look_up(*cache_.direct, lane, at, light);
    return false;
  }
  if (!look_up(*cache_.indirect, lane, at, light)) return false;
  lane.add(after_event(direct, LobeKind::diffuse),
           lane.throughput * reflected_diffusely(bsdf, light));
  // What a volume takes of light from infinitely far away is not cached.
  if (cache_.direct && !lane.media.top() && !cache_.requests &&
      look_up(*cache_.direct, lane, at, light)) {
    lane.add(direct, lane.throughput * reflected_diffusely(bsdf, light));
    lane.even_cached = true;
  }
  return true;
}

bool PathStream::look_up(const IrradianceCache& cache, const Lane& lane, const CachePoint& at,
                         CachedLight& light) {
  if (cache.look_up(at, cache_.budget, cache_.needed_weight, light, statistics_.rays_visibility)) {
    ++statistics_.cache_hits;
    return true;
  }
  ++statistics_.cache_misses;
  if (cache_.requests) cache_.requests->push_back({at, lane.media});
  return std::any_of(
      cache_.meanwhile_budgets.begin(), cache_.meanwhile_budgets.end(), [&](float budget) {
        return budget > 0.0f && cache.look_up(at, budget, 0.0f, light, statistics_.rays_visibility);
      });
}

bool PathStream::use_paper_cache(Lane& lane, const PaperPoint& point, const Bsdf& bsdf) {
  Color radiance(0.0f);
  if (!cache_.paper->look_up(point, bsdf, radiance)) {
    ++statistics_.cache_misses;
    if (cache_.paper_requests) cache_.paper_requests->push_back(point);
    return false;
  }
  ++statistics_.cache_hits;
  const Term term = after_event(after_event(lane.term, LobeKind::diffuse), LobeKind::diffuse);
  lane.add(term, lane.throughput * radiance);
  return true;
}

}  // namespace lumivec
