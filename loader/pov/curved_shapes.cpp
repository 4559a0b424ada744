#include "loader/pov/expression.h"
#include "loader/pov/shape_parsers.h"

namespace lumivec::pov {
namespace {

CurveKind parse_curve_kind(Parser& parser) {
  if (parser.accept(K::linear_spline_)) return CurveKind::linear;
  if (parser.accept(K::quadratic_spline_)) return CurveKind::quadratic;
  if (parser.accept(K::cubic_spline_)) return CurveKind::cubic;
  if (parser.accept(K::bezier_spline_)) return CurveKind::bezier;
  return CurveKind::linear;
}

std::vector<std::array<double, 2>> parse_points(Parser& parser, std::size_t least,
                                                std::string_view construct) {
  const int count = parse_int(parser, construct);
  if (count < 0 || static_cast<std::size_t>(count) < least) {
    parser.fail(std::string(construct) + " needs " + std::to_string(least) + " points or more");
  }
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i < count; ++i) {
    skip_comma(parser);
    parser.claim(sizeof(points[0]));
    points.push_back(parse_pair(parser));
  }
  skip_comma(parser);
  return points;
}

std::size_t least_points(CurveKind kind) {
  switch (kind) {
    case CurveKind::linear:
      return 2;
    case CurveKind::quadratic:
      return 3;
    case CurveKind::cubic:
    case CurveKind::bezier:
      break;
  }
  return 4;
}

}  // namespace

Shape parse_prism(Parser& parser) {
  auto prism = std::make_shared<PrismShape>();
  for (;;) {
    if (parser.accept(K::linear_sweep_)) {
      prism->conic = false;
    } else if (parser.accept(K::conic_sweep_)) {
      prism->conic = true;
    } else if (parser.at(K::linear_spline_) || parser.at(K::quadratic_spline_) ||
               parser.at(K::cubic_spline_) || parser.at(K::bezier_spline_)) {
      prism->curve = parse_curve_kind(parser);
    } else {
      break;
    }
  }
  prism->low = parse_float(parser, "a prism's height");
  skip_comma(parser);
  prism->high = parse_float(parser, "a prism's height");
  skip_comma(parser);
  prism->points = parse_points(parser, least_points(prism->curve), "a prism");
  if (prism->curve == CurveKind::bezier && prism->points.size() % 4 != 0)
    parser.fail("a bezier_spline has four points for each stretch");
  prism->open = parser.accept(K::open_);
  return std::shared_ptr<const PrismShape>(std::move(prism));
}

Shape parse_lathe(Parser& parser) {
  auto lathe = std::make_shared<LatheShape>();
  lathe->curve = parse_curve_kind(parser);
  lathe->points = parse_points(parser, least_points(lathe->curve), "a lathe");
  if (lathe->curve == CurveKind::bezier && lathe->points.size() % 4 != 0)
    parser.fail("a bezier_spline has four points for each stretch");
  return std::shared_ptr<const LatheShape>(std::move(lathe));
}

Shape parse_sor(Parser& parser) {
  auto sor = std::make_shared<SorShape>();
  sor->points = parse_points(parser, 4, "a sor");
  sor->open = parser.accept(K::open_);
  return std::shared_ptr<const SorShape>(std::move(sor));
}

Shape parse_sphere_sweep(Parser& parser) {
  auto sweep = std::make_shared<SphereSweepShape>();
  if (parser.accept(K::b_spline_)) {
    sweep->b_spline = true;
  } else {
    sweep->curve = parse_curve_kind(parser);
  }
  skip_comma(parser);
  const int count = parse_int(parser, "a sphere sweep");
  if (count < 2) parser.fail("a sphere sweep needs 2 spheres or more");
  for (int i = 0; i < count; ++i) {
    skip_comma(parser);
    const V3d center = parse_vector(parser);
    skip_comma(parser);
    parser.claim(sizeof(sweep->spheres[0]));
    sweep->spheres.emplace_back(center, parse_float(parser, "a sphere sweep's radius"));
  }
  skip_comma(parser);
  if (parser.accept(K::tolerance_)) parse_float(parser, "tolerance");
  return std::shared_ptr<const SphereSweepShape>(std::move(sweep));
}

Shape parse_bicubic_patch(Parser& parser) {
  auto patch = std::make_shared<BicubicPatchShape>();
  patch->u_steps = patch->v_steps = 3;
  for (;;) {
    if (parser.accept(K::type_)) {
      patch->type = parse_int(parser, "type");
    } else if (parser.accept(K::flatness_)) {
      patch->flatness = parse_float(parser, "flatness");
    } else if (parser.accept(K::u_steps_)) {
      patch->u_steps = parse_int(parser, "u_steps");
    } else if (parser.accept(K::v_steps_)) {
      patch->v_steps = parse_int(parser, "v_steps");
    } else if (parser.accept(K::accuracy_)) {
      parse_float(parser, "accuracy");
    } else if (parser.accept(K::uv_vectors_)) {
      for (int i = 0; i < 4; ++i) {
        parse_pair(parser);
        skip_comma(parser);
      }
    } else if (!parser.accept(',')) {
      break;
    }
  }
  for (V3d& point : patch->points) {
    point = parse_vector(parser);
    skip_comma(parser);
  }
  parser.claim(sizeof(BicubicPatchShape));
  return std::shared_ptr<const BicubicPatchShape>(std::move(patch));
}

}  // namespace lumivec::pov
