#include "tools/term_errors.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace lumivec {
namespace {

TermError without_noise(const ImageError& measured, const ReferenceNoise& noise) {
  TermError error;
  error.measured_rmse = measured.rmse;
  error.measured_relmse = measured.relmse;
  error.rmse = std::sqrt(std::max(0.0, measured.rmse * measured.rmse - noise.rmse * noise.rmse));
  error.relmse = std::max(0.0, measured.relmse - noise.relmse);
  error.below_noise = error.relmse < noise.relmse;
  return error;
}

}  // namespace

std::string_view error_layer_name(std::size_t layer) {
  return layer == sum_layer ? "sum" : term_names[layer];
}

TermPictures term_pictures(const Framebuffer& framebuffer) {
  TermPictures pictures;
  pictures.fill(Picture(framebuffer.width, framebuffer.height));
  for (std::size_t term = 0; term < term_count; ++term) {
    pictures[term].pixels = framebuffer.terms[term];
  }
  for (std::size_t i = 0; i < framebuffer.pixel_count(); ++i) {
    pictures[sum_layer].pixels[i] = framebuffer.beauty(i);
  }
  return pictures;
}

TermNoise noise_of_halves(const TermPictures& half, const TermPictures& mean) {
  TermNoise noise;
  for (std::size_t i = 0; i < layer_count; ++i) {
    // A half is as far from the mean as the other: half their difference.
    const ImageError error = image_error(half[i], mean[i]);
    noise[i] = {error.rmse, error.relmse};
  }
  return noise;
}

TermErrors term_errors(const TermPictures& test, const TermPictures& reference,
                       const TermNoise& noise) {
  TermErrors errors;
  for (std::size_t i = 0; i < layer_count; ++i) {
    errors[i] = without_noise(image_error(test[i], reference[i]), noise[i]);
  }
  return errors;
}

nlohmann::json term_errors_json(const TermErrors& errors) {
  nlohmann::json json;
  for (std::size_t i = 0; i < layer_count; ++i) {
    json[std::string(error_layer_name(i))] = {{"rmse", errors[i].rmse},
                                              {"relmse", errors[i].relmse},
                                              {"measured_rmse", errors[i].measured_rmse},
                                              {"measured_relmse", errors[i].measured_relmse},
                                              {"below_noise", errors[i].below_noise}};
  }
  return json;
}

nlohmann::json term_noise_json(const TermNoise& noise) {
  nlohmann::json json;
  for (std::size_t i = 0; i < layer_count; ++i) {
    json[std::string(error_layer_name(i))] = {{"rmse", noise[i].rmse}, {"relmse", noise[i].relmse}};
  }
  return json;
}

TermNoise term_noise_from_json(const nlohmann::json& json) {
  TermNoise noise;
  for (std::size_t i = 0; i < layer_count; ++i) {
    const nlohmann::json& layer = json.at(std::string(error_layer_name(i)));
    noise[i] = {layer.at("rmse").get<double>(), layer.at("relmse").get<double>()};
  }
  return noise;
}

}  // namespace lumivec
