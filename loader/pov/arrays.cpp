#include "loader/pov/arrays.h"

#include <algorithm>

#include "loader/pov/expression.h"
#include "loader/pov/values.h"

namespace lumivec::pov {
namespace {

constexpr std::size_t max_dimensions = 5;

// Arrays are values: each name has its own, so that elements that macros hold stay those of the
// array.
Value copied(Parser& parser, const Value& array) {
  const Array& from = array.as<Array>();
  parser.claim(from.elements.size() * sizeof(Value));
  return {ValueKind::array, std::make_shared<Array>(from)};
}

Array& changeable(const Value& array) {
  return const_cast<Array&>(array.as<Array>());  // made as Array
}

void contain(Parser& parser, Array& array, const Value& element) {
  if (element.kind == ValueKind::array) parser.contain(array.measure, element.as<Array>().measure);
}

void parse_elements(Parser& parser, Array& array, std::size_t dimension, std::size_t first,
                    std::size_t count) {
  parser.expect('{', "an array");
  const std::size_t size = array.sizes[dimension];
  const std::size_t part = count / size;
  for (std::size_t i = 0; i < size; ++i) {
    if (parser.at('}')) {
      parser.fail("the array has " + std::to_string(size) + " elements here, but only " +
                  std::to_string(i) + " are given");
    }
    if (dimension + 1 < array.sizes.size()) {
      parse_elements(parser, array, dimension + 1, first + i * part, part);
    } else {
      array.elements[first + i] = parse_value(parser);
      contain(parser, array, array.elements[first + i]);
    }
    skip_comma(parser);
  }
  if (!parser.at('}')) parser.fail("the array has only " + std::to_string(size) + " elements here");
  parser.take();
}

}  // namespace

Value parse_array(Parser& parser) {
  auto array = std::make_shared<Array>();
  std::uint64_t count = 1;
  while (parser.next_is('[')) {
    parser.expect('[', "an array");
    const double size = parse_float(parser, "the size of an array");
    parser.expect(']', "an array");
    constexpr double largest = 4e9;
    if (!(size >= 1.0 && size < largest)) parser.fail("the size of an array is out of range");
    if (array->sizes.size() == max_dimensions) parser.fail("an array has more than 5 dimensions");
    array->sizes.push_back(static_cast<std::uint32_t>(size));
    if (__builtin_mul_overflow(count, array->sizes.back(), &count))
      parser.fail("the array is too large");
    if (count > parser.options.max_bytes / sizeof(Value))
      parser.claim(parser.options.max_bytes + 1);
  }
  if (array->sizes.empty()) parser.fail("'[' with the size is expected after array");
  parser.claim(count * sizeof(Value));
  array->elements.resize(count);
  if (parser.next_is('{')) parse_elements(parser, *array, 0, 0, count);
  return {ValueKind::array, array};
}

std::size_t parse_array_index(Parser& parser, const Slot& array) {
  const auto held = array->share<Array>();
  std::size_t index = 0;
  for (const std::uint32_t size : held->sizes) {
    parser.expect('[', "an array's element");
    const double position = parse_float(parser, "the index of an array");
    parser.expect(']', "an array's element");
    constexpr double rounding = 1e-6;  // indices may come from sums of fractions
    const double whole = position + rounding;
    if (!(whole >= 0.0 && whole < size)) {
      parser.fail("the index " +
                  std::to_string(static_cast<long long>(std::clamp(position, -1e15, 1e15))) +
                  " is outside the array of " + std::to_string(size) + " elements");
    }
    index = index * size + static_cast<std::size_t>(whole);
  }
  if (array->kind != ValueKind::array || array->thing != held)
    parser.fail("the array changes while its index is read", "change it before");
  return index;
}

Value parse_array_element(Parser& parser, const Slot& array) {
  if (!parser.next_is('[')) return copied(parser, *array);
  const std::size_t index = parse_array_index(parser, array);
  Value value = array->as<Array>().elements[index];
  if (value.kind == ValueKind::none) parser.fail("the array's element was never set");
  if (value.kind == ValueKind::array)
    return parse_array_element(parser, std::make_shared<Value>(value));
  return value;
}

Slot array_element_slot(Parser& parser, const Slot& array) {
  const std::size_t index = parse_array_index(parser, array);
  Value& element = changeable(*array).elements[index];
  if (element.kind == ValueKind::none) parser.fail("the array's element was never set");
  // Copies of an array share the arrays within until one is changed.
  if (element.kind == ValueKind::array && element.thing.use_count() > 1)
    element = copied(parser, element);
  return {array->share<Array>(), &element};
}

void set_array_element(Parser& parser, Value& array, std::size_t index, Value value) {
  if (array.kind != ValueKind::array || index >= array.as<Array>().elements.size())
    parser.fail("the array changes while its element is read", "change it before");
  Array& elements = changeable(array);
  for (const Value& other : elements.elements) {
    if (other.kind == ValueKind::none) continue;
    if (other.kind != value.kind) {
      parser.fail(std::string("the array holds ") + kind_name(other.kind) + ", and cannot hold " +
                  kind_name(value.kind) + " too");
    }
    break;
  }
  contain(parser, elements, value);
  elements.elements[index] = std::move(value);
}

bool array_holds(const Value& array, ValueKind kind) {
  for (const Value& value : array.as<Array>().elements) {
    if (value.kind == ValueKind::none) continue;
    return value.kind == ValueKind::array ? array_holds(value, kind) : value.kind == kind;
  }
  return false;
}

std::shared_ptr<const Array> parse_array_name(Parser& parser) {
  const Slot* slot = parser.meaning(parser.peek());
  if (!slot || (*slot)->kind != ValueKind::array) parser.fail_expected("an array");
  const Slot held = *slot;
  parser.take();
  return held->share<Array>();
}

}  // namespace lumivec::pov
