// The shading cache: what the eye sees is traced afresh in every frame, and what it looks like is
// reused from the frame before where the same surface was seen there (Tole, Pellacini, Walter and
// Greenberg 2002, on the surfaces that pixels see; Walter, Drettakis and Parker 1999 for the choice
// of the pixels that are traced). Silhouettes are exact and there are no holes.
//
// Terms are kept apart all the way: which of them are shown is decided when a frame is resolved.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "integrator/live_tracer.h"
#include "integrator/visible_surfaces.h"
#include "viewer/walk/visibility.h"

namespace lumivec {

class ShadingCache {
 public:
  ShadingCache(int width, int height);

  // A new frame of another view, which the tracer and `visibility` have just come to see; what is
  // guessed there is settled.
  void see(LiveTracer& tracer, Visibility& visibility);

  // Likewise of a view that was put together by Visibility::see_projected(): points keep what they
  // showed.
  void see_projected(const Visibility& visibility);

  // These pixels show nothing any more: they have turned out to be of other surfaces.
  void clear(const std::vector<std::uint32_t>& pixels);

  // For frames to come, whether the scene is changing: samples that differ from what is known then
  // call for more around them, and what was known there counts little.
  void expect_changes(bool expected) { changing_ = expected; }

  // A new frame of the same view, whose pixels' middles see this.
  void rest(const VisibleSurfaces& seen);

  // What pixels show rests on so many samples at most from now on, > 0.
  void doubt(float most);
  // Likewise what of it comes from cached light: indirect, caustic and specular light.
  void doubt_cached(float most);

  // All pixels show nothing again.
  void forget();

  // About so many samples to trace, of a view at rest several of a pixel if it is noisy: of pixels
  // that show nothing yet first, then by age and by how few samples they rest on, spread by error
  // diffusion.
  void choose(std::size_t count, std::vector<LiveRequest>& requests);

  void add(const std::vector<LiveSample>& samples);

  // Radiance of all pixels, cd·m⁻², of those terms (bit i: Term(i)). Pixels without a sample show
  // what neighbours on the same surface do.
  void resolve(std::uint32_t terms, const VisibleSurfaces& seen, std::vector<Color>& picture) const;

  int width() const { return width_; }
  int height() const { return height_; }
  // Of what pixels show, in this frame and the one before.
  std::size_t bytes() const {
    return shades_.bytes() + last_shades_.bytes() + numbers_.size() * sizeof(std::uint32_t);
  }
  // Mean over the pixels of the frames since they were traced, as the frame began.
  double mean_age() const;
  // Pixels that rest on no sample.
  std::size_t hole_count() const;

 private:
  // Of a view that comes to rest, what was carried over to pixels that edges go through counts like
  // so many samples at most: it shows their middles.
  static constexpr float most_carried_samples_at_edges = 1.0f;

  // Radiance of a pixel: five terms of three channels, means of samples, and how many samples they
  // rest on, in effect. A cache line.
  struct alignas(64) Shade {
    static constexpr std::size_t samples_lane = 3 * term_count;
    std::array<float, samples_lane + 1> lanes{};

    float samples() const { return lanes[samples_lane]; }
  };
  struct Shades {
    std::vector<Shade> shade;
    std::vector<float> cached_samples;    // that indirect and caustic light rest on
    std::vector<float> specular_samples;  // that the specular term rests on
    std::vector<float> mirrored;          // vergence of what the specular term shows, LiveSample's
    std::vector<float> noise;             // mean square of what samples are off, relative
    std::vector<std::uint16_t> age;       // frames since a sample was taken

    explicit Shades(std::size_t pixels);
    void clear(std::size_t pixel);
    std::size_t bytes() const {
      return shade.size() * sizeof(Shade) + age.size() * sizeof(std::uint16_t) +
             (cached_samples.size() + specular_samples.size() + mirrored.size() + noise.size()) *
                 sizeof(float);
    }
  };
  // Of the view that rests, or rested last, the pixels that edges go through: their samples, which
  // are spread over them, are of more than one surface.
  enum class Edge : std::uint8_t { none, plain, of_light };
  std::vector<Edge> edges_;
  bool rested_ = false, last_rested_ = false;  // this view has, the one before has

  // What choose() goes by, of a row.
  struct Row {
    double wanted = 0.0;  // sum over the pixels that show something
    double age = 0.0;     // likewise over all
    std::size_t holes = 0;
  };

  void carry_over(const LiveTracer& tracer, const class Reprojection& reprojection, int left, int y,
                  const Visibility& visibility, std::vector<std::uint32_t>& doubtful);
  void follow_mirror(const LiveTracer& tracer, const class Reprojection& reprojection, int x, int y,
                     const Visibility& visibility);
  bool is_edge(const VisibleSurfaces& seen, int x, int y) const;
  bool is_beside_light(const VisibleSurfaces& seen, int x, int y) const;
  void find_edges(const VisibleSurfaces& seen);
  void doubt(std::size_t pixel, float most);
  bool is_mixed(std::size_t pixel) const { return last_rested_ && edges_[pixel] != Edge::none; }
  // Whether an edge goes through it that no sample of the resting view has shown yet.
  bool is_untried_edge(std::size_t pixel) const {
    return rested_ && edges_[pixel] != Edge::none &&
           shades_.shade[pixel].samples() <= most_carried_samples_at_edges;
  }
  void grow_older(int y);
  void spread_urgency();
  void share_noise();
  std::size_t block_of(std::size_t pixel) const {
    return pixel / static_cast<std::size_t>(width_) / block_side * blocks_across_ +
           pixel % static_cast<std::size_t>(width_) / block_side;
  }
  float want(std::size_t pixel) const;
  static Color sum(const Shade& shade, const std::array<float, term_count>& shown);
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::uint32_t frame_ = 0;
  Shades shades_, last_shades_;
  // Of pixels, the number of the next sample: a sequence of each covers its domain evenly.
  std::vector<std::uint32_t> numbers_;
  std::vector<Row> rows_;

  // Where the light was seen to change, [0, 1], of blocks of pixels.
  static constexpr std::size_t block_side = 8;
  std::size_t blocks_across_;
  std::vector<float> urgency_;
  // How much more samples are worth there than elsewhere, as they are noisier.
  std::vector<float> noisiness_;
  float noise_scale_ = 0.0f;  // 1 / mean noise
  bool changing_ = false;
};

}  // namespace lumivec
