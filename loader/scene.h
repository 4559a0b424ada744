// The scene contract: everything the integrator may know of a scene, and nothing of the file it
// came from.
//
// Plain data; the one behaviour is that of a SurfacePattern. Conventions, everywhere:
//   - right-handed coordinates; distances in scene units (glTF: metres); angles in radians;
//   - colours are linear Rec. 709 / D65 triples;
//   - light is in one consistent photometric system: radiance in cd·m⁻² (nit), intensity in cd,
//   irradiance in lx.
//     A file that speaks of watts is taken over number for number: only ratios show in a picture;
//   - transforms act on column vectors in the usual notation but are stored as Imath stores them
//   (row vectors:
//     p' = p · M, translation in the last row), in double precision;
//   - an index of -1 means "none".
#pragma once

#include <ImathBox.h>
#include <ImathColor.h>
#include <ImathMatrix.h>
#include <ImathVec.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace lumivec {

using Imath::M33f;
using Imath::M44d;
using Imath::V2f;
using Imath::V3d;
using Imath::V3f;
using Imath::V4d;
using Imath::V4f;
using Color = Imath::C3f;  // linear Rec. 709, or a dimensionless reflectance

// A picture with four channels, row 0 at the top. Exactly one of the two arrays is filled.
struct Image {
  std::string name;
  int width = 0;   // pixels
  int height = 0;  // pixels
  std::vector<std::uint8_t>
      rgba8;  // width × height × 4, encoded as TextureMap::encoding says, alpha not premultiplied
  std::vector<float> rgba32f;  // width × height × 4, likewise; radiance for environments
};

enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class Filter : std::uint8_t { nearest, linear };
enum class Encoding : std::uint8_t {
  linear,
  srgb
};  // of the colour channels; alpha is always linear

// How a surface reads an image. (u, v) = (0, 0) is the upper left corner of the upper left pixel; v
// grows downwards.
struct TextureMap {
  int image = -1;  // index into Scene::images
  int uv_set = 0;  // index into Mesh::uvs
  Encoding encoding = Encoding::linear;
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  Filter filter = Filter::linear;
  M33f uv_transform;  // row vectors: (u, v, 1) · uv_transform; identity by default
};

enum class AlphaMode : std::uint8_t {
  opaque,  // alpha is ignored
  mask,    // the surface is there where alpha ≥ alpha_cutoff
  blend    // the surface covers the share alpha of what lies behind it
};

// What a SurfacePattern says of a point; each field stands in place of Material's own.
struct PatternedSurface {
  Color base_color{1.0f};
  Color emission{0.0f};
  Color specular_color{1.0f};
  float roughness = 1.0f;
  float specular = 1.0f;
  float transmission = 0.0f;  // ignored where the material's own is 0
};

// A surface as a function of position, for patterns that fill space. Evaluated by many threads at
// once, at every hit of the materials that name it.
class SurfacePattern {
 public:
  SurfacePattern() = default;
  SurfacePattern(const SurfacePattern&) = delete;
  SurfacePattern& operator=(const SurfacePattern&) = delete;
  virtual ~SurfacePattern() = default;

  // point: world space. normal: unit, of the geometry there. error: how far the point may be off
  // the surface, scene units; cells that meet in the surface itself are told apart by it.
  virtual PatternedSurface at(const V3d& point, const V3d& normal, double error) const noexcept = 0;

  // The normal that is shaded. normal: unit, world space, on the outer side, as it is without
  // bumps. The result is of unit length, on either side.
  virtual V3d bent(const V3d& /*point*/, const V3d& normal) const noexcept { return normal; }
};

// A metallic-roughness surface with coat, transmission and absorption. Each map multiplies its
// factor.
struct Material {
  std::string name;

  Color base_color{1.0f};     // reflectance (diffuse), F0 (metal), or tint of transmitted light
  float opacity = 1.0f;       // alpha factor, [0, 1]
  TextureMap base_color_map;  // RGB × base_color, A × opacity
  bool vertex_colors = true;  // Mesh::colors, where present, multiply base_color and opacity
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;  // for AlphaMode::mask

