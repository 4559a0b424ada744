#include <algorithm>
#include <cmath>

#include "loader/pov/curves.h"
#include "loader/pov/functions.h"
#include "loader/pov/solids.h"
#include "loader/pov/tessellation.h"

namespace lumivec::pov {
namespace {

// Even-odd. Outlines of areas are closed by a line; profiles that are turned end where they end.
enum class Ends : std::uint8_t { joined, open };

bool is_within(const std::vector<Curve>& curves, Ends ends, double x, double y) {
  bool inside = false;
  for (const Curve& curve : curves) {
    const std::size_t n = curve.points.size();
    if (n == 0) continue;
    const std::size_t lines = ends == Ends::joined || curve.closed ? n : n - 1;
    for (std::size_t i = 0; i < lines; ++i) {
      const Point2 &a = curve.points[i], &b = curve.points[(i + 1) % n];
      if ((a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]))
        inside = !inside;
    }
  }
  return inside;
}

double cone_field(const ConeShape& cone, const V3d& p) {
  const V3d axis = cone.cap - cone.base;
  const double height = axis.length();
  if (height == 0.0) return 1.0;
  const double along = (p - cone.base).dot(axis) / height;
  const double across = std::sqrt(std::max((p - cone.base).length2() - along * along, 0.0));
  const double radius = cone.base_radius + (cone.cap_radius - cone.base_radius) * along / height;
  return std::max({across - radius, -along, along - height});
}

double poly_field(const PolyShape& poly, const V3d& p) {
  std::size_t next = 0;
  double sum = 0.0, px = 1.0;
  std::vector<double> px_powers(static_cast<std::size_t>(poly.order) + 1);
  for (double& power : px_powers) {
    power = px;
    px *= p.x;
  }
  // Terms go from the highest power of x, then of y, then of z, down.
  for (int i = poly.order; i >= 0; --i) {
    for (int j = poly.order - i; j >= 0; --j) {
      for (int k = poly.order - i - j; k >= 0; --k) {
        const double c = poly.coefficients[next++];
        if (c == 0.0) continue;
        sum += c * px_powers[static_cast<std::size_t>(i)] * std::pow(p.y, j) * std::pow(p.z, k);
      }
    }
  }
  return sum;
}

double superellipsoid_field(const SuperellipsoidShape& s, const V3d& p) {
  const double ring = std::pow(
      std::pow(std::abs(p.x), 2.0 / s.east_west) + std::pow(std::abs(p.y), 2.0 / s.east_west),
      s.east_west / s.north_south);
  return std::pow(ring + std::pow(std::abs(p.z), 2.0 / s.north_south), s.north_south / 2.0) - 1.0;
}

double blob_field(const BlobShape& blob, const V3d& point) {
  double sum = 0.0;
  for (const BlobShape::Component& part : blob.components) {
    const V3d p = point * part.transform.inverse();
    V3d from = part.center;
    if (part.cylinder) {
      const V3d axis = part.cap - part.center;
      const double t = axis.length2() > 0.0 ? (p - part.center).dot(axis) / axis.length2() : 0.0;
      from += axis * std::clamp(t, 0.0, 1.0);
    }
    const double share = 1.0 - (p - from).length2() / (part.radius * part.radius);
    if (share > 0.0) sum += part.strength * share * share;
  }
  return blob.threshold - sum;
}

double sor_field(const SorShape& sor, const V3d& p) {
  const auto& q = sor.points;
  const auto slope = [&](std::size_t i) {
    const double rise = q[i + 1][1] - q[i - 1][1];
    return rise == 0.0 ? 0.0 : 2.0 * q[i][0] * (q[i + 1][0] - q[i - 1][0]) / rise;
  };
  for (std::size_t i = 1; i + 2 < q.size(); ++i) {
    const double h = q[i + 1][1] - q[i][1];
    if (h == 0.0 || p.y < std::min(q[i][1], q[i + 1][1]) || p.y > std::max(q[i][1], q[i + 1][1]))
      continue;
    const double t = (p.y - q[i][1]) / h, s = 1.0 - t;
    const double square = q[i][0] * q[i][0] * (1 + 2 * t) * s * s +
                          q[i + 1][0] * q[i + 1][0] * t * t * (3 - 2 * t) +
                          slope(i) * h * t * s * s - slope(i + 1) * h * t * t * s;
    return p.x * p.x + p.z * p.z - square;
  }
  return 1.0;
}

// Crossings of a ray along the mesh's inside vector.
double mesh_field(const MeshShape& mesh, const V3d& p) {
  if (!mesh.has_inside || mesh.inside_vector.length() == 0.0) return 1.0;
  const V3d d = mesh.inside_vector;
  int crossings = 0;
  for (const auto& face : mesh.faces) {
    const V3d a = mesh.points[face[0]], u = mesh.points[face[1]] - a, v = mesh.points[face[2]] - a;
    const V3d n = d.cross(v);
    const double scale = u.dot(n);
    if (scale == 0.0) continue;
    const V3d o = p - a, q = o.cross(u);
    const double s = o.dot(n) / scale, t = d.dot(q) / scale;
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && v.dot(q) / scale > 0.0) ++crossings;
  }
  return crossings % 2 == 1 ? -1.0 : 1.0;
}

