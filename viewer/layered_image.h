// Reads the colour layers of a linear picture file.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "viewer/picture.h"

namespace lumivec {

// What a layer without a name is called here: the channels R, G, B.
constexpr const char* beauty_layer = "beauty";

struct LayeredImage {
  int width = 0;                          // pixels, of the data window
  int height = 0;                         // pixels
  std::map<std::string, Picture> layers;  // by the part of the channel names before .R, .G, .B
};

// Every layer that has .R, .G and .B, of all parts of the file; channels of other kinds are passed
// over. Throws CommandError if the file cannot be read, holds no such layer, or holds displayed (8-
// or 16-bit) values.
LayeredImage read_layered_image(const std::filesystem::path& file);

}  // namespace lumivec
