// The primitives of the scene language, each with its own parameters in object space, as written.
#pragma once

#include <ImathBox.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "loader/pov/appearance.h"
#include "loader/scene.h"

namespace lumivec::pov {

struct SphereShape {
  V3d center{0.0};
  double radius = 1.0;
};
struct BoxShape {
  V3d low{0.0};  // any two opposite corners
  V3d high{1.0};
};
struct PlaneShape {
  V3d normal{0.0, 1.0, 0.0};  // unit length; looks out of the solid
  double distance = 0.0;      // along the normal
};
struct ConeShape {  // cylinders are cones of equal radii
  V3d base{0.0};
  V3d cap{0.0, 1.0, 0.0};
  double base_radius = 1.0;
  double cap_radius = 1.0;
  bool open = false;
  bool cylinder = false;
};
struct TorusShape {
  double major = 1.0;
  double minor = 0.25;
};
struct DiscShape {
  V3d center{0.0};
  V3d normal{0.0, 1.0, 0.0};
  double radius = 1.0;
  double hole = 0.0;
};
struct TriangleShape {
  std::array<V3d, 3> corners;
  std::array<V3d, 3> normals;  // if smooth
  bool smooth = false;
};
struct PolygonShape {
  std::vector<V3d> points;  // sub-polygons one after another, each closed by its first point
};
struct MeshShape {
  std::vector<V3d> points;
  std::vector<V3d> normals;  // empty: flat
  std::vector<std::array<double, 2>> uvs;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::array<std::uint32_t, 3>> face_normals;  // empty: as faces, if there are normals
  std::vector<std::array<std::uint32_t, 3>> face_uvs;      // likewise
  std::vector<std::array<int, 3>> face_textures;           // by corner, -1: the object's; or empty
  std::vector<std::shared_ptr<const Texture>> textures;
  bool has_inside = false;
  V3d inside_vector{0.0};
  Imath::Box3d bounds;
};
struct QuadricShape {
  V3d squares{0.0};  // of x², y², z²
  V3d mixed{0.0};    // of xy, xz, yz
  V3d linear{0.0};   // of x, y, z
  double constant = 0.0;
};
struct PolyShape {
  int order = 2;
  std::vector<double> coefficients;  // (order + 1)(order + 2)(order + 3) / 6
  bool sturm = false;
};
struct SuperellipsoidShape {
  double east_west = 1.0;
  double north_south = 1.0;
};
struct BlobShape {
  struct Component {
    bool cylinder = false;
    V3d center{0.0};  // or the base of the cylinder
    V3d cap{0.0};
    double radius = 1.0;
    double strength = 1.0;
    M44d transform;
    std::shared_ptr<const Texture> texture;
  };
  double threshold = 1.0;
  std::vector<Component> components;
  bool hierarchy = true;
  bool sturm = false;
};
struct HeightFieldShape {
  ImageUse image;
  double water_level = 0.0;
  bool smooth = false;
  std::shared_ptr<const Function> function;  // instead of a picture
  int function_width = 0;
  int function_height = 0;
};
enum class CurveKind : std::uint8_t { linear, quadratic, cubic, bezier };
struct PrismShape {
  CurveKind curve = CurveKind::linear;
  bool conic = false;
  bool open = false;
  bool sturm = false;
  double low = 0.0;
  double high = 1.0;
  std::vector<std::array<double, 2>> points;
};
struct LatheShape {
  CurveKind curve = CurveKind::linear;
  bool sturm = false;
  std::vector<std::array<double, 2>> points;  // distance from the axis, height
};
struct SorShape {
  bool open = false;
  bool sturm = false;
  std::vector<std::array<double, 2>> points;  // likewise; the first and the last steer only
};
struct SphereSweepShape {
  CurveKind curve = CurveKind::linear;
  bool b_spline = false;
  std::vector<std::pair<V3d, double>> spheres;
};
struct BicubicPatchShape {
  int type = 0;
  double flatness = 0.0;
  int u_steps = 0;
  int v_steps = 0;
  std::array<V3d, 16> points;
};
struct TextShape {
  struct Glyph {
    V3d pen{0.0};  // its origin
    std::vector<CurvePiece> outline;
  };
  std::vector<Glyph> glyphs;
  double thickness = 1.0;
  Imath::Box3d bounds;
};
struct IsosurfaceShape {
  std::shared_ptr<const Function> function;
  bool sphere = false;  // contained by a sphere instead of a box
  V3d low{-1.0};        // or the centre
  V3d high{1.0};
  double radius = 1.0;
  double threshold = 0.0;
  double accuracy = 0.001;
  double max_gradient = 1.1;
  bool open = false;
  bool all_intersections = false;
};
struct ParametricShape {
  std::array<std::shared_ptr<const Function>, 3> functions;
  std::array<double, 2> low{};
  std::array<double, 2> high{};
};
struct JuliaShape {
  std::array<double, 4> parameter{};
};

enum class Combination : std::uint8_t { union_, merge, intersection, difference };
struct CombinedShape {
  Combination combination = Combination::union_;
  bool split_union = true;
  std::vector<std::shared_ptr<const Object>> parts;
  Imath::Box3d bounds;
};

using Shape =
    std::variant<SphereShape, BoxShape, PlaneShape, ConeShape, TorusShape, DiscShape,
                 std::shared_ptr<const TriangleShape>, std::shared_ptr<const PolygonShape>,
                 std::shared_ptr<const MeshShape>, std::shared_ptr<const QuadricShape>,
                 std::shared_ptr<const PolyShape>, SuperellipsoidShape,
                 std::shared_ptr<const BlobShape>, std::shared_ptr<const HeightFieldShape>,
                 std::shared_ptr<const PrismShape>, std::shared_ptr<const LatheShape>,
                 std::shared_ptr<const SorShape>, std::shared_ptr<const SphereSweepShape>,
                 std::shared_ptr<const BicubicPatchShape>, std::shared_ptr<const TextShape>,
                 std::shared_ptr<const IsosurfaceShape>, std::shared_ptr<const ParametricShape>,
                 JuliaShape, std::shared_ptr<const CombinedShape>,
                 std::shared_ptr<const struct LightSource>>;

}  // namespace lumivec::pov
