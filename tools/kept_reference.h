// Converged pictures by path tracing that are rendered once and kept in a folder: an OpenEXR file
// with all terms, and beside it a JSON file that says what it is of and how noisy it is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "loader/scene.h"
#include "tools/term_errors.h"

namespace lumivec {

// Seeds of a reference's halves. What is compared with it takes another, or both would share their
// noise.
constexpr std::uint64_t reference_seeds[2] = {0x7265660001, 0x7265660002};

struct ReferenceRequest {
  std::filesystem::path scene_file;
  int width = 0, height = 0;  // pixels
  int samples = 0;            // a pixel, even: half of them for each seed
  int threads = 0;            // 0: all processors
  std::filesystem::path folder;
};

struct Reference {
  TermPictures pictures;
  TermNoise noise;
  double core_seconds = 0.0;  // that rendering it took
  bool was_kept = false;      // it was read and not rendered
};

// Reads the reference if the folder holds one of that scene, size and number of samples; else
// calls before_rendering, renders it by the scene's first camera and keeps it. Throws RenderError,
// UsageError and CommandError.
Reference kept_reference(const Scene& scene, const ReferenceRequest& request,
                         const std::function<void()>& before_rendering = {});

// Where the picture is kept; the JSON file has the same name with .json.
std::filesystem::path reference_file(const ReferenceRequest& request);

// Of the scene file and of the buffers and images that it names, as 16 hexadecimal digits. Throws
// CommandError if the scene file cannot be read.
std::string scene_hash(const std::filesystem::path& scene_file);

}  // namespace lumivec
