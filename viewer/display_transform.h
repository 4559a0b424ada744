// From the renderer's radiance to what a display is sent: exposure, then a view of an OpenColorIO
// configuration.
//
// Costs about 180 ns a pixel and core with an ACES view; rows run in parallel.
#pragma once

#include <memory>
#include <string>

#include "viewer/picture.h"

namespace lumivec {

// Empty strings: the configuration's defaults. config as load_ocio_config takes it.
struct DisplayOptions {
  std::string config;
  std::string display;
  std::string view;
  std::string look = {};  // empty: those that the view has
};

// The same with the names that the configuration has. Throws as DisplayTransform's constructor.
DisplayOptions find_display(const DisplayOptions& options);

// Exposed values are taken to lie between this and its opposite: far brighter than any view can
// tell, and what half precision holds. Beyond 1e20 or so the arithmetic of views overflows.
constexpr float most_displayed = 65504.0f;

class DisplayTransform {
 public:
  // Names match whatever their case. Throws DisplayError (display_error.h) for a
  // configuration that cannot be used, and UsageError for a display, view or look that it does not
  // hold.
  explicit DisplayTransform(const DisplayOptions& options);
  ~DisplayTransform();
  DisplayTransform(DisplayTransform&&) noexcept;
  DisplayTransform& operator=(DisplayTransform&&) noexcept;

  // picture: scene-linear Rec. 709 in, display-encoded out, nominally [0, 1]; a little outside may
  // occur, and values that are not finite count as 0. exposure: in stops, applied to the
  // scene-linear values.
  void apply(Picture& picture, double exposure) const;

  const std::string& display() const { return names_.display; }
  const std::string& view() const { return names_.view; }
  bool is_srgb() const;  // does the display take sRGB?

 private:
  struct Processor;  // keeps OpenColorIO's headers out of this one
  std::unique_ptr<Processor> processor_;
  DisplayOptions names_;
};

}  // namespace lumivec
