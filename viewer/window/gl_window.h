// A window with a context of OpenGL 3.3, or a line that says why there is none.
#pragma once

#include <string>

struct GLFWwindow;

namespace lumivec {

// Whether the driver draws with the processor, whose time the light then lacks. Needs a context.
bool draws_in_software();

class GlWindow {
 public:
  // visible: false keeps it off the screen, for tests. Throws CommandError that names `lumivec
  // render` as the way on.
  GlWindow(int width, int height, const std::string& title, bool visible);
  ~GlWindow();
  GlWindow(const GlWindow&) = delete;
  GlWindow& operator=(const GlWindow&) = delete;

  GLFWwindow* handle() const { return window_; }

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace lumivec
