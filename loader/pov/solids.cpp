#include "loader/pov/solids.h"

#include <algorithm>
#include <cmath>

#include "loader/pov/bounds.h"
#include "loader/pov/tessellation.h"
#include "loader/transforms.h"

namespace lumivec::pov {
namespace {

using Imath::Box3d;

struct Corner {
  V3d p;
  V3d n{0.0};  // zero: flat
};

Corner middle(const Corner& a, const Corner& b) {
  Corner m;
  m.p = (a.p + b.p) / 2.0;
  const V3d sum = a.n + b.n;
  if (sum.length() > 0.0) m.n = sum.normalized();
  return m;
}

// Cuts triangles by bisection: large ones are divided until they are small, or the cutting objects
// are elsewhere; small ones are cut along their edges.
class Cutter {
 public:
  Cutter(const Clips& clips, const Box3d& region, double finest, const V3d& focus)
      : clips_(clips), region_(region), finest_(finest), focus_(focus) {}

  void add(const Corner& a, const Corner& b, const Corner& c, int depth = 0) {
    Box3d box;
    for (const Corner* corner : {&a, &b, &c}) box.extendBy(corner->p);
    if (!box.intersects(region_)) return;
    bool touched = false;
    for (const auto& clip : clips_) {
      if (box.intersects(clip->bounds())) {
        touched = true;
      } else if (clip->inside()) {
        return;  // outside of what it must be inside of
      }
    }
    if (!touched) return emit(a, b, c);
    // What is farther away may be cut more coarsely.
    constexpr double relative = 0.01;
    const double distance = std::max((box.center() - focus_).length() - box.size().length(), 0.0);
    const double small = std::max(finest_, relative * distance);
    constexpr int deepest = 14;
    if (box.size().length() > small && depth < deepest) {
      const Corner ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      add(a, ab, ca, depth + 1);
      add(ab, b, bc, depth + 1);
      add(ca, bc, c, depth + 1);
      add(ab, bc, ca, depth + 1);
      return;
    }
    cut(a, b, c);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  bool keeps(const V3d& p) const {
    return std::all_of(clips_.begin(), clips_.end(),
                       [&](const auto& clip) { return clip->keeps(p); });
  }

  void emit(const Corner& a, const Corner& b, const Corner& c) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    const V3d flat = (b.p - a.p).cross(c.p - a.p);
    if (flat.length() == 0.0) return;
    for (const Corner* corner : {&a, &b, &c}) {
      mesh_.positions.emplace_back(corner->p);
      mesh_.normals.emplace_back(V3f(corner->n.length() > 0.0 ? corner->n : flat.normalized()));
    }
    mesh_.triangles.push_back({first, first + 1, first + 2});
  }

  Corner border(Corner kept, Corner dropped) const {
    constexpr int halvings = 20;
    for (int i = 0; i < halvings; ++i) {
      const Corner m = middle(kept, dropped);
      (keeps(m.p) ? kept : dropped) = m;
    }
    return kept;
  }

  void cut(const Corner& a, const Corner& b, const Corner& c) {
    const bool ka = keeps(a.p), kb = keeps(b.p), kc = keeps(c.p);
    const int kept = ka + kb + kc;
    if (kept == 0) return;
    if (kept == 3) return emit(a, b, c);
    // The corner that is alone comes first.
    const bool lone = kept == 1;
    if (kb == lone && ka != lone && kc != lone) return cut_corner(b, c, a, lone);
    if (kc == lone && ka != lone && kb != lone) return cut_corner(c, a, b, lone);
    cut_corner(a, b, c, lone);
  }

  void cut_corner(const Corner& a, const Corner& b, const Corner& c, bool keep_corner) {
    if (keep_corner) return emit(a, border(a, b), border(a, c));
    const Corner ab = border(b, a), ca = border(c, a);
    emit(ab, b, c);
    emit(ab, c, ca);
  }

