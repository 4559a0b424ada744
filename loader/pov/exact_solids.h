// Shapes and combinations that a Scene holds exactly, as trees over primitives.
#pragma once

#include <functional>
#include <memory>

#include "loader/pov/solids.h"

namespace lumivec::pov {

// What a part of a combination looks like, with what it takes from those around it.
struct SolidAppearance {
  std::shared_ptr<const Texture> texture;
  M44d texture_transform;  // of the texture, to the scene's coordinates
  std::shared_ptr<const Interior> interior;
};

class SolidBuilder {
 public:
  // Which part of the solid shows an object of this appearance.
  using PartOf = std::function<int(const Object&, const SolidAppearance&)>;

  explicit SolidBuilder(PartOf part_of) : part_of_(std::move(part_of)) {}

  // Adds the shape's surface; the solid's space is the scene's. False: it has no exact form.
  bool add_surface(const Object& object, const M44d& to_scene, const SolidAppearance& appearance,
                   bool inside_out);
  // What the surface must lie inside of, or outside; false as above.
  bool add_clip(const Clip& clip);

  // bounds: around the surface, in the scene's coordinates; cut off at reach where infinite.
  Solid take(Imath::Box3d bounds, double reach);

 private:
  bool add_object(const Object& object, const M44d& around, const SolidAppearance& appearance,
                  int parent, bool complement);
  bool add_shape(const Object& object, const M44d& to_scene, const SolidAppearance& appearance,
                 int parent, bool complement);
  bool add_leaf(const Object& object, const M44d& to_scene, int part, int parent, bool complement);
  void add_text(const TextShape& text, const M44d& to_scene, int part, int parent, bool complement);
  int add_node(const SolidNode& node);

  PartOf part_of_;
  Solid solid_;
};

}  // namespace lumivec::pov
