#include "loader/pov/value.h"

namespace lumivec::pov {

const char* kind_name(ValueKind kind) {
  switch (kind) {
    case ValueKind::none:
      return "nothing";
    case ValueKind::number:
      return "a number";
    case ValueKind::string:
      return "a string";
    case ValueKind::array:
      return "an array";
    case ValueKind::macro:
      return "a macro";
    case ValueKind::function:
      return "a function";
    case ValueKind::spline:
      return "a spline";
    case ValueKind::file:
      return "an open file";
    case ValueKind::object:
      return "an object";
    case ValueKind::texture:
      return "a texture";
    case ValueKind::pigment:
      return "a pigment";
    case ValueKind::normal:
      return "a normal";
    case ValueKind::finish:
      return "a finish";
    case ValueKind::interior:
      return "an interior";
    case ValueKind::material:
      return "a material";
    case ValueKind::camera:
      return "a camera";
    case ValueKind::transform:
      return "a transform";
    case ValueKind::color_map:
      return "a color map";
    case ValueKind::pigment_map:
      return "a pigment map";
    case ValueKind::normal_map:
      return "a normal map";
    case ValueKind::slope_map:
      return "a slope map";
    case ValueKind::texture_map:
      return "a texture map";
    case ValueKind::media:
      return "media";
    case ValueKind::sky_sphere:
      return "a sky sphere";
    case ValueKind::fog:
      return "fog";
    case ValueKind::rainbow:
      return "a rainbow";
  }
  return "something";
}

}  // namespace lumivec::pov