  float metallic = 0.0f;              // [0, 1]
  float roughness = 1.0f;             // perceptual, [0, 1]; GGX α = roughness²
  TextureMap metallic_roughness_map;  // G × roughness, B × metallic

  TextureMap normal_map;      // tangent space, RGB = (n + 1) / 2, +Y up
  float normal_scale = 1.0f;  // multiplies the map's x and y

  Color emission{
      0.0f};  // radiance, cd·m⁻²; leaves the front side, and the back of double-sided surfaces
  TextureMap emission_map;

  bool double_sided =
      false;  // one-sided surfaces are still opaque to light from behind; they emit in front only
  bool unlit = false;  // base_color is shown as radiance and reflects nothing

  float ior =
      1.5f;  // index of refraction of the dielectric, ≥ 1; 0 means: reflects everything (F0 = 1)
  float specular =
      1.0f;  // strength of the dielectric reflection, [0, 1]; 0 makes it purely diffuse
  TextureMap specular_map;        // A × specular
  Color specular_color{1.0f};     // tint of the dielectric's F0, ≥ 0
  TextureMap specular_color_map;  // RGB × specular_color

  float transmission =
      0.0f;  // share of the non-reflected light that passes instead of being diffused, [0, 1]
  TextureMap transmission_map;  // R × transmission
  bool thin_walled =
      true;  // true: an infinitely thin sheet, does not bend light; false: the boundary of a volume
  float attenuation_distance =
      std::numeric_limits<float>::infinity();  // scene units, > 0: where attenuation_color is
                                               // reached
  Color attenuation_color{1.0f};               // transmittance after attenuation_distance, (0, 1]

  float clearcoat = 0.0f;              // strength of the coat (index 1.5), [0, 1]
  TextureMap clearcoat_map;            // R × clearcoat
  float clearcoat_roughness = 0.0f;    // perceptual, [0, 1]
  TextureMap clearcoat_roughness_map;  // G × clearcoat_roughness
  TextureMap clearcoat_normal_map;  // the coat's own; without it the coat has the geometry's normal
  float clearcoat_normal_scale = 1.0f;

  // Index into Scene::patterns. What the pattern says varies is then, above, its mean; emission and
  // transmission of 0 are 0 everywhere.
  int pattern = -1;
};

// Indexed triangles in object space. Attribute arrays are empty or as long as positions.
struct Mesh {
  std::string name;
  std::vector<V3f> positions;  // scene units
  std::vector<V3f> normals;    // unit length; empty: flat, from the triangles
  std::vector<V4f>
      tangents;  // xyz unit length, w = ±1 handedness of the bitangent; empty: from the UVs
  std::vector<std::vector<V2f>> uvs;  // one array per UV set
  std::vector<V4f> colors;            // linear RGBA
  std::vector<Imath::Vec3<std::uint32_t>>
      triangles;  // vertex indices, each < positions.size(); counter-clockwise from the front
};

// Marks an instance that is an exact sphere and not a mesh.
// Its UVs: u = atan2(z, x) / 2π + 1/2, v = acos(y) / π on the unit sphere of object space.
struct Sphere {
  float radius = 1.0f;  // scene units, around the origin of object space
};

enum class SolidShape : std::uint8_t {
  box,         // from -1 to 1 along each axis
  sphere,      // of radius 1 around the origin
  cone,        // around y from 0, where it has base_radius, to 1, where it has cap_radius; closed
  torus,       // around y: a ring of radius 1, as thick as minor_radius, < 1
  polynomial,  // where the sum of the terms is below 0; may be infinite
  prism,  // within the curve, whose u is x and v is z, for low ≤ y ≤ high; with conic the curve
          // is that at y = 1 and grows in proportion to y
  lathe,  // within the curve turned around y: u is the distance from y, v the height
  sor,    // the same, but u is the distance's square and v is linear
  superellipsoid,  // (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) < 1, by its exponents e and n
  blob,            // where the sum of the components is above the threshold
  sweep            // all spheres along the pieces
};

