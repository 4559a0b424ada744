#include "viewer/window/gl_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

#include "viewer/errors.h"
#include "viewer/window/gl_objects.h"

namespace lumivec {
namespace {

std::string reason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason is given";
}

constexpr const char* remedy = "; without a window, write: lumivec render SCENE -o OUT.png";

}  // namespace

bool draws_in_software() {
  const GLubyte* name = glGetString(GL_RENDERER);
  const std::string renderer = name ? reinterpret_cast<const char*>(name) : "";
  constexpr std::array<const char*, 4> known = {"llvmpipe", "softpipe", "SwiftShader",
                                                "GDI Generic"};
  return std::any_of(known.begin(), known.end(), [&](const char* software) {
    return renderer.find(software) != std::string::npos;
  });
}

GlWindow::GlWindow(int width, int height, const std::string& title, bool visible) {
  glfwInitHint(GLFW_JOYSTICK_HAT_BUTTONS, GLFW_FALSE);
  if (!glfwInit()) throw CommandError("view: there is no display (" + reason() + ")" + remedy);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const std::string why = reason();
    glfwTerminate();
    throw CommandError("view: there is no OpenGL 3.3 (" + why + ")" + remedy);
  }
  glfwMakeContextCurrent(window_);
}

GlWindow::~GlWindow() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

}  // namespace lumivec
