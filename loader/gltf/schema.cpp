#include "loader/gltf/schema.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace lumivec::gltf {
namespace {

using nlohmann::json;

constexpr double largest_exact_integer =
    9007199254740992.0;  // 2^53: JSON numbers are doubles to most writers

// The way from the root to a value, spelled out only for an error.
struct Place {
  const Place* parent = nullptr;
  std::string_view name = {};
  std::size_t element = 0;

  std::string pointer() const {
    if (!parent) return {};
    const std::string here = name.empty() ? std::to_string(element) : printable(name);
    return parent->pointer() + '/' + here;
  }
};

class Checker {
 public:
  Checker(const Context& context, const json& root) : context_(context), root_(root) {}

  void check(json& value, const Schema& schema, const Place& place) {
    if (!value.is_object()) fail(place, "an object", value);
    for (auto it = value.begin(); it != value.end();) {
      const Property* property = find(schema, it.key());
      if (!property || it->is_null()) {
        it = value.erase(it);
        continue;
      }
      const Place member{&place, property->name};
      if (check(*it, *property, member)) {
        ++it;
      } else {
        it = value.erase(it);
      }
    }
    for (const Property& property : schema.properties) {
      if (property.required && !value.contains(property.name)) {
        context_.fail(place.pointer(), "has no " + std::string(property.name));
      }
    }
  }

 private:
  static const Property* find(const Schema& schema, std::string_view name) {
    const auto it = std::find_if(schema.properties.begin(), schema.properties.end(),
                                 [&](const Property& p) { return p.name == name; });
    return it == schema.properties.end() ? nullptr : &*it;
  }

  [[noreturn]] void fail(const Place& place, const std::string& expected, const json& value) const {
    const std::string got =
        value.is_structured()
            ? std::string("an ") + value.type_name()
            : printable(value.dump(-1, ' ', false, json::error_handler_t::replace));
    context_.fail(place.pointer(), "must be " + expected + ", and is " + got);
  }

  // Returns whether the value stays.
  bool check(json& value, const Property& property, const Place& place) {
    switch (property.kind) {
      case Kind::boolean:
        if (!value.is_boolean()) fail(place, "true or false", value);
        return true;
      case Kind::string:
        if (!value.is_string()) fail(place, "a string", value);
        return true;
      case Kind::strings:
        each(value, place, [&](json& element, const Place& at) {
          if (!element.is_string()) fail(at, "a string", element);
        });
        return true;
      case Kind::number:
        number(value, place);
        return true;
      case Kind::numbers:
        each(value, place, [&](json& element, const Place& at) { number(element, at); });
        if (property.length > 0 && value.size() != property.length) {
          context_.fail(place.pointer(), "must be " + std::to_string(property.length) +
                                             " numbers, and is " + std::to_string(value.size()));
        }
        return true;
      case Kind::small:
        integer(value, std::numeric_limits<std::int32_t>::max(), place);
        return true;
      case Kind::size:
        integer(value, largest_exact_integer, place);
        return true;
      case Kind::index:
        index(value, property, place);
        return true;
      case Kind::indices:
        each(value, place, [&](json& element, const Place& at) { index(element, property, at); });
        return true;
      case Kind::index_map:
        index_map(value, property, place);
        return true;
      case Kind::index_maps:
        each(value, place,
             [&](json& element, const Place& at) { index_map(element, property, at); });
        return true;
      case Kind::object:
        check(value, *property.schema, place);
        return true;
      case Kind::objects:
        each(value, place,
             [&](json& element, const Place& at) { check(element, *property.schema, at); });
        return true;
      case Kind::sphere_extras:
        return keep_sphere(value);
    }
    return false;
  }

  template <class Function>
  void each(json& array, const Place& place, const Function& function) const {
    if (!array.is_array()) fail(place, "an array", array);
    for (std::size_t i = 0; i < array.size(); ++i) function(array[i], Place{&place, {}, i});
  }

  void number(json& value, const Place& place) const {
    if (!value.is_number()) fail(place, "a number", value);
    const double x = value.get<double>();
    if (!std::isfinite(x)) fail(place, "finite", value);
    value = x;
  }

  void integer(json& value, double largest, const Place& place) const {
    const double x = value.is_number() ? value.get<double>() : -1.0;
    if (!(x >= 0.0 && x <= largest && x == std::floor(x))) {
      fail(place, "a whole number of at least 0", value);
    }
    value = static_cast<std::uint64_t>(x);
  }

  void index(json& value, const Property& property, const Place& place) {
    integer(value, std::numeric_limits<std::int32_t>::max(), place);
    const std::size_t count = size_of(property.target);
    if (value.get<std::uint64_t>() >= count) {
      context_.fail(place.pointer(), "names element " + std::to_string(value.get<std::uint64_t>()) +
                                         " of /" + std::string(property.target) + ", which has " +
                                         std::to_string(count));
    }
  }

  void index_map(json& value, const Property& property, const Place& place) {
    if (!value.is_object()) fail(place, "an object", value);
    for (auto it = value.begin(); it != value.end(); ++it) {
      index(*it, property, Place{&place, it.key()});
    }
  }

  // Elements of a top-level array, before anything is known of its type.
  std::size_t size_of(std::string_view target) {
    const auto known = sizes_.find(target);
    if (known != sizes_.end()) return known->second;
    std::string text(1, '/');
    text += target;
    const json::json_pointer path(text);
    const bool exists = root_.contains(path) && root_.at(path).is_array();
    return sizes_[target] = exists ? root_.at(path).size() : 0;
  }

  static bool keep_sphere(json& extras) {
    if (!extras.is_object() || !extras.contains("sphere")) return false;
    const json& sphere = extras["sphere"];
    json radius = sphere.is_object() && sphere.contains("radius") ? sphere["radius"] : json();
    if (!radius.is_number())
      radius = -1.0;  // refused where it is used, by the name of the primitive
    const double r = radius.get<double>();
    extras = {{"sphere", {{"radius", r}}}};
    return true;
  }

  const Context& context_;
  const json& root_;
  std::map<std::string_view, std::size_t> sizes_;
};

}  // namespace

void apply_schema(const Context& context, json& root) {
  Checker(context, root).check(root, root_schema, Place{});
}

}  // namespace lumivec::gltf
