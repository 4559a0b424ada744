#include "loader/pov/exact_solids.h"

#include <ImathBoxAlgo.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "loader/pov/bounds.h"
#include "loader/pov/curves.h"
#include "loader/pov/exact_shapes.h"
#include "loader/transforms.h"

namespace lumivec::pov {
namespace {

using Imath::Box3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

Box3d everywhere() {
  return {V3d(-infinity), V3d(infinity)};
}

// Bounds of infinite objects end a little before this.
bool has_end(const Box3d& box) {
  constexpr double almost = 0.1 * beyond_all;
  for (int i = 0; i < 3; ++i) {
    if (box.min[i] < -almost || box.max[i] > almost) return false;
  }
  return !box.isEmpty();
}

M44d frame(const V3d& x, const V3d& y, const V3d& z, const V3d& origin) {
  M44d m;
  for (int i = 0; i < 3; ++i) {
    m[0][i] = x[i];
    m[1][i] = y[i];
    m[2][i] = z[i];
    m[3][i] = origin[i];
  }
  return m;
}

M44d scaled(const V3d& scale, const V3d& center) {
  return frame(V3d(scale.x, 0, 0), V3d(0, scale.y, 0), V3d(0, 0, scale.z), center);
}

// The form of a primitive; the transform to the shape's own space. False: it has none.
struct LeafOf {
  SolidLeaf& leaf;

  bool operator()(const SphereShape& s) const {
    leaf.shape = SolidShape::sphere;
    leaf.to_solid = scaled(V3d(std::abs(s.radius)), s.center);
    return true;
  }
  bool operator()(const BoxShape& b) const {
    leaf.shape = SolidShape::box;
    leaf.to_solid = scaled((b.high - b.low) * 0.5, (b.high + b.low) * 0.5);
    return true;
  }
  bool operator()(const PlaneShape& s) const {
    leaf.shape = SolidShape::polynomial;
    add(1, 0, 0, s.normal.x);
    add(0, 1, 0, s.normal.y);
    add(0, 0, 1, s.normal.z);
    add(0, 0, 0, -s.distance);
    return true;
  }
  bool operator()(const ConeShape& c) const {
    if (c.base_radius < 0.0 || c.cap_radius < 0.0 || c.base_radius + c.cap_radius == 0.0)
      return false;
    leaf.shape = SolidShape::cone;
    leaf.base_radius = c.base_radius;
    leaf.cap_radius = c.cap_radius;
    leaf.open = c.open;
    leaf.to_solid = upright_to(c.base, c.cap - c.base, 1.0);
    return true;
  }
  bool operator()(const TorusShape& t) const {
    const double major = std::abs(t.major), minor = std::abs(t.minor);
    if (minor == 0.0 || !(minor < major)) return false;
    leaf.shape = SolidShape::torus;
    leaf.minor_radius = minor / major;
    leaf.to_solid = scaled(V3d(major), V3d(0.0));
    return true;
  }
  bool operator()(const std::shared_ptr<const QuadricShape>& q) const {
    leaf.shape = SolidShape::polynomial;
    add(2, 0, 0, q->squares.x);
    add(0, 2, 0, q->squares.y);
    add(0, 0, 2, q->squares.z);
    add(1, 1, 0, q->mixed.x);
    add(1, 0, 1, q->mixed.y);
    add(0, 1, 1, q->mixed.z);
    add(1, 0, 0, q->linear.x);
    add(0, 1, 0, q->linear.y);
    add(0, 0, 1, q->linear.z);
    add(0, 0, 0, q->constant);
    return !leaf.terms.empty();
  }
  bool operator()(const std::shared_ptr<const PolyShape>& s) const {
    if (s->order > max_polynomial_degree) return false;
    leaf.shape = SolidShape::polynomial;
    std::size_t next = 0;
    for (int i = s->order; i >= 0; --i) {
      for (int j = s->order - i; j >= 0; --j) {
        for (int k = s->order - i - j; k >= 0; --k) add(i, j, k, s->coefficients[next++]);
      }
    }
    return !leaf.terms.empty();
  }
  bool operator()(const SuperellipsoidShape& s) const { return take(exact_superellipsoid(s)); }
  bool operator()(const std::shared_ptr<const PrismShape>& s) const {
    return take(exact_prism(*s));
  }
  bool operator()(const std::shared_ptr<const LatheShape>& s) const {
    return take(exact_lathe(*s));
  }
  bool operator()(const std::shared_ptr<const SorShape>& s) const { return take(exact_sor(*s)); }
  bool operator()(const std::shared_ptr<const BlobShape>& s) const { return take(exact_blob(*s)); }
  bool operator()(const std::shared_ptr<const SphereSweepShape>& s) const {
    return take(exact_sweep(*s));
  }
  template <class Other>
  bool operator()(const Other&) const {
    return false;
  }

  bool take(std::optional<SolidLeaf> found) const {
    if (!found) return false;
    found->part = leaf.part;
    leaf = std::move(*found);
    return true;
  }

