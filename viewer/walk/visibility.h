// What a moving eye sees, with few rays: whole pictures are traced when nothing is known of them;
// afterwards every fourth pixel in both directions, and all others where something else than one
// smooth surface may be.
//
// Edges that the last view showed are moved to where this one shows them, and all pixels around
// them are traced, so that what is thinner than four pixels stays. What is between four pixels of
// one smooth surface, with no edge near, is interpolated, if the last view showed that surface
// there. The pixels that are traced anyway move from frame to frame: within sixteen, all have had
// their turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "integrator/live_tracer.h"
#include "integrator/visible_surfaces.h"

namespace lumivec {

// Lists of pixels, one after the other.
inline void join_lists(const std::vector<std::vector<std::uint32_t>>& lists,
                       std::vector<std::uint32_t>& all) {
  all.clear();
  for (const std::vector<std::uint32_t>& list : lists)
    all.insert(all.end(), list.begin(), list.end());
}

class Visibility {
 public:
  Visibility(int width, int height);

  // What the tracer's view shows, every pixel by a ray.
  void see_all(LiveTracer& tracer);
  // The same of a view that is like the last one, if objects have not moved. What the last view did
  // not show at a pixel that is guessed() is to be settled afterwards.
  void see_next(LiveTracer& tracer);
  // Likewise without any ray: the points that the last view showed, each where it is now, the
  // nearest of those that come to lie in one pixel, without those that are seen through nearer
  // surfaces (Walter, Drettakis and Parker 1999, sections 3.2 and 3.3). Where there is none, the
  // object is VisibleSurfaces::unknown.
  void see_projected(const LiveTracer& tracer);
  // The last view's pixel whose point one shows since see_projected(); none: no_source.
  static constexpr std::uint32_t no_source = 0xffffffffu;
  std::uint32_t source(std::size_t pixel) const { return source_[pixel]; }
  // Traces what of these is not known by a ray; `others`: those that show another surface then.
  void verify(LiveTracer& tracer, const std::vector<std::uint32_t>& pixels,
              std::vector<std::uint32_t>& others);
  // Traces what was guessed of the same view; `others`: likewise.
  void see_again(LiveTracer& tracer, std::vector<std::uint32_t>& others);
  // Traces these pixels too.
  void settle(LiveTracer& tracer, const std::vector<std::uint32_t>& pixels);

  bool guessed(std::size_t pixel) const { return state_[pixel] == interpolated; }

  const VisibleSurfaces& now() const { return now_; }
  const VisibleSurfaces& last() const { return last_; }

  // Rays of this view.
  std::size_t ray_count() const { return ray_count_; }

 private:
  void cull_hidden();
  void mark_edges(const LiveTracer& tracer);
  void choose_cells(std::vector<std::uint32_t>& pixels);
  void fill_cells(const LiveTracer& tracer, std::vector<std::uint32_t>& pixels);
  void trace(LiveTracer& tracer, const std::vector<std::uint32_t>& pixels);
  bool smooth(const PictureRays& rays, float tolerance_per_depth, float tolerance, int x0, int y0,
              int x1, int y1) const;
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  enum State : std::uint8_t { unknown, wanted, traced, interpolated };

  int width_, height_;
  unsigned phase_ = 0;  // of the pixels that are traced anyway
  VisibleSurfaces now_, last_;
  std::vector<std::uint8_t> state_;
  std::vector<std::uint32_t> source_;
  std::size_t ray_count_ = 0;
};

}  // namespace lumivec
