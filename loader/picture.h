// PNG, JPEG and WebP in memory to Image, through OpenImageIO.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "loader/scene.h"

namespace lumivec {

// Reads the first picture of a file by what its bytes say it is. 8-bit channels stay as they are;
// deeper ones become floats on the scale where full is 1. Grey is copied to red, green and blue; a
// missing alpha is 1. claim(bytes) is called before the pixels are allocated, and may throw. Throws
// std::runtime_error with one line that says why a picture cannot be read.
Image decode_picture(std::span<const std::uint8_t> file,
                     const std::function<void(std::uint64_t bytes)>& claim);

}  // namespace lumivec
