// Where the camera goes: one view a frame.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

// As a user writes it: "orbit:DEGREES", "dolly:UNITS", or the name of a file.
struct CameraPathChoice {
  enum class Kind : std::uint8_t { orbit, dolly, file } kind = Kind::orbit;
  double amount = 0.0;  // orbit: degrees in all, counter-clockwise seen from above; dolly: scene
                        // units in all, forward
  std::filesystem::path file;
};

// Throws UsageError.
CameraPathChoice parse_camera_path(const std::string& option, const std::string& text);

// Views of `frames` (≥ 1) frames, the first of them the camera's own unless a file says otherwise.
// pivot: what an orbit goes around, world space. A file is JSON,
//   {"keys": [{"eye": [x, y, z], "target": [x, y, z], "up": [x, y, z], "yfov": DEGREES}, …]},
// with at least one key, which are spread evenly over the frames and joined by straight lines; up
// and yfov may be left out: +Y, and the camera's own. Throws CommandError.
std::vector<Camera> camera_path(const CameraPathChoice& choice, const Camera& camera,
                                const V3d& pivot, int frames);

// A camera at eye that looks at target, with everything else the camera's own.
Camera look_from(const Camera& camera, const V3d& eye, const V3d& target, const V3d& up);

}  // namespace lumivec
