// EXT_mesh_gpu_instancing: a mesh many times, each with its own translation, rotation and scale.
#include <algorithm>
#include <cmath>

#include "loader/gltf/extensions.h"
#include "loader/gltf/instances.h"
#include "loader/transforms.h"

namespace lumivec::gltf {
namespace {

using CT = ComponentType;

// components floats for each of count instances; empty if the attribute is not there.
std::vector<float> read_attribute(Context& context, Accessors& accessors,
                                  const tinygltf::Value& attributes, const std::string& name,
                                  int components, std::initializer_list<CT> types,
                                  std::uint64_t count, const std::string& where) {
  if (!attributes.Has(name)) return {};
  const int accessor = index_or(attributes, name, -1);
  accessors.require(accessor, where + "/" + name, {components}, types);
  context.claim(count, static_cast<std::uint64_t>(components) * sizeof(float), where);
  std::vector<float> values(count * static_cast<std::size_t>(components));
  accessors.read(accessor, 0, count, components, values.data(), Scale::as_declared);
  const bool finite =
      std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
  if (!finite) context.fail(where + "/" + name, "is not finite");
  return values;
}

}  // namespace

std::vector<M44d> instance_transforms(Context& context, Accessors& accessors,
                                      const tinygltf::Node& node, const std::string& node_where) {
  const auto* extension = find_extension(node.extensions, "EXT_mesh_gpu_instancing");
  if (!extension || !extension->Has("attributes")) return {M44d()};
  const tinygltf::Value& attributes = extension->Get("attributes");
  const std::string where = node_where + "/extensions/EXT_mesh_gpu_instancing/attributes";
  std::optional<std::uint64_t> count;
  for (const std::string& name : attributes.Keys()) {
    const int accessor = index_or(attributes, name, -1);
    accessors.check(accessor);
    if (count && accessors[accessor].count != *count) {
      context.fail(where, "have " + std::to_string(*count) + " and " +
                              std::to_string(accessors[accessor].count) + " elements");
    }
    count = accessors[accessor].count;
  }
  if (!count) return {M44d()};
  const auto translations = read_attribute(context, accessors, attributes, "TRANSLATION", 3,
                                           {CT::float32}, *count, where);
  const auto rotations = read_attribute(context, accessors, attributes, "ROTATION", 4,
                                        {CT::float32, CT::int8, CT::int16}, *count, where);
  const auto scales =
      read_attribute(context, accessors, attributes, "SCALE", 3, {CT::float32}, *count, where);
  context.claim(*count, sizeof(M44d), where);
  std::vector<M44d> transforms(*count);
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    const auto vector = [i](const std::vector<float>& values, double fallback) {
      if (values.empty()) return V3d(fallback);
      return V3d(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    };
    V4d rotation(0, 0, 0, 1);
    if (!rotations.empty())
      std::copy_n(rotations.begin() + static_cast<long>(4 * i), 4, &rotation.x);
    transforms[i] = compose(vector(translations, 0.0), rotation, vector(scales, 1.0));
    if (!is_finite(transforms[i])) {
      context.fail(where + "/ROTATION", "element " + std::to_string(i) + " is no quaternion");
    }
  }
  return transforms;
}

}  // namespace lumivec::gltf