// coefficient · x^powers[0] · y^powers[1] · z^powers[2]
struct PolynomialTerm {
  std::array<std::uint8_t, 3> powers{};
  double coefficient = 0.0;
};
constexpr int max_polynomial_degree = 8;  // sum of the powers of one term

// Coefficients of 1, s, s² and s³ for 0 ≤ s ≤ 1.
using Cubic = std::array<double, 4>;

// A stretch of a plane curve. Each begins exactly where one before it ends, and curves are closed,
// but lathes and sors may begin and end on the axis, where u = 0. Insides are where an odd number
// of curves is around.
struct CurvePiece {
  Cubic u{};
  Cubic v{};
  std::array<double, 2> end{};  // where the next begins, without what s = 1 would round off
  bool hidden = false;          // bounds the inside but is not seen
};

// A density strength · (1 - d²)², d being the distance from a point or a stretch of a line; 0 where
// d is above 1.
struct BlobComponent {
  M44d to_component;      // from the blob's space, in which the stretch is y from 0 to length
  double length = 0.0;    // 0: a point
  double strength = 1.0;  // may be negative
};

// Spheres whose centre and radius move along.
struct SweepPiece {
  std::array<Cubic, 3> center{};
  Cubic radius{};
};

// A primitive that solids are combined from.
struct SolidLeaf {
  SolidShape shape = SolidShape::sphere;
  M44d to_solid;               // from the primitive's space to the solid's; affine, invertible
  double base_radius = 1.0;    // cone, ≥ 0; not both 0
  double cap_radius = 1.0;     // cone, ≥ 0
  double minor_radius = 0.25;  // torus, (0, 1)
  std::vector<PolynomialTerm> terms;  // polynomial
  std::vector<CurvePiece> curve;      // prism, lathe, sor
  double low = 0.0, high = 1.0;       // prism, low < high
  bool conic = false;                 // prism
  bool open = false;         // cone, prism: the flat ends bound the inside but are not seen
  double east_west = 1.0;    // superellipsoid: e, > 0
  double north_south = 1.0;  // superellipsoid: n, > 0
  std::vector<BlobComponent> components;
  double threshold = 0.5;  // blob, > 0
  std::vector<SweepPiece> sweep;
  int part = 0;  // which of the solid's instances shows the primitive's share of the surface
};

enum class SolidOperation : std::uint8_t { leaf, unite, intersect };

// One node of the trees of a solid, each stored in preorder.
struct SolidNode {
  SolidOperation operation = SolidOperation::leaf;
  bool complement = false;  // stands for all that is outside of it
  int parent = -1;          // index into Solid::nodes, less than this one's; -1: a root
  int leaf = -1;            // index into Solid::leaves
  int end = 0;              // index behind the last node below this one
  Imath::Box3d bounds;      // solid's space, around the node before the complement; may be infinite
};

// An exact combination of primitives (constructive solid geometry). The first root is the solid;
// of its surface only what lies inside all further roots is there, without new faces.
struct Solid {
  std::vector<SolidNode> nodes;
  std::vector<SolidLeaf> leaves;
  Imath::Box3d bounds;  // object space, finite, not empty; the surface ends there
};

// A shape placed in the world. Exactly one of mesh, sphere and solid is set.
struct Instance {
  std::string name;
  int mesh = -1;         // index into Scene::meshes
  int sphere = -1;       // index into Scene::spheres
  int material = -1;     // index into Scene::materials; -1: the default Material
  int node = -1;         // index into Scene::nodes, for animation
  M44d object_to_world;  // affine, invertible; may mirror and scale unevenly
  bool visible = true;   // false: an animation has it scaled to nothing or too far away, it is not
                         // to be drawn, and object_to_world is the identity
  int solid = -1;        // index into Scene::solids; must not emit light
  int solid_part = 0;    // which leaves' surface is shown: instances share a solid of several
                         // materials
  bool seen_by_eye = true;          // directly and through what is transparent
  bool seen_in_reflections = true;  // sharp and glossy ones
  bool casts_shadows = true;        // of lights without extent
};

enum class LightKind : std::uint8_t { point, spot, directional, beam };

