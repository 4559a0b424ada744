#include "loader/pov/colors.h"

#include <cmath>

#include "loader/pov/expression.h"

namespace lumivec::pov {
namespace {

double linear_from_srgb(double x) {
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

// The number as a color whose third, fourth and fifth components mean what the word says.
Number parse_rgb_word(Parser& parser, K word) {
  const bool encoded =
      word == K::srgb_ || word == K::srgbf_ || word == K::srgbt_ || word == K::srgbft_;
  const bool transmit_fourth = word == K::rgbt_ || word == K::srgbt_;
  Number given = parse_number(parser);
  std::size_t used = 3;
  if (word == K::rgbf_ || word == K::srgbf_ || transmit_fourth) used = 4;
  if (word == K::rgbft_ || word == K::srgbft_) used = 5;
  if (given.size == 1) given.n.fill(given.n[0]);
  if (given.color) used = 5;  // rgb Red keeps what Red has
  Number color;
  color.size = 5;
  color.color = true;
  for (std::size_t i = 0; i < used; ++i) color.n[i] = given.n[i];
  if (transmit_fourth && !given.color) std::swap(color.n[3], color.n[4]);
  if (encoded) {
    const double gamma = parser.scene.settings.assumed_gamma;
    for (std::size_t i = 0; i < 3; ++i)
      color.n[i] = std::pow(linear_from_srgb(std::max(color.n[i], 0.0)), 1.0 / gamma);
  }
  return color;
}

int channel(K word) {
  switch (word) {
    case K::red_:
      return 0;
    case K::green_:
      return 1;
    case K::blue_:
      return 2;
    case K::filter_:
      return 3;
    case K::transmit_:
    case K::alpha_:
      return 4;
    default:
      return -1;
  }
}

bool is_rgb_word(K word) {
  return word == K::rgb_ || word == K::rgbf_ || word == K::rgbt_ || word == K::rgbft_ ||
         word == K::srgb_ || word == K::srgbf_ || word == K::srgbt_ || word == K::srgbft_;
}

}  // namespace

bool begins_color_word(K word) {
  return word == K::color_ || is_rgb_word(word) || channel(word) >= 0;
}

bool begins_color(Parser& parser) {
  return begins_color_word(parser.peek().keyword()) || begins_number(parser);
}

Number parse_color_number(Parser& parser) {
  Number color;
  color.size = 5;
  color.color = true;
  bool begun = false;
  for (;;) {
    const K word = parser.peek().keyword();
    if (word == K::color_ && !begun) {
      parser.take();
    } else if (const int index = channel(word); index >= 0) {
      parser.take();
      color.n[static_cast<std::size_t>(index)] = parse_float(parser, "a color");
      begun = true;
    } else if (!begun && is_rgb_word(word)) {
      parser.take();
      color = parse_rgb_word(parser, word);
      begun = true;
    } else if (!begun && begins_number(parser)) {
      const Number given = parse_number(parser);
      color.n = given.n;
      if (given.size == 1) color.n.fill(given.n[0]);
      for (std::size_t i = given.size == 1 ? 5 : given.size; i < 5; ++i) color.n[i] = 0.0;
      begun = true;
    } else {
      break;
    }
  }
  if (!begun) parser.fail_expected("a color");
  return color;
}

ColorFT to_color(const Number& number) {
  if (number.size == 1) return {number.n[0], number.n[0], number.n[0], 0.0, 0.0};
  ColorFT color;
  double* const channels[5] = {&color.red, &color.green, &color.blue, &color.filter,
                               &color.transmit};
  for (std::size_t i = 0; i < number.size; ++i) *channels[i] = number.n[i];
  return color;
}

ColorFT parse_color(Parser& parser) {
  return to_color(parse_color_number(parser));
}

std::array<double, 3> parse_rgb(Parser& parser) {
  const ColorFT color = parse_color(parser);
  return {color.red, color.green, color.blue};
}

}  // namespace lumivec::pov
