#include "integrator/paper_validity.h"

#include <algorithm>

namespace lumivec {

namespace {

// (cosine − least) / (1 − least), [0, 1].
float cosine_weight(float cosine, float least) {
  return std::clamp((cosine - least) / (1.0f - least), 0.0f, 1.0f);
}

}  // namespace

PaperValidity paper_validity(const PaperRecord& record, const V3f& position, const V3f& normal,
                             const V3f& view, const PaperParameters& parameters) {
  const float distance = (position - record.position).length();
  if (!(distance < record.mean_distance)) return {PaperVerdict::distant};
  const float variation = distance * record.relative_variation;
  if (!(variation < parameters.max_variation)) return {PaperVerdict::varying};
  const float normals = normal.dot(record.normal);
  if (!(normals > parameters.min_normal_cosine)) return {PaperVerdict::curved};
  const float views = view.dot(record.view);
  if (!(views > parameters.min_direction_cosine)) return {PaperVerdict::other_view};
  const float by_distance = 1.0f - distance / record.mean_distance;
  const float by_variation = 1.0f / (1.0f + variation / parameters.max_variation);
  const float weight = std::clamp(by_distance, 0.0f, 1.0f) * by_variation *
                       cosine_weight(normals, parameters.min_normal_cosine) *
                       cosine_weight(views, parameters.min_direction_cosine);
  return {PaperVerdict::valid, weight};
}

void LightVectorMean::add(const LightVector& v, float weight) {
  ++count_;
  weight_ += weight;
  if (v.form == LightVectorForm::radiance) {
    radiance_ += v.magnitude * weight;
    return;
  }
  const float light = weight * (v.magnitude.x + v.magnitude.y + v.magnitude.z);
  vector_ += v.direction * light;
  magnitude_ += v.magnitude * weight;
  if (light > most_light_) {
    most_light_ = light;
    brightest_ = v.direction;
  }
}

LightVector LightVectorMean::light() const {
  LightVector mean;
  // Of opposite directions the brightest one's is left.
  if (!unit_direction(vector_, mean.direction)) mean.direction = brightest_;
  if (weight_ > 0.0f) mean.magnitude = magnitude_ / weight_;
  return mean;
}

Color LightVectorMean::radiance() const {
  return weight_ > 0.0f ? radiance_ / weight_ : Color(0.0f);
}

}  // namespace lumivec
