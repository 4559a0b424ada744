// Displays of more dots an inch: some systems count windows in dots and say how large text should
// be (X11, Windows), others count in larger units of several dots (macOS, Wayland).
#pragma once

#include <algorithm>

namespace lumivec {

struct WindowScale {
  float interface = 1.0f;  // window units of what is one unit on a display of usual density
  float density = 1.0f;    // dots of the framebuffer a window unit

  bool operator==(const WindowScale&) const = default;
};

// content: what glfwGetWindowContentScale says; the widths: of one window, in its units and in
// dots.
inline WindowScale window_scale(float content, int window_width, int framebuffer_width) {
  WindowScale scale;
  if (window_width > 0 && framebuffer_width > 0)
    scale.density = float(framebuffer_width) / float(window_width);
  scale.interface = std::max(1.0f, content / scale.density);
  return scale;
}

}  // namespace lumivec
