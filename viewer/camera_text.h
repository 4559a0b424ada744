// A view as a line of text, to copy and paste between the window and the command line:
//
//   eye=0.28,0.27,-0.8/target=0.28,0.27,0/up=0,1,0/yfov=39.3
//
// eye and target are needed; up (+Y) and yfov (degrees), or ymag (half the height, scene units) for
// a parallel view, are the given camera's unless they are said. No part needs quotes in a shell.
#pragma once

#include <string>

#include "loader/scene.h"

namespace lumivec {

// Whether text means a view and not a camera's name.
bool is_camera_text(const std::string& text);

// target is where the view axis comes nearest to it.
std::string camera_text(const Camera& camera, const V3d& target);

// usual: what the text leaves open. option: for the message. Throws UsageError.
Camera parse_camera_text(const std::string& option, const std::string& text, const Camera& usual);

}  // namespace lumivec