  void add(int x, int y, int z, double coefficient) const {
    if (coefficient == 0.0) return;
    const auto power = [](int n) { return static_cast<std::uint8_t>(n); };
    leaf.terms.push_back({{power(x), power(y), power(z)}, coefficient});
  }
};

bool is_clipped(const Object& object) {
  return object.extras && (!object.extras->clipped_by.empty() || object.extras->clipped_by_bounds);
}

}  // namespace

int SolidBuilder::add_node(const SolidNode& node) {
  solid_.nodes.push_back(node);
  const auto at = static_cast<int>(solid_.nodes.size()) - 1;
  solid_.nodes.back().end = at + 1;
  return at;
}

bool SolidBuilder::add_leaf(const Object& object, const M44d& to_scene, int part, int parent,
                            bool complement) {
  SolidLeaf leaf;
  leaf.part = part;
  if (!std::visit(LeafOf{leaf}, object.shape)) return false;
  leaf.to_solid = leaf.to_solid * to_scene;
  if (!is_invertible(leaf.to_solid)) return false;
  Object bare;
  bare.shape = object.shape;
  bare.transform = std::make_shared<const M44d>(to_scene);
  SolidNode node;
  node.complement = complement;
  node.parent = parent;
  node.leaf = static_cast<int>(solid_.leaves.size());
  node.bounds = bounds_of(bare);
  if (!has_end(node.bounds)) node.bounds = everywhere();
  solid_.leaves.push_back(std::move(leaf));
  add_node(node);
  return true;
}

// Each glyph is a prism whose sweep, along y, becomes z.
void SolidBuilder::add_text(const TextShape& text, const M44d& to_scene, int part, int parent,
                            bool complement) {
  SolidNode node;
  node.operation = SolidOperation::unite;
  node.complement = complement;
  node.parent = parent;
  node.bounds = everywhere();
  const int at = add_node(node);
  for (const TextShape::Glyph& glyph : text.glyphs) {
    SolidLeaf leaf;
    leaf.shape = SolidShape::prism;
    leaf.curve = glyph.outline;
    leaf.low = std::min(0.0, text.thickness);
    leaf.high = std::max(0.0, text.thickness);
    leaf.part = part;
    leaf.to_solid = frame(V3d(1, 0, 0), V3d(0, 0, 1), V3d(0, 1, 0), glyph.pen) * to_scene;
    if (leaf.low == leaf.high || !is_invertible(leaf.to_solid)) continue;
    SolidNode of_glyph;
    of_glyph.parent = at;
    of_glyph.leaf = static_cast<int>(solid_.leaves.size());
    Box3d box;
    for (const CurvePiece& piece : leaf.curve) {
      const auto u = control_values(piece.u), v = control_values(piece.v);
      for (std::size_t i = 0; i < 4; ++i) {
        box.extendBy(V3d(u[i], leaf.low, v[i]));
        box.extendBy(V3d(u[i], leaf.high, v[i]));
      }
    }
    of_glyph.bounds = Imath::transform(box, leaf.to_solid);
    solid_.leaves.push_back(std::move(leaf));
    add_node(of_glyph);
  }
  solid_.nodes[static_cast<std::size_t>(at)].end = static_cast<int>(solid_.nodes.size());
}

bool SolidBuilder::add_object(const Object& object, const M44d& around,
                              const SolidAppearance& appearance, int parent, bool complement) {
  if (is_clipped(object)) return false;
  SolidAppearance own = appearance;
  const M44d to_scene = object.transform ? *object.transform * around : around;
  if (object.texture) {
    own.texture = object.texture;
    own.texture_transform =
        object.texture_transform ? *object.texture_transform * around : to_scene;
  }
  if (object.interior) own.interior = object.interior;
  return add_shape(object, to_scene, own, parent, complement != object.inverse);
}

bool SolidBuilder::add_shape(const Object& object, const M44d& to_scene,
                             const SolidAppearance& appearance, int parent, bool complement) {
  const auto* combined = std::get_if<std::shared_ptr<const CombinedShape>>(&object.shape);
  if (!combined) {
    const int part = part_of_(object, appearance);
    if (part < 0) return false;
    if (const auto* text = std::get_if<std::shared_ptr<const TextShape>>(&object.shape)) {
      add_text(**text, to_scene, part, parent, complement);
      return true;
    }
    return add_leaf(object, to_scene, part, parent, complement);
  }
  const CombinedShape& shape = **combined;
  const bool united =
      shape.combination == Combination::union_ || shape.combination == Combination::merge;
  SolidNode node;
  node.operation = united ? SolidOperation::unite : SolidOperation::intersect;
  node.complement = complement;
  node.parent = parent;
  const int at = add_node(node);
  Box3d bounds = united ? Box3d() : everywhere();
  for (std::size_t i = 0; i < shape.parts.size(); ++i) {
    const bool taken_away = shape.combination == Combination::difference && i > 0;
    const std::size_t child = solid_.nodes.size();
    if (!add_object(*shape.parts[i], to_scene, appearance, at, taken_away)) return false;
    const SolidNode& added = solid_.nodes[child];
    const Box3d around = added.complement ? everywhere() : added.bounds;
    if (united) {
      bounds.extendBy(around);
    } else {
      bounds = overlap(bounds, around);
    }
  }
  SolidNode& done = solid_.nodes[static_cast<std::size_t>(at)];
  done.bounds = has_end(bounds) ? bounds : everywhere();
  done.end = static_cast<int>(solid_.nodes.size());
  return !shape.parts.empty();
}

bool SolidBuilder::add_surface(const Object& object, const M44d& to_scene,
                               const SolidAppearance& appearance, bool inside_out) {
  return add_shape(object, to_scene, appearance, -1, inside_out);
}

bool SolidBuilder::add_clip(const Clip& clip) {
  const Object& object = clip.object();
  const PartOf part_of = std::exchange(part_of_, [](const auto&, const auto&) { return 0; });
  const bool added = add_object(object, clip.around(), {}, -1, !clip.inside());
  part_of_ = part_of;
  return added;
}

Solid SolidBuilder::take(Box3d bounds, double reach) {
  const bool ends = has_end(bounds);
  for (int i = 0; i < 3 && !ends; ++i) {
    bounds.min[i] = std::max(bounds.min[i], -reach);
    bounds.max[i] = std::min(bounds.max[i], reach);
  }
  solid_.bounds = bounds;
  return std::move(solid_);
}

}  // namespace lumivec::pov
