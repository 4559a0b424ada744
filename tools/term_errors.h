// How far a render is from a reference, for each of the five terms and for their sum, with the
// reference's own noise taken off.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "integrator/framebuffer.h"
#include "viewer/image_error.h"
#include "viewer/picture.h"

namespace lumivec {

// The terms by Term, then their sum.
constexpr std::size_t layer_count = term_count + 1;
constexpr std::size_t sum_layer = term_count;
constexpr std::size_t indirect_layer = static_cast<std::size_t>(Term::indirect);
std::string_view error_layer_name(std::size_t layer);  // "sum" for the last

using TermPictures = std::array<Picture, layer_count>;
TermPictures term_pictures(const Framebuffer& framebuffer);

// Expected squared errors of a reference against its own limit.
struct ReferenceNoise {
  double rmse = 0.0;
  double relmse = 0.0;
};
using TermNoise = std::array<ReferenceNoise, layer_count>;

// Of the mean of two halves of equal size and independent random numbers: half their difference is
// as far from the limit as their mean is, on average. mean: of both.
TermNoise noise_of_halves(const TermPictures& half, const TermPictures& mean);

struct TermError {
  double measured_rmse = 0.0, measured_relmse = 0.0;  // against the reference as it is
  double rmse = 0.0, relmse = 0.0;                    // without the reference's noise, ≥ 0
  bool below_noise = false;  // relmse is less than the reference's own: it says little
};
using TermErrors = std::array<TermError, layer_count>;

// test and reference have the same size (asserted in image_error), and independent random numbers.
TermErrors term_errors(const TermPictures& test, const TermPictures& reference,
                       const TermNoise& noise);

nlohmann::json term_errors_json(const TermErrors& errors);
nlohmann::json term_noise_json(const TermNoise& noise);
TermNoise term_noise_from_json(const nlohmann::json& json);  // throws nlohmann::json::exception

}  // namespace lumivec
