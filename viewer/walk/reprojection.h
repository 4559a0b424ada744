// Where the surfaces that one view sees were in the picture of another one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "integrator/camera_view.h"
#include "integrator/visible_surfaces.h"

namespace lumivec {

class Reprojection {
 public:
  // Neighbouring pixels of a row that are looked up at once.
  static constexpr std::size_t lanes = 8;

  // The four pixels of the other view around a place: how much each counts by bilinear
  // interpolation, zero if it shows another surface, and its number. What counts adds up to total.
  struct Taps {
    alignas(32) std::array<std::array<float, lanes>, 4> weight;
    alignas(32) std::array<std::array<std::int32_t, lanes>, 4> pixel;
    alignas(32) std::array<float, lanes> total;
  };

  // Both see pictures of that size. All must outlive this.
  Reprojection(const CameraView& now, const VisibleSurfaces& seen_now, const CameraView& then,
               const VisibleSurfaces& seen_then, int width, int height);

  // Where the other view saw what a mirror shows at a pixel now, pixels from the middle of the
  // first one. vergence: 1 / distance from the mirror to that; curvature: of the mirror,
  // LiveTracer's. What a mirror shows seems to stand behind it: as far as in front of a flat one,
  // nearer for one that bulges (1/d' = 1/d + 2/r, for light that meets it head-on). False: nowhere.
  bool find_mirrored(int x, int y, float vergence, float curvature, V2f& place) const;

  // Of the pixels (left, y) to (left + lanes − 1, y); those outside the picture repeat one inside.
  void find(int left, int y, Taps& taps) const;

 private:
  PictureRays rays_, rays_then_;
  PicturePlane plane_then_;
  float pixel_size_, pixel_size_per_depth_;  // scene units
  const VisibleSurfaces &seen_, &seen_then_;
  int width_, height_;
};

}  // namespace lumivec
