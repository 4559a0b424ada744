#include "viewer/window/object_place.h"

#include <ImathMatrixAlgo.h>

#include <numbers>

namespace lumivec {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

}  // namespace

ObjectPlace place_of(const M44d& transform) {
  ObjectPlace result;
  V3d radians;
  if (!Imath::extractSHRT(transform, result.size, result.skew, radians, result.place, false))
    return {};
  result.turn = radians * degrees;
  return result;
}

M44d transform_of(const ObjectPlace& place) {
  M44d m;
  m.translate(place.place);
  m.rotate(place.turn / degrees);
  m.shear(place.skew);
  m.scale(place.size);
  return m;
}

}  // namespace lumivec
