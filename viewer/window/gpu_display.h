// Shows pictures through OpenColorIO's own shader, on the graphics card: what DisplayTransform
// does for files. A current context of OpenGL 3.3 is needed for all of it.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "viewer/display_transform.h"
#include "viewer/window/gl_objects.h"

namespace lumivec {

// What is made of a picture's values.
enum class DisplayMode : std::uint8_t {
  view,         // through OpenColorIO
  false_color,  // false_color.h
  nan_map,      // not a number: magenta, infinite: yellow, negative: cyan; the rest dim
  encoded       // as it is: the picture has been displayed already
};

enum class Channel : std::uint8_t { color, red, green, blue, luminance };
constexpr std::array<const char*, 5> channel_names = {"Colour", "Red", "Green", "Blue",
                                                      "Luminance"};

struct DisplayLook {
  DisplayMode mode = DisplayMode::view;
  Channel channel = Channel::color;
  double exposure = 0.0;  // stops
  float wipe = 0.0f;      // left of this share of the width the second picture is shown
  bool operator==(const DisplayLook&) const = default;
};

// Part of what is drawn on, pixels from the lower left corner as OpenGL counts.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Viewport&) const = default;
};

// What a configuration offers beside what is chosen.
struct DisplayNames {
  std::vector<std::string> displays, views, looks;  // views: of the chosen display
  DisplayOptions chosen;
};

class GpuDisplay {
 public:
  // Throws as DisplayTransform, and GraphicsError.
  explicit GpuDisplay(const DisplayOptions& options);
  ~GpuDisplay();

  // Leaves all as it was if it throws.
  void set_transform(const DisplayOptions& options);
  const DisplayNames& names() const { return names_; }

  // pixels: width × height, row 0 at the top; which: 0 the picture, 1 the second one.
  void upload(int which, const Color* pixels, int width, int height);

  // Of the first picture; 0 before there is one.
  int picture_width() const { return pictures_[0].width; }
  int picture_height() const { return pictures_[0].height; }

  // Counts what draw() shows otherwise from then on.
  std::uint64_t changes() const { return changes_; }

  // Stretched over the viewport, pixel by pixel without any smoothing. Nothing before the first
  // upload.
  void draw(const Viewport& viewport, const DisplayLook& look) const;

 private:
  struct Shader;
  struct Uploaded {
    GlTexture texture{GL_TEXTURE_2D};
    int width = 0, height = 0;
  };

  DisplayNames names_;
  std::unique_ptr<Shader> shader_;
  GlVertexArray vertices_;
  std::array<Uploaded, 2> pictures_;
  std::uint64_t changes_ = 0;
};

// What is drawn there now, row 0 at the top; display-encoded.
Picture read_back(const Viewport& viewport);

}  // namespace lumivec
