#include <ImathBoxAlgo.h>

#include <algorithm>
#include <cmath>

#include "loader/placement.h"
#include "loader/pov/bounds.h"
#include "loader/pov/conversion.h"
#include "loader/pov/exact_solids.h"
#include "loader/pov/finiteness.h"
#include "loader/pov/solids.h"
#include "loader/pov/surfaces.h"
#include "loader/pov/tessellation.h"

namespace lumivec::pov {
namespace {

// What an object takes from those around it.
struct Around {
  M44d transform;  // to the scene's coordinates
  M44d to_world;   // the same, and on to the world
  std::shared_ptr<const Texture> texture;
  M44d texture_transform;  // of the texture, to the scene's coordinates
  std::shared_ptr<const Interior> interior;
  Clips clips;                                             // what cuts the object's surface
  Imath::Box3d bounds{V3d(-beyond_all), V3d(beyond_all)};  // in the scene's coordinates
  bool lamp = false;
  bool seen_by_eye = true, seen_in_reflections = true, casts_shadows = true;
  bool inside_out = false;  // what a difference takes away, and inverse objects
};

void set_visibility(const Around& around, Instance& instance) {
  instance.seen_by_eye = around.seen_by_eye;
  instance.seen_in_reflections = around.seen_in_reflections;
  instance.casts_shadows = around.casts_shadows;
}

const char* shape_name(const Shape& shape) {
  if (std::holds_alternative<std::shared_ptr<const HeightFieldShape>>(shape)) return "height field";
  if (std::holds_alternative<std::shared_ptr<const TextShape>>(shape)) return "text";
  if (std::holds_alternative<std::shared_ptr<const SphereSweepShape>>(shape)) return "sphere sweep";
  if (std::holds_alternative<std::shared_ptr<const ParametricShape>>(shape))
    return "parametric surface";
  if (std::holds_alternative<JuliaShape>(shape)) return "julia fractal";
  if (std::holds_alternative<std::shared_ptr<const IsosurfaceShape>>(shape))
    return "isosurface of a function that cannot be evaluated";
  return "shape";
}

void mention_surface(Parser& parser, const Place& place, const SurfaceNotes& notes) {
  if (notes.averaged)
    parser.mention(place, "a pattern that is not followed became its average color");
  if (notes.ambient) {
    parser.mention(place,
                   "ambient light is left out: light comes from lamps, the sky and surfaces");
  }
  if (notes.bumps) parser.mention(place, "bumps of a normal are left out");
  if (notes.metallic) parser.mention(place, "a metallic highlight has the color of the light");
  if (notes.brilliance) parser.mention(place, "brilliance is left out");
}

bool is_finite(const Material& m) {
  for (const Color& c : {m.base_color, m.emission, m.specular_color, m.attenuation_color}) {
    if (!fits_float(V3d(c))) return false;
  }
  return std::isfinite(m.roughness) && std::isfinite(m.ior) && std::isfinite(m.specular) &&
         std::isfinite(m.transmission) && !std::isnan(m.attenuation_distance);
}

MaterialKey key_of(const Material& m) {
  const auto flag = [](bool value) { return value ? 1.0f : 0.0f; };
  return {m.base_color.x,
          m.base_color.y,
          m.base_color.z,
          m.emission.x,
          m.emission.y,
          m.emission.z,
          m.specular_color.x,
          m.specular_color.y,
          m.specular_color.z,
          m.attenuation_color.x,
          m.attenuation_color.y,
          m.attenuation_color.z,
          m.attenuation_distance,
          m.roughness,
          m.ior,
          m.specular,
          m.transmission,
          flag(m.thin_walled),
          flag(m.double_sided)};
}

void check_finite(Conversion& conversion, const Object& object, const Material& material) {
  if (!is_finite(material))
    conversion.parser.fail_at(
        object.place, "a color or other number of the object's surface is not finite or too large");
}

// Materials whose pattern fills the world differ by how the texture is placed in it.
int patterned_material_of(Conversion& conversion, const Object& object, const Around& around,
                          const std::shared_ptr<const Texture>& texture,
                          const Imath::Box3d& world_bounds) {
  const M44d to_world = around.texture_transform * conversion.to_world;
  PatternKey key;
  key.texture = texture;
  key.interior = around.interior;
  key.lamp = around.lamp;
  std::copy(to_world.getValue(), to_world.getValue() + key.to_world.size(), key.to_world.begin());
  const auto known = conversion.patterned.find(key);
  if (known != conversion.patterned.end()) return known->second;
  SurfaceChoice choice;
  choice.gamma = conversion.scene.settings.assumed_gamma;
  choice.lamp = around.lamp;
  choice.bounds = world_bounds;
  choice.world_to_texture = to_world.inverse();
  SurfaceNotes notes;
  Material material = surface_of(*texture, around.interior.get(), choice, notes);
  mention_surface(conversion.parser, object.place, notes);
  check_finite(conversion, object, material);
  constexpr std::size_t pattern_bytes = 512;  // of the pattern itself, which shares the texture
  conversion.parser.claim(sizeof(Material) + sizeof(PatternKey) + pattern_bytes);
  material.pattern = static_cast<int>(conversion.out.patterns.size());
  conversion.out.patterns.push_back(pattern_of(texture, around.interior, choice, material));
  const int index = static_cast<int>(conversion.out.materials.size());
  conversion.out.materials.push_back(std::move(material));
  conversion.patterned.emplace(std::move(key), index);
  return index;
}

int material_of(Conversion& conversion, const Object& object, const Around& around,
                const Imath::Box3d& world_bounds) {
  static const auto usual = [] {
    auto texture = std::make_shared<Texture>();
    texture->layers.emplace_back();
    return std::shared_ptr<const Texture>(texture);
  }();
  const std::shared_ptr<const Texture>& texture = around.texture ? around.texture
                                                  : conversion.scene.default_texture
                                                      ? conversion.scene.default_texture
                                                      : usual;
  const auto key = std::make_tuple(static_cast<const void*>(texture.get()),
                                   static_cast<const void*>(around.interior.get()), around.lamp);
  const auto known = conversion.materials.find(key);
  if (known != conversion.materials.end()) return known->second;
  if (varies(*texture))
    return patterned_material_of(conversion, object, around, texture, world_bounds);
  SurfaceChoice choice;
  choice.gamma = conversion.scene.settings.assumed_gamma;
  choice.lamp = around.lamp;
  SurfaceNotes notes;
  Material material = surface_of(*texture, around.interior.get(), choice, notes);
  mention_surface(conversion.parser, object.place, notes);
  check_finite(conversion, object, material);
  const auto [same, fresh] = conversion.distinct.try_emplace(
      key_of(material), static_cast<int>(conversion.out.materials.size()));
  if (fresh) conversion.out.materials.push_back(std::move(material));
  // Objects that say their textures each for themselves must not grow this beyond what they hold.
  conversion.parser.claim(sizeof(*conversion.materials.begin()));
  conversion.materials.emplace(key, same->second);
  return same->second;
}

void add_instance(Conversion& conversion, const Object& object, const Around& around, int mesh,
                  int sphere, const M44d& object_to_world, const Imath::Box3d& bounds) {
  if (placement(bounds, object_to_world) != Placement::shown) {
    conversion.parser.mention(object.place,
                              "an object without extent, or too far away, is left out");
    return;
  }
  conversion.parser.claim(sizeof(Instance));
  Instance instance;
  instance.mesh = mesh;
  instance.sphere = sphere;
  instance.material =
      material_of(conversion, object, around, Imath::transform(bounds, object_to_world));
  instance.object_to_world = object_to_world;
  set_visibility(around, instance);
  conversion.out.instances.push_back(std::move(instance));
}

// All spheres are the unit sphere, placed.
void add_sphere(Conversion& conversion, const Object& object, const Around& around,
                const SphereShape& sphere) {
  const double radius = std::abs(sphere.radius);
  if (radius == 0.0) return;
  if (conversion.out.spheres.empty()) conversion.out.spheres.push_back({1.0f});
  M44d place;
  place.setScale(V3d(radius));
  place[3][0] = sphere.center.x;
  place[3][1] = sphere.center.y;
  place[3][2] = sphere.center.z;
  add_instance(conversion, object, around, -1, 0, place * around.to_world, {V3d(-1.0), V3d(1.0)});
}

void turn_inside_out(Mesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t.y, t.z);
  for (V3f& n : mesh.normals) n = -n;
}

void add_mesh(Conversion& conversion, const Object& object, const Around& around, Mesh mesh,
              const M44d& object_to_world) {
  if (mesh.triangles.empty()) return;
  if (around.inside_out) turn_inside_out(mesh);
  const auto is_finite = [](const V3f& v) { return fits_float(V3d(v)); };
  if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), is_finite) ||
      !std::all_of(mesh.normals.begin(), mesh.normals.end(), is_finite)) {
    conversion.parser.fail_at(object.place,
                              "a point or normal of the object is not finite or too large");
  }
  Imath::Box3d bounds;
  for (const V3f& p : mesh.positions) bounds.extendBy(V3d(p));
  conversion.parser.claim(mesh.positions.size() * (sizeof(V3f) * (mesh.normals.empty() ? 1 : 2)) +
                          mesh.triangles.size() * sizeof(mesh.triangles[0]));
  const std::size_t before = conversion.out.instances.size();
  add_instance(conversion, object, around, static_cast<int>(conversion.out.meshes.size()), -1,
               object_to_world, bounds);
  if (conversion.out.instances.size() > before) conversion.out.meshes.push_back(std::move(mesh));
}

