#include "loader/pov/usual_color_maps.h"

namespace lumivec::pov {

const ColorMap& usual_color_map(K pattern) {
  static const ColorMap agate{{0.0, {1.0, 1.0, 1.0, 0.0, 0.0}}, {0.5, {0.95, 0.75, 0.5, 0.0, 0.0}},
                              {0.5, {0.9, 0.7, 0.5, 0.0, 0.0}}, {0.6, {0.9, 0.7, 0.4, 0.0, 0.0}},
                              {0.6, {1.0, 0.7, 0.4, 0.0, 0.0}}, {1.0, {0.6, 0.3, 0.0, 0.0, 0.0}}};
  static const ColorMap bozo{{0.4, {1.0, 1.0, 1.0, 0.0, 0.0}}, {0.4, {0.0, 1.0, 0.0, 0.0, 0.0}},
                             {0.6, {0.0, 1.0, 0.0, 0.0, 0.0}}, {0.6, {0.0, 0.0, 1.0, 0.0, 0.0}},
                             {0.8, {0.0, 0.0, 1.0, 0.0, 0.0}}, {0.8, {1.0, 0.0, 0.0, 0.0, 0.0}}};
  static const ColorMap marble{{0.0, {0.9, 0.8, 0.8, 0.0, 0.0}},
                               {0.9, {0.9, 0.08, 0.08, 0.0, 0.0}},
                               {0.9, {0.0, 0.0, 0.0, 0.0, 0.0}}};
  static const ColorMap radial{{0.0, {0.0, 1.0, 1.0, 0.0, 0.0}},
                               {0.333, {1.0, 1.0, 0.0, 0.0, 0.0}},
                               {0.666, {1.0, 0.0, 1.0, 0.0, 0.0}},
                               {1.0, {0.0, 1.0, 1.0, 0.0, 0.0}}};
  static const ColorMap wood{{0.6, {0.666, 0.312, 0.2, 0.0, 0.0}},
                             {0.6, {0.4, 0.1333, 0.066, 0.0, 0.0}}};
  static const ColorMap none;
  switch (pattern) {
    case K::agate_:
      return agate;
    case K::bozo_:
      return bozo;
    case K::marble_:
      return marble;
    case K::radial_:
      return radial;
    case K::wood_:
      return wood;
    default:
      return none;
  }
}

}  // namespace lumivec::pov
