// A camera path as the window records it: keys that walk --path reads and that are played back as
// it walks them.
#pragma once

#include <string>
#include <vector>

#include "viewer/window/orbit_camera.h"

namespace lumivec {

// JSON as camera_path.h describes it. keys: at least one.
std::string camera_keys_text(const std::vector<OrbitCamera>& keys);

// Straight from key to key; place: [0, keys.size() - 1]. keys: at least one.
OrbitCamera camera_between(const std::vector<OrbitCamera>& keys, double place);

}  // namespace lumivec