// A surface that others cut is made in the scene's coordinates, where their insides are known.
void add_cut_surface(Conversion& conversion, const Object& object, const Around& around) {
  // Modifiers stand in the space around the object.
  Object in_scene = object;
  in_scene.transform = std::make_shared<const M44d>(around.transform);
  in_scene.extras = nullptr;
  const Imath::Box3d region = overlap(bounds_of(in_scene), around.bounds);
  const auto surface = solid_surface(object.shape, around.transform, around.clips, region,
                                     conversion.reach, conversion.focus);
  if (!surface) {
    conversion.parser.mention(object.place,
                              std::string("a ") + shape_name(object.shape) + " is left out");
    return;
  }
  add_mesh(conversion, object, around, *surface, conversion.to_world);
}

// Boxes and planes as they are need no solid, and spheres have a form of their own.
bool wants_solid(const Shape& shape, bool clipped) {
  if (const auto* combined = std::get_if<std::shared_ptr<const CombinedShape>>(&shape))
    return (*combined)->combination != Combination::union_;
  if (std::holds_alternative<SphereShape>(shape) || std::holds_alternative<BoxShape>(shape) ||
      std::holds_alternative<PlaneShape>(shape))
    return clipped;
  return std::holds_alternative<ConeShape>(shape) || std::holds_alternative<TorusShape>(shape) ||
         std::holds_alternative<std::shared_ptr<const QuadricShape>>(shape) ||
         std::holds_alternative<std::shared_ptr<const PolyShape>>(shape) ||
         std::holds_alternative<SuperellipsoidShape>(shape) ||
         std::holds_alternative<std::shared_ptr<const PrismShape>>(shape) ||
         std::holds_alternative<std::shared_ptr<const LatheShape>>(shape) ||
         std::holds_alternative<std::shared_ptr<const SorShape>>(shape) ||
         std::holds_alternative<std::shared_ptr<const BlobShape>>(shape) ||
         std::holds_alternative<std::shared_ptr<const SphereSweepShape>>(shape) ||
         std::holds_alternative<std::shared_ptr<const TextShape>>(shape);
}

