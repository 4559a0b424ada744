#include "viewer/window/gpu_display.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "viewer/ocio_config.h"
#include "viewer/window/false_color.h"

namespace OCIO = OCIO_NAMESPACE;

namespace lumivec {
namespace {

constexpr int first_table_unit = 2;  // the two pictures come before

// One triangle that covers everything.
constexpr const char* vertex_shader = R"(#version 330 core
void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 4.0 - 1.0;
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";

constexpr const char* fragment_head = R"(#version 330 core
uniform sampler2D picture;
uniform sampler2D second;
uniform vec4 viewport;
uniform float scale;
uniform float most;
uniform float wipe;
uniform int mode;
uniform int channel;
out vec4 shown;
)";

// Values that are not finite are black in a view, as in DisplayTransform.
constexpr const char* fragment_main = R"(
float clean(float v) { return isnan(v) || isinf(v) ? 0.0 : clamp(v, -most, most); }
vec3 taken_from(sampler2D from, vec2 place) {
  ivec2 size = textureSize(from, 0);
  ivec2 at = clamp(ivec2(floor(place * vec2(size))), ivec2(0), size - 1);
  return texelFetch(from, at, 0).rgb;
}
vec3 chosen(vec3 c) {
  if (channel == 1) return vec3(c.r);
  if (channel == 2) return vec3(c.g);
  if (channel == 3) return vec3(c.b);
  if (channel == 4) return vec3(dot(c, vec3(0.2126, 0.7152, 0.0722)));
  return c;
}
vec3 nan_map(vec3 c) {
  if (isnan(c.r) || isnan(c.g) || isnan(c.b)) return vec3(1.0, 0.0, 1.0);
  if (isinf(c.r) || isinf(c.g) || isinf(c.b)) return vec3(1.0, 1.0, 0.0);
  if (c.r < 0.0 || c.g < 0.0 || c.b < 0.0) return vec3(0.0, 1.0, 1.0);
  float bright = dot(c, vec3(0.2126, 0.7152, 0.0722)) * scale;
  return vec3(0.1 + 0.2 * bright / (1.0 + bright));
}
void main() {
  vec2 place = (gl_FragCoord.xy - viewport.xy) / viewport.zw;
  place.y = 1.0 - place.y;
  vec3 c = place.x < wipe ? taken_from(second, place) : taken_from(picture, place);
  vec3 result;
  if (mode == 3) {
    result = c;
  } else if (mode == 2) {
    result = nan_map(c);
  } else {
    vec3 exposed = c * scale;
    exposed = chosen(vec3(clean(exposed.r), clean(exposed.g), clean(exposed.b)));
    result = mode == 1 ? false_color(exposed) : to_display(vec4(exposed, 1.0)).rgb;
  }
  shown = vec4(result, 1.0);
}
)";

}  // namespace

struct GpuDisplay::Shader {
  std::unique_ptr<GlProgram> program;
  std::vector<std::unique_ptr<GlTexture>> tables;
  GLint viewport = -1, scale = -1, wipe = -1, mode = -1, channel = -1;

  void add_table(const std::string& sampler, GLenum target, GLint filter,
                 const std::function<void()>& fill) {
    auto table = std::make_unique<GlTexture>(target);
    const int unit = first_table_unit + int(tables.size());
    table->bind(unit);
    table->sample(filter);
    fill();
    glUniform1i(program->place(sampler.c_str()), unit);
    tables.push_back(std::move(table));
  }

  void add_tables(const OCIO::GpuShaderDescRcPtr& description);
};

void GpuDisplay::Shader::add_tables(const OCIO::GpuShaderDescRcPtr& description) {
  const auto filter = [](OCIO::Interpolation interpolation) {
    return interpolation == OCIO::INTERP_NEAREST ? GL_NEAREST : GL_LINEAR;
  };
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (unsigned i = 0; i < description->getNum3DTextures(); ++i) {
    const char *name = nullptr, *sampler = nullptr;
    unsigned edge = 0;
    OCIO::Interpolation interpolation = OCIO::INTERP_LINEAR;
    const float* values = nullptr;
    description->get3DTexture(i, name, sampler, edge, interpolation);
    description->get3DTextureValues(i, values);
    add_table(sampler, GL_TEXTURE_3D, filter(interpolation), [&] {
      const auto side = GLsizei(edge);
      glTexImage3D(GL_TEXTURE_3D, 0, GL_RGB32F, side, side, side, 0, GL_RGB, GL_FLOAT, values);
    });
  }
  for (unsigned i = 0; i < description->getNumTextures(); ++i) {
    const char *name = nullptr, *sampler = nullptr;
    unsigned width = 0, height = 0;
    OCIO::GpuShaderDesc::TextureType type = OCIO::GpuShaderDesc::TEXTURE_RGB_CHANNEL;
    OCIO::Interpolation interpolation = OCIO::INTERP_LINEAR;
    const float* values = nullptr;
    description->getTexture(i, name, sampler, width, height, type, interpolation);
    description->getTextureValues(i, values);
    const bool red = type == OCIO::GpuShaderDesc::TEXTURE_RED_CHANNEL;
    const GLint inside = red ? GL_R32F : GL_RGB32F;
    const GLenum format = red ? GL_RED : GL_RGB;
    // What is one row high is declared as sampler1D.
    const GLenum target = height > 1 ? GL_TEXTURE_2D : GL_TEXTURE_1D;
    add_table(sampler, target, filter(interpolation), [&] {
      if (target == GL_TEXTURE_1D) {
        glTexImage1D(target, 0, inside, GLsizei(width), 0, format, GL_FLOAT, values);
      } else {
        glTexImage2D(target, 0, inside, GLsizei(width), GLsizei(height), 0, format, GL_FLOAT,
                     values);
      }
    });
  }
}