struct Field {
  V3d p;
  const std::vector<Curve>& outline;
  using Result = std::optional<double>;

  Result operator()(const SphereShape& s) const {
    return (p - s.center).length() - std::abs(s.radius);
  }
  Result operator()(const BoxShape& b) const {
    double most = -1e300;
    for (int i = 0; i < 3; ++i) {
      most = std::max(
          {most, std::min(b.low[i], b.high[i]) - p[i], p[i] - std::max(b.low[i], b.high[i])});
    }
    return most;
  }
  Result operator()(const PlaneShape& s) const { return p.dot(s.normal) - s.distance; }
  Result operator()(const ConeShape& s) const { return cone_field(s, p); }
  Result operator()(const TorusShape& s) const {
    return std::hypot(std::hypot(p.x, p.z) - s.major, p.y) - s.minor;
  }
  Result operator()(const std::shared_ptr<const MeshShape>& s) const { return mesh_field(*s, p); }
  Result operator()(const std::shared_ptr<const QuadricShape>& q) const {
    return q->squares.dot(V3d(p.x * p.x, p.y * p.y, p.z * p.z)) +
           q->mixed.dot(V3d(p.x * p.y, p.x * p.z, p.y * p.z)) + q->linear.dot(p) + q->constant;
  }
  Result operator()(const std::shared_ptr<const PolyShape>& s) const { return poly_field(*s, p); }
  Result operator()(const SuperellipsoidShape& s) const { return superellipsoid_field(s, p); }
  Result operator()(const std::shared_ptr<const BlobShape>& s) const { return blob_field(*s, p); }
  Result operator()(const std::shared_ptr<const PrismShape>& s) const {
    if (p.y < std::min(s->low, s->high) || p.y > std::max(s->low, s->high)) return 1.0;
    const double scale = s->conic ? p.y : 1.0;
    if (scale == 0.0) return 1.0;
    return is_within(outline, Ends::joined, p.x / scale, p.z / scale) ? -1.0 : 1.0;
  }
  Result operator()(const std::shared_ptr<const LatheShape>&) const {
    return is_within(outline, Ends::open, std::hypot(p.x, p.z), p.y) ? -1.0 : 1.0;
  }
  Result operator()(const std::shared_ptr<const SorShape>& s) const { return sor_field(*s, p); }
  Result operator()(const std::shared_ptr<const IsosurfaceShape>& s) const {
    const double arguments[3] = {p.x, p.y, p.z};
    std::uint64_t nodes_left = most_nodes_a_point;
    const auto value = evaluate(*s->function, arguments, nodes_left);
    if (!value) return std::nullopt;
    double container = 0.0;
    if (s->sphere) {
      container = (p - s->low).length() - s->radius;
    } else {
      container = *(*this)(BoxShape{s->low, s->high});
    }
    return std::max(value->n[0] - s->threshold, container);
  }
  template <class Other>
  Result operator()(const Other&) const {
    return std::nullopt;
  }
};

}  // namespace

std::optional<double> shape_field(const Shape& shape, const V3d& point,
                                  const std::vector<Curve>& outline) {
  return std::visit(Field{point, outline}, shape);
}

std::vector<Curve> outline_of(const Shape& shape) {
  if (const auto* prism = std::get_if<std::shared_ptr<const PrismShape>>(&shape))
    return sample_curves((*prism)->curve, (*prism)->points, true, curve_steps);
  if (const auto* lathe = std::get_if<std::shared_ptr<const LatheShape>>(&shape))
    return sample_curves((*lathe)->curve, (*lathe)->points, false, curve_steps);
  return {};
}

}  // namespace lumivec::pov
