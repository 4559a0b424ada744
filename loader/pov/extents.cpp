#include "loader/pov/extents.h"

#include "loader/pov/bounds.h"
#include "loader/pov/expression.h"
#include "loader/pov/objects.h"

namespace lumivec::pov {

Number extent_function(Parser& parser, bool largest) {
  const Place place = parser.place();
  const ObjectPtr object = parse_object_reference(parser);
  const Imath::Box3d box = bounds_of(*object);
  if (box.isEmpty()) {
    parser.mention(
        place, "the extent of an object is not known while the scene is read, and is taken for 0");
    return to_number(V3d(0.0));
  }
  return to_number(largest ? box.max : box.min);
}

}  // namespace lumivec::pov