GpuDisplay::GpuDisplay(const DisplayOptions& options) {
  set_transform(options);
}
GpuDisplay::~GpuDisplay() = default;

void GpuDisplay::set_transform(const DisplayOptions& options) {
  const DisplayOptions found = find_display(options);
  const OCIO::ConstConfigRcPtr config = load_ocio_config(found.config);
  OCIO::GpuShaderDescRcPtr description = OCIO::GpuShaderDesc::CreateShaderDesc();
  description->setLanguage(OCIO::GPU_LANGUAGE_GLSL_1_3);
  description->setFunctionName("to_display");
  description->setResourcePrefix("ocio_");
  try {
    display_processor(config, found.display, found.view, found.look)
        ->getDefaultGPUProcessor()
        ->extractGpuShaderInfo(description);
  } catch (const OCIO::Exception& error) {
    throw DisplayError("view '" + found.view + "': cannot be computed on the graphics card: " +
                       error.what() + "; choose another --view");
  }
  auto shader = std::make_unique<Shader>();
  shader->program = std::make_unique<GlProgram>(
      vertex_shader, std::string(fragment_head) + description->getShaderText() +
                         false_color_shader() + fragment_main);
  const GlProgram& program = *shader->program;
  program.use();
  shader->viewport = program.place("viewport");
  shader->scale = program.place("scale");
  shader->wipe = program.place("wipe");
  shader->mode = program.place("mode");
  shader->channel = program.place("channel");
  glUniform1i(program.place("picture"), 0);
  glUniform1i(program.place("second"), 1);
  glUniform1f(program.place("most"), most_displayed);
  shader->add_tables(description);
  shader_ = std::move(shader);
  ++changes_;
  names_ = {display_names(config), view_names(config, found.display), look_names(config), found};
}

void GpuDisplay::upload(int which, const Color* pixels, int width, int height) {
  Uploaded& picture = pictures_.at(std::size_t(which));
  ++changes_;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, picture.texture.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  static_assert(sizeof(Color) == 3 * sizeof(float));
  if (picture.width != width || picture.height != height) {
    picture.texture.sample(GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, width, height, 0, GL_RGB, GL_FLOAT, pixels);
    picture.width = width;
    picture.height = height;
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_FLOAT, pixels);
  }
}

void GpuDisplay::draw(const Viewport& viewport, const DisplayLook& look) const {
  if (pictures_[0].width == 0 || viewport.width <= 0 || viewport.height <= 0) return;
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  shader_->program->use();
  for (int i = 0; i < 2; ++i) pictures_[std::size_t(i)].texture.bind(i);
  for (std::size_t i = 0; i < shader_->tables.size(); ++i)
    shader_->tables[i]->bind(first_table_unit + int(i));
  glUniform4f(shader_->viewport, float(viewport.x), float(viewport.y), float(viewport.width),
              float(viewport.height));
  glUniform1f(shader_->scale, float(std::exp2(look.exposure)));
  glUniform1f(shader_->wipe, pictures_[1].width > 0 ? look.wipe : 0.0f);
  glUniform1i(shader_->mode, int(look.mode));
  glUniform1i(shader_->channel, int(look.channel));
  vertices_.bind();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glActiveTexture(GL_TEXTURE0);
}

Picture read_back(const Viewport& viewport) {
  Picture picture(viewport.width, viewport.height);
  std::vector<Color> rows(picture.pixels.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(viewport.x, viewport.y, viewport.width, viewport.height, GL_RGB, GL_FLOAT,
               rows.data());
  const auto width = std::ptrdiff_t(picture.width);
  for (int y = 0; y < picture.height; ++y) {
    const auto from = rows.begin() + std::ptrdiff_t(picture.height - 1 - y) * width;
    std::copy(from, from + width, picture.pixels.begin() + y * width);
  }
  return picture;
}

}  // namespace lumivec
