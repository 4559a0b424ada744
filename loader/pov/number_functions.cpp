#include "loader/pov/number_functions.h"

#include <algorithm>
#include <cmath>

#include "loader/pov/arrays.h"
#include "loader/pov/expression.h"
#include "loader/pov/extents.h"
#include "loader/pov/noise.h"
#include "loader/pov/rotations.h"
#include "loader/pov/strings.h"

namespace lumivec::pov {
namespace {

Number call_float_function(Parser& parser, K keyword, const FloatFunction& function) {
  double x[3] = {};
  for (int i = 0; i < function.count; ++i) {
    if (i > 0) skip_comma(parser);
    x[i] = parse_float(parser, keyword_text(keyword));
  }
  if (function.undefined && function.undefined(x)) {
    std::string given = std::to_string(x[0]);
    if (function.count > 1) given += ", " + std::to_string(x[1]);
    parser.fail(std::string(keyword_text(keyword)) + " has no value for " + given);
  }
  return Number(function.value(x));
}

// min, max: of any number of floats.
Number extreme(Parser& parser, bool largest) {
  double best = parse_float(parser, "min or max");
  while (parser.accept(',')) {
    const double other = parse_float(parser, "min or max");
    best = largest ? std::max(best, other) : std::min(best, other);
  }
  return Number(best);
}

// select (A, NEGATIVE, ZERO, POSITIVE), or (A, NEGATIVE, OTHERWISE).
Number select(Parser& parser) {
  const double chosen = parse_float(parser, "select");
  skip_comma(parser);
  const Number negative = parse_number(parser);
  skip_comma(parser);
  const Number zero = parse_number(parser);
  const Number positive = parser.accept(',') ? parse_number(parser) : zero;
  return chosen < 0.0 ? negative : chosen == 0.0 ? zero : positive;
}

// A linear congruential generator of 32 bits: seed (N) gives a stream, rand (stream) its next
// number.
Number random(Parser& parser) {
  const double stream = parse_float(parser, "rand");
  if (!(stream >= 0.0 && stream < static_cast<double>(parser.random_states.size())))
    parser.fail("rand needs a stream of seed ()");
  std::uint32_t& state = parser.random_states[static_cast<std::size_t>(stream)];
  constexpr std::uint32_t factor = 1812433253u, summand = 12345u;
  constexpr double largest = 4294967295.0;
  state = state * factor + summand;
  return Number(static_cast<double>(state) / largest);
}

Number seed(Parser& parser) {
  const int value = parse_int(parser, "seed");
  parser.claim(sizeof(std::uint32_t));
  parser.random_states.push_back(static_cast<std::uint32_t>(value));
  return Number(static_cast<double>(parser.random_states.size() - 1));
}

V3d two_vectors(Parser& parser, V3d& second) {
  const V3d first = parse_vector(parser);
  skip_comma(parser);
  second = parse_vector(parser);
  return first;
}

Number turbulent_vector(Parser& parser) {
  Turbulence turbulence;
  turbulence.lambda = parse_float(parser, "vturbulence");
  skip_comma(parser);
  turbulence.omega = parse_float(parser, "vturbulence");
  skip_comma(parser);
  turbulence.octaves = parse_int(parser, "vturbulence");
  skip_comma(parser);
  return to_number(turbulence.at(parse_vector(parser)));
}

Number vector_function(Parser& parser, K keyword) {
  V3d b;
  switch (keyword) {
    case K::vlength_:
      return Number(parse_vector(parser).length());
    case K::vnormalize_:
      return to_number(parse_vector(parser).normalized());
    case K::vdot_: {
      const V3d a = two_vectors(parser, b);
      return Number(a.dot(b));
    }
    case K::vcross_: {
      const V3d a = two_vectors(parser, b);
      return to_number(a.cross(b));
    }
    case K::vrotate_: {
      const V3d a = two_vectors(parser, b);
      return to_number(a * rotation_matrix(b));
    }
    case K::vaxis_rotate_: {
      const V3d a = two_vectors(parser, b);
      skip_comma(parser);
      return to_number(a * axis_rotation_matrix(b, parse_float(parser, "vaxis_rotate")));
    }
    default:
      return turbulent_vector(parser);
  }
}

Number string_measure(Parser& parser, K keyword) {
  const std::string text = parse_string(parser, keyword_text(keyword));
  switch (keyword) {
    case K::asc_:
      return Number(text.empty() ? 0.0 : double(static_cast<unsigned char>(text[0])));
    case K::strlen_:
      return Number(static_cast<double>(text.size()));
    case K::val_:
      return Number(std::strtod(text.c_str(), nullptr));
    case K::file_exists_:
      return Number(parser.sources.exists(text, parser.source()) ? 1.0 : 0.0);
    default: {
      skip_comma(parser);
      const int order = text.compare(parse_string(parser, "strcmp"));
      return Number(order < 0 ? -1.0 : order > 0 ? 1.0 : 0.0);
    }
  }
}

Number array_measure(Parser& parser, K keyword) {
  const std::shared_ptr<const Array> held = parse_array_name(parser);
  const Array& array = *held;
  if (keyword == K::dimensions_) return Number(static_cast<double>(array.sizes.size()));
  skip_comma(parser);
  const int dimension = parse_int(parser, "dimension_size");
  if (dimension < 1 || static_cast<std::size_t>(dimension) > array.sizes.size())
    parser.fail("the array has no dimension " + std::to_string(dimension));
  return Number(array.sizes[static_cast<std::size_t>(dimension - 1)]);
}

Number call(Parser& parser, K keyword) {
  if (const FloatFunction* function = float_function(keyword))
    return call_float_function(parser, keyword, *function);
  switch (keyword) {
    case K::min_:
    case K::max_:
      return extreme(parser, keyword == K::max_);
    case K::select_:
      return select(parser);
    case K::rand_:
      return random(parser);
    case K::seed_:
      return seed(parser);
    case K::defined_:
      return Number(parse_defined(parser) ? 1.0 : 0.0);
    case K::asc_:
    case K::strlen_:
    case K::val_:
    case K::strcmp_:
    case K::file_exists_:
      return string_measure(parser, keyword);
    case K::dimensions_:
    case K::dimension_size_:
      return array_measure(parser, keyword);
    case K::min_extent_:
    case K::max_extent_:
      return extent_function(parser, keyword == K::max_extent_);
    case K::inside_:
    case K::trace_:
      parser.fail("the function " + std::string(keyword_text(keyword)) +
                      " needs the objects' surfaces, which are not known while a scene is read",
                  "replace it by numbers");
    default:
      return vector_function(parser, keyword);
  }
}

}  // namespace

bool begins_function_word(K keyword) {
  if (float_function(keyword)) return true;
  switch (keyword) {
    case K::min_:
    case K::max_:
    case K::select_:
    case K::rand_:
    case K::seed_:
    case K::defined_:
    case K::asc_:
    case K::strlen_:
    case K::val_:
    case K::strcmp_:
    case K::file_exists_:
    case K::dimensions_:
    case K::dimension_size_:
    case K::min_extent_:
    case K::max_extent_:
    case K::inside_:
    case K::trace_:
    case K::vlength_:
    case K::vnormalize_:
    case K::vdot_:
    case K::vcross_:
    case K::vrotate_:
    case K::vaxis_rotate_:
    case K::vturbulence_:
    // constants
    case K::pi_:
    case K::on_:
    case K::yes_:
    case K::true_:
    case K::off_:
    case K::false_:
    case K::clock_:
    case K::clock_delta_:
    case K::clock_on_:
    case K::initial_clock_:
    case K::final_clock_:
    case K::frame_number_:
    case K::initial_frame_:
    case K::final_frame_:
    case K::now_:
    case K::version_:
    case K::image_width_:
    case K::image_height_:
      return true;
    default:
      return false;
  }
}

Number parse_function_word(Parser& parser) {
  const K keyword = parser.peek().keyword();
  if (!begins_function_word(keyword)) parser.fail_expected("a number");
  if (const auto constant = float_constant(parser, keyword)) {
    parser.take();
    return Number(*constant);
  }
  const Nesting nesting(parser);
  parser.take();
  // The name of what defined () asks for must not be looked at before it is known to be a name.
  if (keyword == K::defined_) {
    if (!parser.raw_take().is('(')) parser.fail("'(' is expected after defined");
  } else {
    parser.expect('(', keyword_text(keyword));
  }
  const Number result = call(parser, keyword);
  parser.expect(')', keyword_text(keyword));
  return result;
}

}  // namespace lumivec::pov
