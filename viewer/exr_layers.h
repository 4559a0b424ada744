// What an OpenEXR picture of a render holds, channel by channel.
//
//   R G B                  the beauty: the sum of the layers that it is to show, rounded once
//   emitted.R … caustic.B  the five terms, those that were computed; radiance
//   albedo.R … albedo.B    first hit, [0, 1]
//   N.X N.Y N.Z            first hit's normal, world space
//   P.X P.Y P.Z            first hit's position, world space, scene units; always float
//   Z                      depth along the view axis, scene units, +inf for no hit; always float
//   id                     instance's index in the scene + 1, 0 for no hit; always float
//
// In half precision a value beyond 65504 is stored as 65504, and its pixel is counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "integrator/framebuffer.h"

namespace lumivec {

enum class ExrPrecision : std::uint8_t { half, single };

struct ExrChannel {
  std::string name;
  bool is_half = false;
  std::function<float(const Framebuffer&, std::size_t pixel)>
      value;  // what to store, before rounding to half
};

// The channels of a render of these terms (bits as RenderSettings::terms), in the order of the list
// above. beauty: which of them are its sum.
std::vector<ExrChannel> exr_channels(std::uint32_t terms, ExrPrecision precision,
                                     std::uint32_t beauty);

// Bytes of one pixel in channel order without padding, as OpenImageIO takes them.
std::size_t exr_pixel_bytes(const std::vector<ExrChannel>& channels);

// Writes pixels [begin, end) to bytes (exr_pixel_bytes each). Returns how many of them had a value
// clamped to half's range.
std::uint64_t pack_exr_pixels(const Framebuffer& framebuffer,
                              const std::vector<ExrChannel>& channels, std::size_t begin,
                              std::size_t end, std::byte* bytes);

}  // namespace lumivec
