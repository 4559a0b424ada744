#include "integrator/check_settings.h"

#include <cmath>
#include <string>

namespace lumivec {
namespace {

void check(const PaperParameters& p) {
  if (!(p.max_variation > 0.0f) || !std::isfinite(p.max_variation))
    throw RenderError("the paper's largest variation must be positive");
  for (const float cosine : {p.min_normal_cosine, p.min_direction_cosine}) {
    if (!(cosine >= -1.0f && cosine < 1.0f))
      throw RenderError("the paper's least cosines must be at least -1 and below 1");
  }
  if (p.needed_records < 1 || p.samples < 1)
    throw RenderError("the paper's records needed and samples must be at least 1");
  if (p.seeds < 0 || p.max_records < 0)
    throw RenderError("the paper's numbers of seeds and records must not be negative");
}

}  // namespace

void check(const RenderSettings& s) {
  if (s.width < 1 || s.height < 1 || s.width > max_picture_side || s.height > max_picture_side) {
    throw RenderError("a picture of " + std::to_string(s.width) + "x" + std::to_string(s.height) +
                      " pixels cannot be rendered; each side may have 1 to " +
                      std::to_string(max_picture_side));
  }
  if (s.samples < 0 || s.samples > max_picture_samples) {
    throw RenderError("samples a pixel must be between 0 and " +
                      std::to_string(max_picture_samples));
  }
  if (!(s.seconds >= 0.0) || !std::isfinite(s.seconds))
    throw RenderError("the time limit must be a positive number of seconds");
  if (!(s.error >= 0.0) || !std::isfinite(s.error))
    throw RenderError("the target error must be a positive fraction");
  if (!(s.specular_roughness >= 0.0f && s.specular_roughness <= 1.0f)) {
    throw RenderError("the specular roughness threshold must be between 0 and 1");
  }
  if (s.max_depth < 0)
    throw RenderError("the maximal depth must not be negative; 0 means no limit");
  if (!(s.cache_error > 0.0) || !std::isfinite(s.cache_error))
    throw RenderError("the error of cached light must be a positive fraction");
  check(s.paper);
}

}  // namespace lumivec
