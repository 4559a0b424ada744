// A described scene to Scene: what each part of the conversion shares.
//
// The scene's coordinates are left-handed. One matrix, Conversion::to_world, takes everything to
// the right-handed world: it mirrors z, unless the camera's own axes are mirrored, as right-handed
// scenes have them; then both agree already.
#pragma once

#include <array>
#include <map>
#include <tuple>

#include "loader/pov/parser.h"

namespace lumivec::pov {

// All that surface_of says of a material.
using MaterialKey = std::array<float, 19>;

// What a material with a pattern comes from.
struct PatternKey {
  std::shared_ptr<const Texture> texture;
  std::shared_ptr<const Interior> interior;
  bool lamp = false;
  std::array<double, 16> to_world{};  // of the texture

  bool operator<(const PatternKey& other) const {
    return std::tie(texture, interior, lamp, to_world) <
           std::tie(other.texture, other.interior, other.lamp, other.to_world);
  }
};

struct Conversion {
  Parser& parser;
  const PovScene& scene;
  Scene& out;
  M44d to_world;
  double reach = 1e4;   // of infinite shapes, scene units
  V3d focus{0.0};       // what the camera looks at, in the scene's coordinates
  double extent = 1.0;  // radius of the finite shapes around it
  std::map<std::tuple<const void*, const void*, bool>, int> materials;  // by what they come from
  std::map<PatternKey, int> patterned;
  std::map<MaterialKey, int> distinct;  // by what they are
};

// Objects and lamps become instances and lights.
void convert_objects(Conversion& conversion);

// axis: the light's transform to the scene's coordinates.
void convert_light(Conversion& conversion, const LightSource& light, const M44d& transform,
                   const Place& place);
// The object that a lamp looks like, which is not in the way of its light.
void convert_lamp_object(Conversion& conversion, const Object& object, const M44d& transform);

// The picture of a height field as triangles, in the unit cube. Null: the picture cannot be
// had, which is mentioned.
std::shared_ptr<const MeshShape> height_field_mesh(Parser& parser, const HeightFieldShape& field,
                                                   const Place& place);

void convert_camera(Conversion& conversion);
void convert_sky(Conversion& conversion);

// Finds focus, extent, reach and handedness. The scene must have a camera by now.
void survey(Conversion& conversion);

}  // namespace lumivec::pov
