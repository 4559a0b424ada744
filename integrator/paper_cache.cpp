#include "integrator/paper_cache.h"

#include "integrator/bsdf_color.h"

namespace lumivec {
namespace {

constexpr float darkest_base_color = 0.01f;
// A record of this weight or more was made at the very point and for the very view where it is
// asked for: p is 1 but for rounding.
constexpr float weight_in_place = 0.9999f;
// What memory may become by the next insertion: arrays grow by a quarter.
constexpr double growth = 1.25;

}  // namespace

std::uint32_t paper_kinds(const Bsdf& bsdf, const SurfaceParameters& surface) {
  std::uint32_t kinds = 0;
  if (bsdf.has(LobeKind::diffuse)) kinds |= kind_bit(LobeKind::diffuse);
  if (bsdf.has(LobeKind::broad) && surface.transmission <= 0.0f) kinds |= kind_bit(LobeKind::broad);
  return kinds;
}

Color paper_f_cos(const Bsdf& bsdf, std::uint32_t kinds, const V3f& wi) {
  const BsdfValue value = bsdf.eval(wi);
  Color f_cos(0.0f);
  for (const LobeKind kind : {LobeKind::diffuse, LobeKind::broad}) {
    if ((kinds & kind_bit(kind)) != 0) f_cos += value.of(kind);
  }
  return f_cos;
}

Color paper_base_color(const Color& base_color) {
  return at_least(base_color, Color(darkest_base_color));
}

PaperCache::PaperCache(const PaperParameters& parameters, std::uint64_t max_bytes)
    : parameters_(parameters), max_bytes_(max_bytes), directional_(max_bytes) {}

bool PaperCache::look_up(const PaperPoint& point, const Bsdf& bsdf, Color& radiance) const {
  LightVectorMean mean, in_place;
  const auto visit = [&](const PaperRecord& record, const V3f& view) {
    const PaperValidity validity =
        paper_validity(record, point.place.position, point.place.normal, view, parameters_);
    if (!(validity.weight > 0.0f)) return;
    mean.add(record.light, validity.weight);
    if (validity.weight >= weight_in_place) in_place.add(record.light, validity.weight);
  };
  if (bsdf.lambertian()) {
    flat_tree_.for_each_reaching(point.place.position, 1.0f, [&](std::uint32_t i, float) {
      visit(flat_records_[i], flat_records_[i].view);
    });
  } else {
    directional_.look_up(
        point.place.position, point.view, 1.0f, parameters_.min_direction_cosine,
        [&](const PaperRecord& record, float, float) { visit(record, point.view); });
  }
  if (in_place.count() > 0) {
    mean = in_place;
  } else if (mean.count() < std::max(1, parameters_.needed_records)) {
    return false;
  }
  const LightVector light = mean.light();
  const std::uint32_t kinds = paper_kinds(bsdf, point.surface);
  radiance = relit(light, paper_f_cos(bsdf, kinds, light.direction)) +
             mean.radiance() * paper_base_color(point.surface.base_color);
  return true;
}

bool PaperCache::insert(const PaperPoint& point, const PaperRecord& record, bool lambertian) {
  if (static_cast<double>(bytes()) * growth > static_cast<double>(max_bytes_)) return false;
  if (!lambertian) {
    return directional_.insert(record.position, record.mean_distance, point.place.error,
                               record.view, record);
  }
  flat_tree_.insert(record.position, record.mean_distance, [&](std::uint32_t added) {
    while (flat_records_.size() <= added) flat_records_.grow();
    flat_records_[added] = record;
  });
  return true;
}

void PaperCache::balance() {
  flat_tree_.rebuild([this](std::uint32_t i) { return flat_tree_.reach(i); });
  directional_.balance();
}

}  // namespace lumivec
