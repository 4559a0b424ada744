// Pictures to files: OpenEXR with all layers, PNG and JPEG as displayed. Every file is written
// atomically.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "integrator/framebuffer.h"
#include "viewer/exr_layers.h"
#include "viewer/picture.h"

namespace lumivec {

enum class StillFormat : std::uint8_t { exr, png, jpeg };

// By the extension, whatever its case. Throws UsageError for one that is not .exr, .png, .jpg or
// .jpeg.
StillFormat still_format(const std::filesystem::path& file);

// What the header of a picture says of how it was made.
struct StillHeader {
  std::string scene;     // the scene file, as the user named it
  std::string settings;  // the command's options
  double samples = 0.0;  // a pixel, mean
  double seconds = 0.0;  // of sampling
};

struct ExrOptions {
  std::uint32_t terms = (1u << term_count) - 1;  // layers to write, bits as RenderSettings::terms
  ExrPrecision precision = ExrPrecision::half;
  std::uint32_t beauty = (1u << term_count) - 1;  // which of them add up to the beauty
};

// Writes all layers (exr_layers.h). Returns how many pixels had to be clamped to half's range.
// Throws CommandError.
std::uint64_t write_exr(const std::filesystem::path& file, const Framebuffer& framebuffer,
                        const ExrOptions& options, const StillHeader& header);

struct DisplayedOptions {
  int bits = 8;         // a channel: 8, or 16 (PNG only)
  bool is_srgb = true;  // say so in the file
};

// Writes a PNG or JPEG, by the extension. displayed: display-encoded, clamped to [0, 1] here and
// rounded to nearest. Throws CommandError.
void write_displayed(const std::filesystem::path& file, const Picture& displayed,
                     const DisplayedOptions& options, const StillHeader& header);

}  // namespace lumivec