bool fits_tracing(const Solid& solid) {
  return !solid.bounds.isEmpty() && fits_float(solid.bounds.min) && fits_float(solid.bounds.max);
}

// False: the object has no exact form, or gives light, which only triangles do.
bool add_solid(Conversion& conversion, const Object& object, const Around& around) {
  if (around.lamp || !wants_solid(object.shape, !around.clips.empty())) return false;
  Object in_scene = object;
  in_scene.transform = std::make_shared<const M44d>(around.transform);
  in_scene.extras = nullptr;
  in_scene.inverse = false;
  Imath::Box3d region = overlap(bounds_of(in_scene), around.bounds);
  for (const auto& clip : around.clips) {
    if (clip->inside()) region = overlap(region, clip->bounds());
  }
  std::vector<int> materials;  // by part
  SolidBuilder builder([&](const Object& leaf, const SolidAppearance& appearance) {
    Around own = around;
    own.texture = appearance.texture;
    own.texture_transform = appearance.texture_transform;
    own.interior = appearance.interior;
    const int material =
        material_of(conversion, leaf, own, Imath::transform(region, conversion.to_world));
    if (conversion.out.materials[static_cast<std::size_t>(material)].emission != Color(0.0f))
      return -1;
    const auto known = std::find(materials.begin(), materials.end(), material);
    const auto part = static_cast<int>(known - materials.begin());
    if (known == materials.end()) materials.push_back(material);
    return part;
  });
  if (!builder.add_surface(object, around.transform,
                           {around.texture, around.texture_transform, around.interior},
                           around.inside_out))
    return false;
  for (const auto& clip : around.clips) {
    if (!builder.add_clip(*clip)) return false;
  }
  if (region.isEmpty()) return true;
  Solid solid = builder.take(region, conversion.reach);
  if (!fits_tracing(solid) || placement(solid.bounds, conversion.to_world) != Placement::shown) {
    conversion.parser.mention(object.place,
                              "an object without extent, or too far away, is left out");
    return true;
  }
  std::size_t bytes = sizeof(Solid) + materials.size() * sizeof(Instance) +
                      solid.nodes.size() * sizeof(SolidNode) +
                      solid.leaves.size() * sizeof(SolidLeaf);
  constexpr std::size_t tree_bytes = 200;  // of each element, with what finds it along a ray
  for (const SolidLeaf& leaf : solid.leaves) {
    bytes += leaf.terms.size() * sizeof(PolynomialTerm) +
             leaf.curve.size() * (sizeof(CurvePiece) + tree_bytes) +
             leaf.components.size() * (sizeof(BlobComponent) + tree_bytes) +
             leaf.sweep.size() * (sizeof(SweepPiece) + tree_bytes);
  }
  conversion.parser.claim(bytes);
  for (std::size_t part = 0; part < materials.size(); ++part) {
    Instance instance;
    instance.solid = static_cast<int>(conversion.out.solids.size());
    instance.solid_part = static_cast<int>(part);
    instance.material = materials[part];
    instance.object_to_world = conversion.to_world;
    set_visibility(around, instance);
    conversion.out.instances.push_back(std::move(instance));
  }
  conversion.out.solids.push_back(std::move(solid));
  return true;
}

