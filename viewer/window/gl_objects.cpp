#include "viewer/window/gl_objects.h"

#include <array>

namespace lumivec {
namespace {

std::string one_line(const char* text) {
  std::string line = text;
  for (char& c : line) {
    if (c == '\n' || c == '\r' || c == '\0') c = ' ';
  }
  return line;
}

GLuint compile(GLenum kind, const std::string& text) {
  const GLuint shader = glCreateShader(kind);
  const char* pointer = text.c_str();
  glShaderSource(shader, 1, &pointer, nullptr);
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::array<char, 1024> log{};
  glGetShaderInfoLog(shader, GLsizei(log.size()), nullptr, log.data());
  glDeleteShader(shader);
  throw GraphicsError("the graphics driver does not take the shader of this view: " +
                      one_line(log.data()) + "; choose another --view");
}

}  // namespace

GlProgram::GlProgram(const std::string& vertex, const std::string& fragment) {
  const GLuint first = compile(GL_VERTEX_SHADER, vertex);
  GLuint second = 0;
  try {
    second = compile(GL_FRAGMENT_SHADER, fragment);
  } catch (...) {
    glDeleteShader(first);
    throw;
  }
  name_ = glCreateProgram();
  glAttachShader(name_, first);
  glAttachShader(name_, second);
  glLinkProgram(name_);
  glDeleteShader(first);
  glDeleteShader(second);
  GLint linked = 0;
  glGetProgramiv(name_, GL_LINK_STATUS, &linked);
  if (linked) return;
  std::array<char, 1024> log{};
  glGetProgramInfoLog(name_, GLsizei(log.size()), nullptr, log.data());
  glDeleteProgram(name_);
  throw GraphicsError("the graphics driver does not take the shader of this view: " +
                      one_line(log.data()) + "; choose another --view");
}

GlCanvas::GlCanvas(int width, int height, GLenum format) {
  texture_.bind(0);
  texture_.sample(GL_NEAREST);
  glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  glGenFramebuffers(1, &name_);
  glBindFramebuffer(GL_FRAMEBUFFER, name_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  glDeleteFramebuffers(1, &name_);
  throw GraphicsError("the graphics driver has no room for a picture of " + std::to_string(width) +
                      "x" + std::to_string(height));
}

}  // namespace lumivec
