#include "viewer/exr_layers.h"

#include <half.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>

namespace lumivec {
namespace {

constexpr float largest_half = 65504.0f;
constexpr std::array<const char*, 3> rgb = {".R", ".G", ".B"};
constexpr std::array<const char*, 3> xyz = {".X", ".Y", ".Z"};

float rounded_to_half(float value) {
  return half(std::clamp(value, -largest_half, largest_half));  // NaN passes
}

void add_beauty(std::vector<ExrChannel>& channels, std::uint32_t terms, bool is_half) {
  for (int c = 0; c < 3; ++c) {
    channels.push_back({rgb[std::size_t(c)] + 1, is_half, [=](const Framebuffer& f, std::size_t i) {
                          double sum = 0.0;
                          for (std::size_t t = 0; t < std::size_t(term_count); ++t) {
                            if (!(terms >> t & 1u)) continue;
                            const float value = f.terms[t][i][c];
                            sum += double(is_half ? rounded_to_half(value) : value);
                          }
                          return float(sum);
                        }});
  }
}

}  // namespace

std::vector<ExrChannel> exr_channels(std::uint32_t terms, ExrPrecision precision,
                                     std::uint32_t beauty) {
  const bool is_half = precision == ExrPrecision::half;
  std::vector<ExrChannel> channels;
  add_beauty(channels, terms & beauty, is_half);
  for (std::size_t t = 0; t < std::size_t(term_count); ++t) {
    if (!(terms >> t & 1u)) continue;
    for (int c = 0; c < 3; ++c) {
      channels.push_back({std::string(term_names[t]) + rgb[std::size_t(c)], is_half,
                          [=](const Framebuffer& f, std::size_t i) { return f.terms[t][i][c]; }});
    }
  }
  for (int c = 0; c < 3; ++c) {
    channels.push_back({std::string("albedo") + rgb[std::size_t(c)], is_half,
                        [=](const Framebuffer& f, std::size_t i) { return f.albedo[i][c]; }});
  }
  for (int c = 0; c < 3; ++c) {
    channels.push_back({std::string("N") + xyz[std::size_t(c)], is_half,
                        [=](const Framebuffer& f, std::size_t i) { return f.normal[i][c]; }});
  }
  for (int c = 0; c < 3; ++c) {
    channels.push_back({std::string("P") + xyz[std::size_t(c)], false,
                        [=](const Framebuffer& f, std::size_t i) { return f.position[i][c]; }});
  }
  channels.push_back({"Z", false, [](const Framebuffer& f, std::size_t i) { return f.depth[i]; }});
  channels.push_back(
      {"id", false, [](const Framebuffer& f, std::size_t i) { return float(f.object[i] + 1); }});
  return channels;
}

std::size_t exr_pixel_bytes(const std::vector<ExrChannel>& channels) {
  std::size_t bytes = 0;
  for (const ExrChannel& channel : channels)
    bytes += channel.is_half ? sizeof(half) : sizeof(float);
  return bytes;
}

std::uint64_t pack_exr_pixels(const Framebuffer& framebuffer,
                              const std::vector<ExrChannel>& channels, std::size_t begin,
                              std::size_t end, std::byte* bytes) {
  assert(end <= framebuffer.pixel_count());
  std::uint64_t clamped_pixels = 0;
  for (std::size_t i = begin; i < end; ++i) {
    bool clamped = false;
    for (const ExrChannel& channel : channels) {
      const float value = channel.value(framebuffer, i);
      if (channel.is_half) {
        clamped = clamped || value > largest_half || value < -largest_half;
        const half rounded(rounded_to_half(value));
        std::memcpy(bytes, &rounded, sizeof rounded);
        bytes += sizeof rounded;
      } else {
        std::memcpy(bytes, &value, sizeof value);
        bytes += sizeof value;
      }
    }
    clamped_pixels += clamped;
  }
  return clamped_pixels;
}

}  // namespace lumivec