// A light without extent. Emissive surfaces are lights too, but are found from Material::emission.
struct Light {
  std::string name;
  LightKind kind = LightKind::point;
  Color intensity{1.0f};    // point, spot: luminous intensity, cd; directional: illuminance on a
                            // facing surface, lx
  float inner_cone = 0.0f;  // spot: half angle of full intensity, radians
  float outer_cone =
      0.785398163f;  // spot: half angle beyond which it is dark, radians, > inner_cone, ≤ π/2
  float range = std::numeric_limits<float>::infinity();  // scene units; informative only: light
                                                         // falls off with the square
  M44d object_to_world;  // position from the translation; shines along object -Z; scale is ignored
  int node = -1;

  bool casts_shadows = true;  // false: its light passes through everything
  float fade_distance =
      0.0f;                 // scene units; > 0: the light does not fall off with the square, but
                            // intensity, lx, times 2 / (1 + (distance / fade_distance)^fade_power)
  float fade_power = 0.0f;  // ≥ 0
  float tightness = 0.0f;   // ≥ 0; spot: a power of the cosine to the axis; beam: of what is left
                            // of the way from the axis to outer_radius
  bool smooth_edge = false;   // spot: t²(3 - 2t) and not t² between the cones, t by their cosines
  float inner_radius = 0.0f;  // beam: of full intensity, scene units; smooth_edge beyond
  float outer_radius = 0.0f;  // beam: where it ends, ≥ inner_radius; its rays are parallel
  // Point, spot: half axes of the parallelogram or (round_shadows) ellipse that shadows are those
  // of, world space; all else is as if the light were in its middle.
  V3f shadow_u{0.0f}, shadow_v{0.0f};
  bool round_shadows = false;
};

// With X and Y in the picture from -1/2 to 1/2, right and up, rays go along
enum class CameraKind : std::uint8_t {
  perspective,
  orthographic,
  fisheye,           // at an angle to the axis that grows with the distance from the middle
  spherical,         // the longitude X · xangle and the latitude Y · yangle
  ultra_wide,        // (sin a, sin b, -cos a · cos b), a = X · xangle, b = Y · yangle
  panoramic,         // (2 xmag · sin πX, 2 ymag · tan πY, -cos πX)
  upright_cylinder,  // (sin a, 2 ymag · Y, -cos a), a = X · xangle
  lying_cylinder     // (2 xmag · X, sin b, -cos b), b = Y · yangle
};

// A pinhole or parallel view. Looks along object -Z, +Y up.
struct Camera {
  std::string name;
  CameraKind kind = CameraKind::perspective;
  // Full vertical angle, radians, (0, π). Wide kinds: of the perspective that stands for them where
  // only flat pictures will do.
  float yfov = 0.785398163f;
  // Wide kinds: full angles across the picture, radians. Fisheye: yangle is its height's, the width
  // follows from the picture's shape, and nothing is seen beyond xangle / 2 from the axis. Ultra
  // wide: xangle too follows from the picture's shape.
  float xangle = 6.28318531f;
  float yangle = 3.14159265f;
  float aspect = 0.0f;  // width / height the file asks for; 0: whatever the picture has
  float xmag = 1.0f;    // orthographic: half width, scene units
  float ymag = 1.0f;    // orthographic: half height, scene units
  float znear = 0.0f;   // scene units along the view axis; nearer surfaces are not seen by the eye
  float zfar = std::numeric_limits<float>::infinity();
  M44d camera_to_world;  // rigid up to scale; scale is ignored
  int node = -1;
};

// Light from infinitely far away. Latitude-longitude map: the centre column looks along -Z, +Y is
// the top row, columns grow towards +X. Turned by rotation about +Y, counter-clockwise seen from
// above.
struct Environment {
  int image = -1;         // index into Scene::images (rgba32f); -1: constant
  Color radiance{0.0f};   // cd·m⁻²; multiplies the image, or is the constant
  float rotation = 0.0f;  // radians
};

// The transform tree, kept so that animation can move it. Instances, lights and cameras already
// hold world transforms.
struct Node {
  std::string name;
  int parent = -1;  // index into Scene::nodes
  M44d local_to_parent;
  M44d local_to_world;  // may be singular or not finite
};

