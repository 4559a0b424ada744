// The picture as it is displayed, kept until something about it changes: a window is drawn for
// every move of the mouse, and OpenColorIO's shader costs more than all else in it.
#pragma once

#include <cstdint>
#include <optional>

#include "viewer/window/gl_objects.h"
#include "viewer/window/gpu_display.h"

namespace lumivec {

// Where a picture of width × height lies in a room of room_width × room_height that it was not made
// for: as high as the room and in its middle, which is where a camera of the same vertical angle
// shows the same things. The whole room for a picture that fits it within slack pixels of the room.
Viewport place_in_room(int width, int height, int room_width, int room_height, double slack);

class PictureCanvas {
 public:
  // Draws what display holds into where of the window; place is relative to where. Throws
  // GraphicsError.
  void draw(const GpuDisplay& display, const Viewport& where, const Viewport& place,
            const DisplayLook& look, const Color& background);
  // How often OpenColorIO's shader ran.
  std::uint64_t computed() const { return computed_; }

 private:
  struct State {
    std::uint64_t changes = 0;  // GpuDisplay's
    int width = 0, height = 0;
    Viewport place;
    DisplayLook look;
    Color background;
    bool operator==(const State&) const = default;
  };

  std::optional<GlCanvas> canvas_;
  State shown_;  // of canvas_
  std::uint64_t computed_ = 0;
};

}  // namespace lumivec
