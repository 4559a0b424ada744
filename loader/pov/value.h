// What an identifier can stand for.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "loader/pov/keywords.h"
#include "loader/pov/measure.h"

namespace lumivec::pov {

// A float (size 1), a vector of 2 to 5 components, or a color: red, green, blue, filter, transmit.
struct Number {
  std::array<double, 5> n{};
  std::uint8_t size = 1;
  bool color = false;

  Number() = default;
  Number(double value) : n{value} {}  // floats are meant to become numbers
};

enum class ValueKind : std::uint8_t {
  none,
  number,
  string,     // std::string
  array,      // Array
  macro,      // Macro
  function,   // Function
  spline,     // Spline
  file,       // DataFile
  object,     // Object
  texture,    // Texture
  pigment,    // Pigment
  normal,     // Normal
  finish,     // Finish
  interior,   // Interior
  material,   // MaterialBlock
  camera,     // Camera
  transform,  // M44d
  color_map,  // ColorMap
  pigment_map,
  normal_map,
  slope_map,
  texture_map,
  media,
  sky_sphere,
  fog,
  rainbow
};

// "a texture", as errors call it.
const char* kind_name(ValueKind kind);

struct Value {
  ValueKind kind = ValueKind::none;
  Number number;
  std::shared_ptr<const void> thing;

  Value() = default;
  Value(const Number& value) : kind(ValueKind::number), number(value) {}
  Value(ValueKind of, std::shared_ptr<const void> held) : kind(of), thing(std::move(held)) {}

  template <class T>
  const T& as() const {
    return *static_cast<const T*>(thing.get());
  }
  template <class T>
  std::shared_ptr<const T> share() const {
    return std::static_pointer_cast<const T>(thing);
  }
};

inline Value string_value(std::string text) {
  return {ValueKind::string, std::make_shared<const std::string>(std::move(text))};
}

// Of one to five dimensions, elements row by row.
struct Array {
  std::vector<std::uint32_t> sizes;
  std::vector<Value> elements;
  Measure measure;  // of arrays within arrays
};

// The tokens [begin, end) of a source, with names for what a call gives.
struct Macro {
  Word name = 0;
  std::uint32_t source = 0;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::vector<Word> parameters;
};

// A file opened for reading.
struct DataFile {
  std::string name;
  std::string text;
  std::size_t position = 0;
};

}  // namespace lumivec::pov