enum class AnimationTarget : std::uint8_t { translation, rotation, scale, weights };
enum class Interpolation : std::uint8_t { step, linear, cubic_spline };

// One animated property of one node, as data; pose_scene (loader/animate.h) plays it.
struct AnimationChannel {
  int node = -1;  // index into Scene::nodes
  AnimationTarget target = AnimationTarget::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;   // seconds, increasing; at least one
  std::vector<float> values;  // 3 per key (translation: scene units; scale), 4 (rotation:
                              // quaternion x y z w, not zero) or one per morph weight;
                              // cubic_spline: in-tangent, value, out-tangent per key
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
};

// The local transform of a node at rest, in the parts that animations replace.
struct RestTransform {
  int node = -1;                     // index into Scene::nodes
  V3d translation{0.0};              // scene units
  V4d rotation{0.0, 0.0, 0.0, 1.0};  // quaternion x y z w, of any length but 0
  V3d scale{1.0};                    // comes first, then rotation, then translation
};

// What a morph target adds to the vertices at weight 1. Each array is empty, for nothing, or as
// long as the mesh's.
struct MorphTarget {
  std::vector<V3f> positions;  // scene units
  std::vector<V3f> normals;
  std::vector<V3f> tangents;  // xyz; the handedness stays
};

// Up to four of the joints that each vertex hangs on; more take more of these sets.
struct JointSet {
  std::vector<Imath::Vec4<std::uint16_t>> joints;  // indices into Skin::joints
  std::vector<V4f> weights;  // finite, ≥ 0; shares of the sum over all sets; all 0: no joint
};

// The joints that meshes hang on.
struct Skin {
  std::vector<int> joints;          // indices into Scene::nodes
  std::vector<M44d> inverse_binds;  // of each joint: from the vertices' object space to the joint's
};

// A mesh whose vertices animations move: first the morph targets, then the joints.
struct Deformation {
  int mesh = -1;               // index into Scene::meshes: the result
  std::vector<V3f> positions;  // of the undeformed mesh, in number as the mesh's; scene units
  std::vector<V3f> normals;    // likewise, or empty
  std::vector<V4f> tangents;   // likewise, or empty
  std::vector<MorphTarget> targets;
  std::vector<float> rest_weights;   // of each target, where no animation sets it
  std::vector<float> weights;        // of each target, as posed
  int weights_node = -1;             // index into Scene::nodes, whose channels set the weights
  int skin = -1;                     // index into Motion::skins; -1: no joints
  std::vector<JointSet> joint_sets;  // each array as long as positions; empty without a skin
  bool turned = false;  // as posed: joints mirror the mesh, and its triangles are turned to match
  Imath::Box3d bounds;  // as posed, object space; empty: a vertex has no finite place
};

// An instance that animations move, deform or hide.
struct MovingInstance {
  int instance = -1;     // index into Scene::instances
  int node = -1;         // index into Scene::nodes; -1: joints place its vertices in the world
  M44d object_to_node;   // to the world for node -1
  int deformation = -1;  // index into Motion::deformations
  Imath::Box3d bounds;   // object space, of a shape without deformation
};

// What animations can change, found while loading, so that posing the scene looks at nothing else.
// All empty for a scene without animations.
struct Motion {
  std::vector<int> nodes;           // the animated ones and all below, parents before children
  std::vector<RestTransform> rest;  // by node, ascending; of all whose transform is animated
  std::vector<MovingInstance> instances;
  std::vector<Skin> skins;
  std::vector<Deformation> deformations;
};

struct Scene {
  std::string name;
  std::vector<Image> images;
  std::vector<Material> materials;
  std::vector<std::shared_ptr<const SurfacePattern>> patterns;  // none is null
  std::vector<Mesh> meshes;
  std::vector<Sphere> spheres;
  std::vector<Solid> solids;
  std::vector<Instance> instances;
  std::vector<Light> lights;
  std::vector<Camera> cameras;  // at least one after loading
  Environment environment;
  std::vector<Node> nodes;
  std::vector<Animation> animations;
  Motion motion;
};

}  // namespace lumivec