std::shared_ptr<const Clip> make_clip(Parser& parser, const std::shared_ptr<const Object>& object,
                                      const M44d& around, bool inside) {
  parser.claim(object->measure.count * sizeof(Inside));
  return std::make_shared<const Clip>(object, around, inside);
}

// What clips an object, and what tells where infinite surfaces of it matter.
void add_bounds(Parser& parser, const ObjectExtras& extras, const M44d& outside, Around& around) {
  for (const auto& clip : extras.clipped_by)
    around.clips.push_back(make_clip(parser, clip, outside, true));
  for (const auto& bound : extras.bounded_by) {
    const auto clip = make_clip(parser, bound, outside, true);
    around.bounds = overlap(around.bounds, clip->bounds());
    if (extras.clipped_by_bounds) around.clips.push_back(clip);
  }
}

void convert(Conversion& conversion, const Object& object, const Around& around);

// Parts of unions stand alone; of other combinations each is cut by all others.
void convert_parts(Conversion& conversion, const CombinedShape& combined, const Around& around) {
  const auto& parts = combined.parts;
  if (combined.combination == Combination::union_) {
    // Small unions leave the growth to the list, or it would be moved for each.
    auto& instances = conversion.out.instances;
    const std::size_t wanted = instances.size() + parts.size();
    if (wanted > 2 * instances.capacity()) instances.reserve(wanted);
    for (const auto& part : parts) convert(conversion, *part, around);
    return;
  }
  const auto clip_of = [&](std::size_t i) {
    const bool inside = combined.combination == Combination::intersection ||
                        (combined.combination == Combination::difference && i == 0);
    return make_clip(conversion.parser, parts[i], around.transform, inside);
  };
  Clips clips;
  for (std::size_t i = 0; i < parts.size(); ++i) clips.push_back(clip_of(i));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Around part = around;
    if (combined.combination == Combination::difference && i > 0)
      part.inside_out = !part.inside_out;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (i != j) part.clips.push_back(clips[j]);
    }
    convert(conversion, *parts[i], part);
  }
}