  const Clips& clips_;
  Box3d region_;
  double finest_;
  V3d focus_;
  Mesh mesh_;
};

Box3d transformed(const Box3d& box, const M44d& m) {
  Box3d result;
  if (box.isEmpty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    result.extendBy(V3d(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                        corner & 4 ? box.max.z : box.min.z) *
                    m);
  }
  return result;
}

// Large enough to hold what float makes of points on its sides.
Box3d widened(Box3d box) {
  constexpr double rounding = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const double margin = rounding * std::max(std::abs(box.min[i]), std::abs(box.max[i]));
    box.min[i] -= margin;
    box.max[i] += margin;
  }
  return box;
}

std::optional<Mesh> whole_surface(const Shape& shape, const M44d& to_scene, const Box3d& region,
                                  double reach, const V3d& focus) {
  if (const auto* sphere = std::get_if<SphereShape>(&shape)) return sphere_mesh(*sphere);
  if (auto mesh = tessellate(shape, reach)) return mesh;
  if (!shape_field(shape, V3d(0.0), {})) return std::nullopt;
  Object bare;
  bare.shape = shape;
  Box3d box = overlap(bounds_of(bare), transformed(region, to_scene.inverse()));
  // Of what has no end, as much as is near.
  constexpr double near = 0.002;
  const V3d center = focus * to_scene.inverse();
  const V3d half(reach * near);
  box = overlap(box, {center - half, center + half});
  if (box.isEmpty() || !box.hasVolume()) return Mesh();
  return level_set_mesh(shape, box);
}

}  // namespace

Inside::Inside(std::shared_ptr<const Object> of, const M44d& around) : object(std::move(of)) {
  const M44d to_scene = object->transform ? *object->transform * around : around;
  to_object = to_scene.inverse();
  if (const auto* combined = std::get_if<std::shared_ptr<const CombinedShape>>(&object->shape)) {
    for (const auto& part : (*combined)->parts) parts.emplace_back(part, to_scene);
  } else {
    outline = outline_of(object->shape);
  }
  if (object->extras) {
    for (const auto& clip : object->extras->clipped_by) clips.emplace_back(clip, around);
  }
}

bool Inside::contains(const V3d& point) const {
  const auto within = [&](const Inside& part) { return part.contains(point); };
  bool inside = false;
  if (const auto* combined = std::get_if<std::shared_ptr<const CombinedShape>>(&object->shape)) {
    switch ((*combined)->combination) {
      case Combination::union_:
      case Combination::merge:
        inside = std::any_of(parts.begin(), parts.end(), within);
        break;
      case Combination::intersection:
        inside = std::all_of(parts.begin(), parts.end(), within);
        break;
      case Combination::difference:
        inside = !parts.empty() && within(parts.front()) &&
                 std::none_of(parts.begin() + 1, parts.end(), within);
        break;
    }
  } else {
    inside = shape_field(object->shape, point * to_object, outline).value_or(1.0) < 0.0;
  }
  inside = inside && std::all_of(clips.begin(), clips.end(), within);
  return inside != object->inverse;
}

Clip::Clip(std::shared_ptr<const Object> object, const M44d& around, bool inside)
    : solid_(std::move(object), around), around_(around), inside_(inside) {
  bounds_ = transformed(bounds_of(*solid_.object), around);
  if (!bounds_.isEmpty()) bounds_ = widened(bounds_);
}

std::optional<Mesh> solid_surface(const Shape& shape, const M44d& to_scene, const Clips& clips,
                                  Box3d region, double reach, const V3d& focus) {
  for (const auto& clip : clips) {
    if (clip->inside()) region = overlap(region, clip->bounds());
  }
  if (region.isEmpty()) return Mesh();
  region = widened(region);
  const auto whole = whole_surface(shape, to_scene, region, reach, focus);
  if (!whole) return std::nullopt;
  M44d normal_transform = to_scene.inverse().transposed();
  const auto corner = [&](std::uint32_t i) {
    Corner result;
    result.p = V3d(whole->positions[i]) * to_scene;
    if (!whole->normals.empty()) {
      normal_transform.multDirMatrix(V3d(whole->normals[i]), result.n);
      result.n.normalize();
    }
    return result;
  };
  // The finest pieces are a hundredth of what is cut.
  Box3d cut_region;
  for (const V3f& p : whole->positions) cut_region.extendBy(V3d(p) * to_scene);
  cut_region = overlap(cut_region, region);
  for (const auto& clip : clips) {
    if (!clip->inside()) {
      const Box3d part = overlap(cut_region, clip->bounds());
      if (!part.isEmpty() && clips.size() == 1) cut_region = part;
    }
  }
  constexpr double share = 0.01;
  const double size = cut_region.isEmpty() ? reach : cut_region.size().length();
  Cutter cutter(clips, region, std::min(size, reach * 0.01) * share, focus);
  // Where the transform mirrors, triangles would turn and normals would not.
  const bool mirrored = determinant3(to_scene) < 0.0;
  for (const auto& t : whole->triangles)
    cutter.add(corner(t.x), corner(mirrored ? t.z : t.y), corner(mirrored ? t.y : t.z));
  return cutter.take();
}

}  // namespace lumivec::pov
