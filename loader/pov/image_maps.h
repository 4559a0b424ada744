// Pictures that pigments show.
#pragma once

#include <optional>

#include "loader/pov/parser.h"

namespace lumivec::pov {

// Colors as the scene would write them: after its assumed_gamma.
struct MapPicture {
  int width = 0, height = 0;                 // pixels
  std::vector<std::array<float, 4>> pixels;  // row 0 at the top; red, green, blue, opacity
  std::array<float, 4> mean{};
};

// After image_map: a picture with what is said of it. One that cannot be had is mentioned, and then
// shows nothing.
std::shared_ptr<const ImageUse> parse_image_map(Parser& parser);

// At a point of the pigment's space: planar, spherical and cylindrical maps. None: the picture is
// not there, or mapped otherwise.
std::optional<ColorFT> image_color(const ImageUse& image, const V3d& point);

// Of the whole picture; white where there is none.
ColorFT mean_image_color(const ImageUse& image);

}  // namespace lumivec::pov