// The faces of each texture as a mesh of their own.
std::map<int, MeshShape> by_texture(Parser& parser, const MeshShape& mesh) {
  parser.claim(mesh.faces.size() * 3 *
               (2 * sizeof(V3d) + sizeof(mesh.uvs[0]) + sizeof(mesh.faces[0])));
  std::map<int, MeshShape> pieces;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    MeshShape& piece = pieces[mesh.face_textures[i][0]];
    const auto first = static_cast<std::uint32_t>(piece.points.size());
    piece.faces.push_back({first, first + 1, first + 2});
    const auto& face = mesh.faces[i];
    const auto& normals = mesh.face_normals.empty() ? face : mesh.face_normals[i];
    const auto& uvs = mesh.face_uvs.empty() ? face : mesh.face_uvs[i];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      piece.points.push_back(mesh.points[face[corner]]);
      piece.bounds.extendBy(piece.points.back());
      if (!mesh.normals.empty()) piece.normals.push_back(mesh.normals[normals[corner]]);
      if (!mesh.uvs.empty()) piece.uvs.push_back(mesh.uvs[uvs[corner]]);
    }
  }
  return pieces;
}

void convert_shape(Conversion& conversion, const Object& object, const Around& around);

void convert_textured_mesh(Conversion& conversion, const Object& object, const MeshShape& mesh,
                           const Around& around) {
  const auto differs = [](const auto& corners) {
    return corners[1] != corners[0] || corners[2] != corners[0];
  };
  if (std::any_of(mesh.face_textures.begin(), mesh.face_textures.end(), differs))
    conversion.parser.mention(object.place,
                              "a triangle between textures shows that of its first corner");
  for (auto& [texture, piece] : by_texture(conversion.parser, mesh)) {
    Object part = object;
    part.shape = std::make_shared<const MeshShape>(std::move(piece));
    if (texture < 0) {
      convert_shape(conversion, part, around);
      continue;
    }
    Around own = around;
    own.texture = mesh.textures[static_cast<std::size_t>(texture)];
    own.texture_transform = around.transform;
    convert_shape(conversion, part, own);
  }
}

// Refuses curves of so many points that their surface would pass the bound on memory.
void check_size(Parser& parser, const Object& object) {
  std::uint64_t points = 0, around = around_steps;
  if (const auto* lathe = std::get_if<std::shared_ptr<const LatheShape>>(&object.shape)) {
    points = (*lathe)->points.size();
  } else if (const auto* sor = std::get_if<std::shared_ptr<const SorShape>>(&object.shape)) {
    points = (*sor)->points.size();
  } else if (const auto* prism = std::get_if<std::shared_ptr<const PrismShape>>(&object.shape)) {
    points = (*prism)->points.size();
    around = 4;
  }
  constexpr std::uint64_t bytes_of_point =
      4 * sizeof(V3f) + 2 * sizeof(std::array<std::uint32_t, 3>);
  const std::uint64_t bytes = points * curve_steps * around * bytes_of_point;
  if (bytes > parser.unclaimed()) parser.claim(bytes);
}

