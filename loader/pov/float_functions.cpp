#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "loader/pov/number_functions.h"

namespace lumivec::pov {
namespace {

constexpr double pi = std::numbers::pi;

double whole(double x) {
  return std::trunc(x);
}

std::int64_t bits(double x) {
  constexpr double limit = 9.2e18;
  return static_cast<std::int64_t>(std::clamp(x, -limit, limit));
}

const FloatFunction* function_of_one(K keyword) {
#define LUMIVEC_POV_FUNCTION(word, ...)                                                        \
  case K::word##_: {                                                                           \
    static constexpr FloatFunction f{1, [](const double* x) -> double { return __VA_ARGS__; }, \
                                     nullptr};                                                 \
    return &f;                                                                                 \
  }
#define LUMIVEC_POV_PARTIAL_FUNCTION(word, wrong, ...)                                         \
  case K::word##_: {                                                                           \
    static constexpr FloatFunction f{1, [](const double* x) -> double { return __VA_ARGS__; }, \
                                     [](const double* x) -> bool { return wrong; }};           \
    return &f;                                                                                 \
  }
  switch (keyword) {
    LUMIVEC_POV_FUNCTION(abs, std::abs(x[0]))
    LUMIVEC_POV_PARTIAL_FUNCTION(acos, std::abs(x[0]) > 1.0, std::acos(x[0]))
    LUMIVEC_POV_PARTIAL_FUNCTION(acosh, x[0] < 1.0, std::acosh(x[0]))
    LUMIVEC_POV_PARTIAL_FUNCTION(asin, std::abs(x[0]) > 1.0, std::asin(x[0]))
    LUMIVEC_POV_FUNCTION(asinh, std::asinh(x[0]))
    LUMIVEC_POV_FUNCTION(atan, std::atan(x[0]))
    LUMIVEC_POV_PARTIAL_FUNCTION(atanh, std::abs(x[0]) >= 1.0, std::atanh(x[0]))
    LUMIVEC_POV_FUNCTION(ceil, std::ceil(x[0]))
    LUMIVEC_POV_FUNCTION(cos, std::cos(x[0]))
    LUMIVEC_POV_FUNCTION(cosh, std::cosh(x[0]))
    LUMIVEC_POV_FUNCTION(degrees, x[0] * 180.0 / pi)
    LUMIVEC_POV_FUNCTION(exp, std::exp(x[0]))
    LUMIVEC_POV_FUNCTION(floor, std::floor(x[0]))
    LUMIVEC_POV_FUNCTION(int, whole(x[0]))
    LUMIVEC_POV_PARTIAL_FUNCTION(ln, x[0] <= 0.0, std::log(x[0]))
    LUMIVEC_POV_PARTIAL_FUNCTION(log, x[0] <= 0.0, std::log10(x[0]))
    LUMIVEC_POV_FUNCTION(radians, x[0] * pi / 180.0)
    LUMIVEC_POV_FUNCTION(sin, std::sin(x[0]))
    LUMIVEC_POV_FUNCTION(sinh, std::sinh(x[0]))
    LUMIVEC_POV_FUNCTION(sqr, x[0] * x[0])
    LUMIVEC_POV_PARTIAL_FUNCTION(sqrt, x[0] < 0.0, std::sqrt(x[0]))
    LUMIVEC_POV_FUNCTION(tan, std::tan(x[0]))
    LUMIVEC_POV_FUNCTION(tanh, std::tanh(x[0]))
    default:
      return nullptr;
  }
}
#undef LUMIVEC_POV_FUNCTION
#undef LUMIVEC_POV_PARTIAL_FUNCTION

bool no_power(const double* x) {
  return (x[0] == 0.0 && x[1] < 0.0) || (x[0] < 0.0 && x[1] != whole(x[1]));
}

constexpr FloatFunction two_argument_functions[] = {
    {2, [](const double* x) { return std::atan2(x[0], x[1]); }},
    {2, [](const double* x) { return whole(x[0] / x[1]); },
     [](const double* x) { return x[1] == 0.0; }},
    {2, [](const double* x) { return x[0] - x[1] * whole(x[0] / x[1]); },
     [](const double* x) { return x[1] == 0.0; }},
    {2, [](const double* x) { return std::pow(x[0], x[1]); }, no_power},
    {2, [](const double* x) { return double(bits(x[0]) & bits(x[1])); }},
    {2, [](const double* x) { return double(bits(x[0]) | bits(x[1])); }},
    {2, [](const double* x) { return double(bits(x[0]) ^ bits(x[1])); }},
};

}  // namespace

const FloatFunction* float_function(K keyword) {
  switch (keyword) {
    case K::atan2_:
      return &two_argument_functions[0];
    case K::div_:
      return &two_argument_functions[1];
    case K::mod_:
      return &two_argument_functions[2];
    case K::pow_:
    case K::pwr_:
      return &two_argument_functions[3];
    case K::bitwise_and_:
      return &two_argument_functions[4];
    case K::bitwise_or_:
      return &two_argument_functions[5];
    case K::bitwise_xor_:
      return &two_argument_functions[6];
    default:
      return function_of_one(keyword);
  }
}

// Scenes are stills: the clock stands at its beginning.
std::optional<double> float_constant(const Parser& parser, K keyword) {
  constexpr double width = 640.0, height = 480.0;  // what the language assumes of a picture
  switch (keyword) {
    case K::pi_:
      return pi;
    case K::on_:
    case K::yes_:
    case K::true_:
    case K::clock_delta_:
    case K::final_clock_:
    case K::frame_number_:
    case K::initial_frame_:
    case K::final_frame_:
      return 1.0;
    case K::off_:
    case K::false_:
    case K::clock_:
    case K::clock_on_:
    case K::initial_clock_:
    case K::now_:
      return 0.0;
    case K::version_:
      return parser.scene.version;
    case K::image_width_:
      return width;
    case K::image_height_:
      return height;
    default:
      return std::nullopt;
  }
}

}  // namespace lumivec::pov
