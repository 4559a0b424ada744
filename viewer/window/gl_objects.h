// OpenGL 3.3 objects that end with their owner. All of this needs a current context.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <stdexcept>
#include <string>

namespace lumivec {

// The graphics driver refuses; what() is one line for the user.
class GraphicsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class GlTexture {
 public:
  explicit GlTexture(GLenum target) : target_(target) { glGenTextures(1, &name_); }
  ~GlTexture() { glDeleteTextures(1, &name_); }
  GlTexture(const GlTexture&) = delete;
  GlTexture& operator=(const GlTexture&) = delete;

  void bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + GLenum(unit));
    glBindTexture(target_, name_);
  }
  // filter: GL_NEAREST or GL_LINEAR; never repeated.
  void sample(GLint filter) const {
    glTexParameteri(target_, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(target_, GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
      glTexParameteri(target_, wrap, GL_CLAMP_TO_EDGE);
  }
  GLenum target() const { return target_; }
  GLuint name() const { return name_; }

 private:
  GLenum target_;
  GLuint name_ = 0;
};

// A vertex array without attributes, which core profiles want bound to draw anything.
class GlVertexArray {
 public:
  GlVertexArray() { glGenVertexArrays(1, &name_); }
  ~GlVertexArray() { glDeleteVertexArrays(1, &name_); }
  GlVertexArray(const GlVertexArray&) = delete;
  GlVertexArray& operator=(const GlVertexArray&) = delete;
  void bind() const { glBindVertexArray(name_); }

 private:
  GLuint name_ = 0;
};

class GlProgram {
 public:
  // Throws GraphicsError with what the driver says.
  GlProgram(const std::string& vertex, const std::string& fragment);
  ~GlProgram() { glDeleteProgram(name_); }
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const { glUseProgram(name_); }
  // -1, which OpenGL passes over, for what the shader does not use.
  GLint place(const char* uniform) const { return glGetUniformLocation(name_, uniform); }

 private:
  GLuint name_ = 0;
};

// Something to draw on that is no window.
class GlCanvas {
 public:
  // format: GL_RGBA8, GL_RGBA32F. Throws GraphicsError.
  GlCanvas(int width, int height, GLenum format);
  ~GlCanvas() { glDeleteFramebuffers(1, &name_); }
  GlCanvas(const GlCanvas&) = delete;
  GlCanvas& operator=(const GlCanvas&) = delete;
  void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, name_); }
  // Copies take it from here.
  void read() const { glBindFramebuffer(GL_READ_FRAMEBUFFER, name_); }

 private:
  GlTexture texture_{GL_TEXTURE_2D};
  GLuint name_ = 0;
};

}  // namespace lumivec
