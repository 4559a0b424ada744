#include "loader/pov/expression.h"
#include "loader/pov/patterns.h"
#include "loader/pov/strings.h"

namespace lumivec::pov {
namespace {

bool is_format(K word) {
  switch (word) {
    case K::gif_:
    case K::tga_:
    case K::iff_:
    case K::ppm_:
    case K::pgm_:
    case K::png_:
    case K::jpeg_:
    case K::tiff_:
    case K::pot_:
    case K::sys_:
    case K::df3_:
      return true;
    default:
      return false;
  }
}

// all NUMBER, or INDEX, NUMBER.
std::pair<int, double> parse_palette_entry(Parser& parser) {
  int index = -1;
  if (!parser.accept(K::all_)) {
    index = parse_int(parser, "an index of a palette");
    skip_comma(parser);
  }
  return {index, parse_float(parser, "an image")};
}

}  // namespace

ImageUse parse_image_file(Parser& parser) {
  ImageUse image;
  image.named_in = parser.source();
  if (is_format(parser.peek().keyword())) {
    image.format = parser.take().keyword();
    image.named_in = parser.source();
  } else {
    image.format = K::keyword_count;  // as the file's bytes say
  }
  image.file = parse_file_name(parser, "an image file");
  if (parser.accept(K::gamma_))
    image.gamma = begins_number(parser) ? parse_float(parser, "gamma") : (parser.take(), 0.0);
  return image;
}

std::shared_ptr<const ImageUse> parse_image_block(Parser& parser, double* bump_size) {
  parser.expect('{', "an image");
  auto image = std::make_shared<ImageUse>(parse_image_file(parser));
  while (!parser.accept('}')) {
    if (parser.accept(K::map_type_)) {
      image->map_type = parse_int(parser, "map_type");
    } else if (parser.accept(K::once_)) {
      image->once = true;
    } else if (parser.accept(K::interpolate_)) {
      image->interpolate = parse_int(parser, "interpolate");
    } else if (parser.accept(K::use_index_)) {
      image->use_index = true;
    } else if (parser.accept(K::use_color_) || parser.accept(K::use_alpha_)) {
      image->use_index = false;
    } else if (bump_size && parser.accept(K::bump_size_)) {
      *bump_size = parse_float(parser, "bump_size");
    } else if (parser.accept(K::filter_)) {
      image->filter.push_back(parse_palette_entry(parser));
    } else if (parser.accept(K::transmit_)) {
      image->transmit.push_back(parse_palette_entry(parser));
    } else if (!parser.accept(',')) {
      parser.fail_expected("a modifier of an image, or '}',");
    }
  }
  return image;
}

}  // namespace lumivec::pov
