#include "loader/pov/expression.h"
#include "loader/pov/shape_parsers.h"

namespace lumivec::pov {
namespace {

V3d unit_normal(Parser& parser, const V3d& normal) {
  if (normal.length() == 0.0) parser.fail("the normal has no length");
  return normal.normalized();
}

double parse_radius(Parser& parser, std::string_view construct) {
  skip_comma(parser);
  return parse_float(parser, construct);
}

}  // namespace

Shape parse_sphere(Parser& parser) {
  SphereShape sphere;
  sphere.center = parse_vector(parser);
  sphere.radius = parse_radius(parser, "a sphere's radius");
  return sphere;
}

Shape parse_box(Parser& parser) {
  BoxShape box;
  box.low = parse_vector(parser);
  skip_comma(parser);
  box.high = parse_vector(parser);
  return box;
}

Shape parse_plane(Parser& parser) {
  PlaneShape plane;
  plane.normal = unit_normal(parser, parse_vector(parser));
  skip_comma(parser);
  plane.distance = parse_float(parser, "a plane's distance");
  return plane;
}

Shape parse_cylinder(Parser& parser) {
  ConeShape cylinder;
  cylinder.cylinder = true;
  cylinder.base = parse_vector(parser);
  skip_comma(parser);
  cylinder.cap = parse_vector(parser);
  cylinder.base_radius = cylinder.cap_radius = parse_radius(parser, "a cylinder's radius");
  skip_comma(parser);
  cylinder.open = parser.accept(K::open_);
  return cylinder;
}

Shape parse_cone(Parser& parser) {
  ConeShape cone;
  cone.base = parse_vector(parser);
  cone.base_radius = parse_radius(parser, "a cone's radius");
  skip_comma(parser);
  cone.cap = parse_vector(parser);
  cone.cap_radius = parse_radius(parser, "a cone's radius");
  skip_comma(parser);
  cone.open = parser.accept(K::open_);
  return cone;
}

Shape parse_torus(Parser& parser) {
  TorusShape torus;
  torus.major = parse_float(parser, "a torus' radius");
  torus.minor = parse_radius(parser, "a torus' radius");
  return torus;
}

Shape parse_disc(Parser& parser) {
  DiscShape disc;
  disc.center = parse_vector(parser);
  skip_comma(parser);
  disc.normal = unit_normal(parser, parse_vector(parser));
  disc.radius = parse_radius(parser, "a disc's radius");
  skip_comma(parser);
  if (begins_number(parser)) disc.hole = parse_float(parser, "a disc's hole");
  return disc;
}

Shape parse_triangle(Parser& parser, bool smooth) {
  auto triangle = std::make_shared<TriangleShape>();
  triangle->smooth = smooth;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle->corners[i] = parse_vector(parser);
    skip_comma(parser);
    if (!smooth) continue;
    triangle->normals[i] = parse_vector(parser);
    skip_comma(parser);
  }
  parser.claim(sizeof(TriangleShape));
  return std::shared_ptr<const TriangleShape>(std::move(triangle));
}

Shape parse_polygon(Parser& parser) {
  auto polygon = std::make_shared<PolygonShape>();
  const int count = parse_int(parser, "the number of a polygon's points");
  if (count < 3) parser.fail("a polygon needs 3 points or more");
  for (int i = 0; i < count; ++i) {
    skip_comma(parser);
    parser.claim(sizeof(V3d));
    polygon->points.push_back(parse_vector(parser));
  }
  return std::shared_ptr<const PolygonShape>(std::move(polygon));
}

Shape parse_quadric(Parser& parser) {
  auto quadric = std::make_shared<QuadricShape>();
  quadric->squares = parse_vector(parser);
  skip_comma(parser);
  quadric->mixed = parse_vector(parser);
  skip_comma(parser);
  quadric->linear = parse_vector(parser);
  skip_comma(parser);
  quadric->constant = parse_float(parser, "a quadric");
  return std::shared_ptr<const QuadricShape>(std::move(quadric));
}

Shape parse_poly(Parser& parser, int order) {
  constexpr int highest_order = 15;  // the language's
  auto poly = std::make_shared<PolyShape>();
  poly->order = order;
  if (order == 0) {
    poly->order = parse_int(parser, "a polynomial's order");
    skip_comma(parser);
    if (poly->order < 2 || poly->order > highest_order)
      parser.fail("a polynomial has an order from 2 to 15");
  }
  const int n = poly->order;
  const auto count = static_cast<std::size_t>((n + 1) * (n + 2) * (n + 3) / 6);
  parser.expect('<', "a polynomial");
  for (std::size_t i = 0; i < count; ++i) {
    poly->coefficients.push_back(parse_float(parser, "a polynomial"));
    skip_comma(parser);
  }
  parser.expect('>', "a polynomial");
  return std::shared_ptr<const PolyShape>(std::move(poly));
}

Shape parse_superellipsoid(Parser& parser) {
  const auto exponents = parse_pair(parser);
  if (!(exponents[0] > 0.0 && exponents[1] > 0.0))
    parser.fail("the exponents of a superellipsoid must be more than 0");
  return SuperellipsoidShape{exponents[0], exponents[1]};
}

}  // namespace lumivec::pov
