// The shading cache: what the eye sees is traced afresh in every frame, and what it looks like is
// reused from the frame before where the same surface was seen there (Tole, Pellacini, Walter and
// Greenberg 2002, on the surfaces that pixels see; Walter, Drettakis and Parker 1999 for the choice
// of the pixels that are traced). Silhouettes are exact and there are no holes.
//
// Terms are kept apart all the way: which of them are shown is decided when a frame is resolved. At
// 512 × 512 a frame costs some 15 ms of one core besides tracing.
#pragma once

#include <cstdint>
#include <vector>

#include "integrator/live_tracer.h"

namespace lumivec {

class ShadingCache {
 public:
  ShadingCache(int width, int height);

  // A new frame of another view. seen: what the tracer sees, row by row; its contents are exchanged
  // for the last view's.
  void see(const LiveTracer& tracer, std::vector<VisiblePoint>& seen);

  // A new frame of the same view.
  void rest();

  // All pixels show nothing again.
  void forget();

  // About so many pixels to trace, each with a sample number of its own: those that show nothing
  // yet first, then by age and by how few samples they rest on, spread by error diffusion.
  void choose(std::size_t count, std::vector<LiveRequest>& requests);

  void add(const std::vector<LiveSample>& samples);

  // Radiance of all pixels, cd·m⁻², of those terms (bit i: Term(i)). Pixels without a sample show
  // what neighbours on the same surface do.
  void resolve(std::uint32_t terms, std::vector<Color>& picture) const;
  // One term.
  void resolve(Term term, std::vector<Color>& layer) const;

  int width() const { return width_; }
  int height() const { return height_; }
  // Mean over the pixels of the frames since they were traced.
  double mean_age() const;
  // Pixels that rest on no sample.
  std::size_t hole_count() const;

 private:
  struct Shade {
    std::array<Color, term_count> terms = {Color(0.0f), Color(0.0f), Color(0.0f), Color(0.0f),
                                           Color(0.0f)};  // means
    float samples = 0.0f;                                 // that they rest on, in effect
    float specular_samples = 0.0f;                        // likewise of the specular term
    std::uint16_t age = 0;                                // frames since a sample was taken

    void grow_older() { age = static_cast<std::uint16_t>(age + (age < 0xffff ? 1 : 0)); }
  };
  static const Shade nothing;

  bool carry_over(const LiveTracer& tracer, const VisiblePoint& point, Shade& shade) const;
  Color sum(const Shade& shade, std::uint32_t terms) const;
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::uint32_t frame_ = 0;  // numbers samples
  std::vector<VisiblePoint> points_, last_points_;
  std::vector<Shade> shades_, last_shades_;
};

}  // namespace lumivec
