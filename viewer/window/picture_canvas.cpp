#include "viewer/window/picture_canvas.h"

#include <algorithm>
#include <cmath>

namespace lumivec {

Viewport place_in_room(int width, int height, int room_width, int room_height, double slack) {
  const double scaled = double(room_height) * double(width) / double(std::max(height, 1));
  if (std::abs(scaled - double(room_width)) <= slack) return {0, 0, room_width, room_height};
  const int across = std::max(1, int(std::lround(scaled)));
  return {(room_width - across) / 2, 0, across, room_height};
}

void PictureCanvas::draw(const GpuDisplay& display, const Viewport& where, const Viewport& place,
                         const DisplayLook& look, const Color& background) {
  GLint window = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &window);
  const State wanted = {display.changes(), where.width, where.height, place, look, background};
  if (!canvas_ || wanted != shown_) {
    if (!canvas_ || wanted.width != shown_.width || wanted.height != shown_.height) {
      canvas_.reset();
      canvas_.emplace(where.width, where.height, GL_RGBA8);
    }
    canvas_->bind();
    glViewport(0, 0, where.width, where.height);
    glClearColor(background.x, background.y, background.z, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    display.draw(place, look);
    shown_ = wanted;
    ++computed_;
  }
  canvas_->read();
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(window));
  glBlitFramebuffer(0, 0, where.width, where.height, where.x, where.y, where.x + where.width,
                    where.y + where.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, GLuint(window));
}

}  // namespace lumivec
