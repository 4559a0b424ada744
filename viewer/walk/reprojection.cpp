#include "viewer/walk/reprojection.h"

#include <OpenImageIO/simd.h>

#include <algorithm>

namespace lumivec {
namespace {

using OIIO::simd::vbool8;
using OIIO::simd::vfloat8;
using OIIO::simd::vint8;

// Two points are of one surface if the other lies in the tangent plane up to this many pixels.
constexpr float most_off_plane = 2.0f;

// Where nothing is, the background is seen: so far away that the eye's place does not matter.
constexpr float background_depth = 1e12f;

struct Vectors {
  vfloat8 x, y, z;
};

vfloat8 dot(const Vectors& a, const V3f& b) {
  return madd(a.x, b.x, madd(a.y, b.y, a.z * b.z));
}

// a + b · x.
Vectors affine(const V3f& a, const V3f& b, const vfloat8& x) {
  return {madd(b.x, x, a.x), madd(b.y, x, a.y), madd(b.z, x, a.z)};
}

// Three signed bytes (integrator/visible_surfaces.h).
struct Normals {
  vint8 x, y, z;
};

Normals unpack(const vint8& packed) {
  return {(packed << 24) >> 24, (packed << 16) >> 24, (packed << 8) >> 24};
}

vint8 gather(const std::int32_t* from, const vint8& index) {
  vint8 v;
  v.gather(from, index);
  return v;
}

vfloat8 gather(const float* from, const vint8& index) {
  vfloat8 v;
  v.gather(from, index);
  return v;
}

}  // namespace

Reprojection::Reprojection(const CameraView& now, const VisibleSurfaces& seen_now,
                           const CameraView& then, const VisibleSurfaces& seen_then, int width,
                           int height)
    : rays_(now.rays()),
      rays_then_(then.rays()),
      plane_then_(then.plane()),
      pixel_size_(now.footprint(0.0f)),
      pixel_size_per_depth_(now.footprint(1.0f) - pixel_size_),
      seen_(seen_now),
      seen_then_(seen_then),
      width_(width),
      height_(height) {}

bool Reprojection::find_mirrored(int x, int y, float vergence, float curvature, V2f& place) const {
  const float behind = vergence + 2.0f * curvature;
  if (!(behind >= 0.0f)) return false;  // a real image, in front of a hollow mirror
  const float column = static_cast<float>(x) + 0.5f, row = static_cast<float>(y) + 0.5f;
  const std::size_t pixel = std::size_t(y) * std::size_t(width_) + std::size_t(x);
  const V3f along = rays_.direction + rays_.direction_x * column + rays_.direction_y * row;
  const V3f mirror = rays_.point(column, row, seen_.depth[pixel]);
  const float distance = std::min(1.0f / behind, background_depth);
  const PicturePlane& plane = plane_then_;
  const V3f p = mirror + along * (distance / along.length()) - plane.eye;
  const float z = p.dot(plane.forward);
  if (!(z > rays_then_.near)) return false;
  const float scale = plane.perspective ? 1.0f / z : 1.0f;
  place = V2f(p.dot(plane.x_axis) * scale, p.dot(plane.y_axis) * scale) + plane.center - V2f(0.5f);
  return place.x > -1.0f && place.y > -1.0f && place.x < static_cast<float>(width_) &&
         place.y < static_cast<float>(height_);
}

void Reprojection::find(int left, int y, Taps& taps) const {
  const std::size_t first = std::size_t(y) * std::size_t(width_) + std::size_t(left);
  vint8 object, packed;
  vfloat8 depth;
  if (left + static_cast<int>(lanes) <= width_) {
    object.load(seen_.object.data() + first);
    packed.load(reinterpret_cast<const std::int32_t*>(seen_.normal.data()) + first);
    depth.load(seen_.depth.data() + first);
  } else {
    const vint8 pixel = min(vint8::Iota(static_cast<int>(first)), vint8((y + 1) * width_ - 1));
    object = gather(seen_.object.data(), pixel);
    packed = gather(reinterpret_cast<const std::int32_t*>(seen_.normal.data()), pixel);
    depth = gather(seen_.depth.data(), pixel);
  }
  const vbool8 nothing = object < vint8(0);
  depth = select(nothing, vfloat8(background_depth), depth);

  // Seen from where the other eye is.
  const float row = static_cast<float>(y) + 0.5f;
  const vfloat8 column = vfloat8::Iota(static_cast<float>(left) + 0.5f);
  const PicturePlane& plane = plane_then_;
  const Vectors start =
      affine(rays_.origin + rays_.origin_y * row - plane.eye, rays_.origin_x, column);
  const Vectors along =
      affine(rays_.direction + rays_.direction_y * row, rays_.direction_x, column);
  const Vectors p = {madd(along.x, depth, start.x), madd(along.y, depth, start.y),
                     madd(along.z, depth, start.z)};
  const Normals normal = unpack(packed);
  constexpr float unit = 1.0f / static_cast<float>(normal_scale);
  const Vectors n = {vfloat8(normal.x) * unit, vfloat8(normal.y) * unit, vfloat8(normal.z) * unit};
  const vfloat8 on_plane = p.x * n.x + p.y * n.y + p.z * n.z;
  const vfloat8 tolerance =
      vfloat8(most_off_plane) * madd(vfloat8(pixel_size_per_depth_), depth, vfloat8(pixel_size_));

  const vfloat8 z = dot(p, plane.forward);
  const vfloat8 divisor = plane.perspective ? z : vfloat8(1.0f);
  const vfloat8 inverse = vfloat8(1.0f) / divisor;
  // Places far outside the picture, or nowhere, are kept within what integers hold.
  const auto bounded = [](const vfloat8& x) { return min(max(x, vfloat8(-2.0f)), vfloat8(1e6f)); };
  const vfloat8 u = bounded(madd(dot(p, plane.x_axis), inverse, vfloat8(plane.center.x - 0.5f)));
  const vfloat8 v = bounded(madd(dot(p, plane.y_axis), inverse, vfloat8(plane.center.y - 0.5f)));
  const vfloat8 u0 = floor(u), v0 = floor(v);
  const vfloat8 ax = u - u0, ay = v - v0;
  const vint8 x0(u0), y0(v0);
  const vbool8 usable = z > vfloat8(rays_then_.near);

  const PictureRays& then = rays_then_;
  const V3f origin = then.origin - plane.eye;
  vfloat8 total(0.0f);
  for (std::size_t tap = 0; tap < 4; ++tap) {
    const bool right = (tap & 1) != 0, down = (tap >> 1) != 0;
    const vint8 x = right ? x0 + vint8(1) : x0, line = down ? y0 + vint8(1) : y0;
    const vbool8 inside = (x >= vint8(0)) & (line >= vint8(0)) & (x < vint8(width_)) &
                          (line < vint8(height_)) & usable;
    const vint8 pixel = blend0(line * vint8(width_) + x, inside);
    const vint8 object_then = gather(seen_then_.object.data(), pixel);
    const Normals normal_then =
        unpack(gather(reinterpret_cast<const std::int32_t*>(seen_then_.normal.data()), pixel));
    const vfloat8 depth_then = gather(seen_then_.depth.data(), pixel);
    const vint8 product =
        normal.x * normal_then.x + normal.y * normal_then.y + normal.z * normal_then.z;
    // How far the other point is off the tangent plane.
    const vfloat8 cx = vfloat8(x) + vfloat8(0.5f), cy = vfloat8(line) + vfloat8(0.5f);
    const auto off_plane = [&](const vfloat8& axis, float o, float ox, float oy, float d, float dx,
                               float dy) {
      const vfloat8 direction = madd(cx, vfloat8(dx), madd(cy, vfloat8(dy), vfloat8(d)));
      const vfloat8 from = madd(cx, vfloat8(ox), madd(cy, vfloat8(oy), vfloat8(o)));
      return axis * madd(direction, depth_then, from);
    };
    const vfloat8 off = off_plane(n.x, origin.x, then.origin_x.x, then.origin_y.x, then.direction.x,
                                  then.direction_x.x, then.direction_y.x) +
                        off_plane(n.y, origin.y, then.origin_x.y, then.origin_y.y, then.direction.y,
                                  then.direction_x.y, then.direction_y.y) +
                        off_plane(n.z, origin.z, then.origin_x.z, then.origin_y.z, then.direction.z,
                                  then.direction_x.z, then.direction_y.z) -
                        on_plane;
    const vbool8 same =
        inside & (object_then == object) &
        (nothing | ((product >= vint8(least_normal_product)) & (abs(off) <= tolerance)));
    const vfloat8 share = (right ? ax : vfloat8(1.0f) - ax) * (down ? ay : vfloat8(1.0f) - ay);
    const vfloat8 weight = blend0(share, same);
    weight.store(taps.weight[tap].data());
    pixel.store(taps.pixel[tap].data());
    total += weight;
  }
  total.store(taps.total.data());
}

}  // namespace lumivec