// The object's own texture, transform and the like are in what is around its shape.
void convert_shape(Conversion& conversion, const Object& object, const Around& around) {
  if (add_solid(conversion, object, around)) return;
  if (const auto* combined = std::get_if<std::shared_ptr<const CombinedShape>>(&object.shape))
    return convert_parts(conversion, **combined, around);
  if (const auto* field = std::get_if<std::shared_ptr<const HeightFieldShape>>(&object.shape);
      field && !(*field)->function) {
    Object part = object;
    auto mesh = height_field_mesh(conversion.parser, **field, object.place);
    if (!mesh) return;
    part.shape = std::move(mesh);
    return convert_shape(conversion, part, around);
  }
  if (const auto* mesh = std::get_if<std::shared_ptr<const MeshShape>>(&object.shape)) {
    if (!(*mesh)->face_textures.empty())
      return convert_textured_mesh(conversion, object, **mesh, around);
  }
  if (!around.clips.empty()) return add_cut_surface(conversion, object, around);
  if (const auto* sphere = std::get_if<SphereShape>(&object.shape))
    return add_sphere(conversion, object, around, *sphere);
  check_size(conversion.parser, object);
  if (auto mesh = tessellate(object.shape, conversion.reach)) {
    add_mesh(conversion, object, around, std::move(*mesh), around.to_world);
    return;
  }
  add_cut_surface(conversion, object, around);
}

Around with_own(const Conversion& conversion, const Object& object, const Around& around) {
  Around own = around;
  if (object.transform) {
    own.transform = *object.transform * around.transform;
    own.to_world = own.transform * conversion.to_world;
  }
  if (object.texture) {
    own.texture = object.texture;
    own.texture_transform =
        object.texture_transform ? *object.texture_transform * around.transform : around.transform;
  }
  if (object.interior) own.interior = object.interior;
  if (object.inverse) own.inside_out = !own.inside_out;
  own.seen_by_eye = around.seen_by_eye && !object.no_image;
  own.seen_in_reflections = around.seen_in_reflections && !object.no_reflection;
  own.casts_shadows = around.casts_shadows && !object.no_shadow;
  if (object.extras) add_bounds(conversion.parser, *object.extras, around.transform, own);
  return own;
}

void convert(Conversion& conversion, const Object& object, const Around& around) {
  if (const auto* light = std::get_if<std::shared_ptr<const LightSource>>(&object.shape)) {
    const M44d transform =
        object.transform ? *object.transform * around.transform : around.transform;
    return convert_light(conversion, **light, transform, object.place);
  }
  if (object.extras && object.extras->interior_texture)
    conversion.parser.mention(object.place,
                              "an interior_texture is left out: both sides look alike");
  if (const auto* blob = std::get_if<std::shared_ptr<const BlobShape>>(&object.shape)) {
    const auto has_texture = [](const BlobShape::Component& part) {
      return part.texture != nullptr;
    };
    if (std::any_of((*blob)->components.begin(), (*blob)->components.end(), has_texture))
      conversion.parser.mention(object.place, "the textures of a blob's components are left out");
  }
  const bool hidden = object.no_image || object.no_reflection || object.no_shadow;
  if (!object.transform && !object.texture && !object.interior && !object.extras &&
      !object.inverse && !hidden)
    return convert_shape(conversion, object, around);
  convert_shape(conversion, object, with_own(conversion, object, around));
}

}  // namespace

void convert_objects(Conversion& conversion) {
  Around nothing;
  nothing.to_world = conversion.to_world;
  for (const auto& object : conversion.scene.objects) convert(conversion, *object, nothing);
}

void convert_lamp_object(Conversion& conversion, const Object& object, const M44d& transform) {
  Around around;
  around.transform = transform;
  around.to_world = transform * conversion.to_world;
  around.lamp = true;
  around.casts_shadows = false;
  convert(conversion, object, around);
}

}  // namespace lumivec::pov
