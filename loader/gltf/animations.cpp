#include "loader/gltf/animations.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace lumivec::gltf {
namespace {

using CT = ComponentType;

struct Target {
  AnimationTarget target = AnimationTarget::translation;
  int components = 3;
};

std::optional<Target> target_of(const std::string& path) {
  if (path == "translation") return Target{AnimationTarget::translation, 3};
  if (path == "rotation") return Target{AnimationTarget::rotation, 4};
  if (path == "scale") return Target{AnimationTarget::scale, 3};
  if (path == "weights") return Target{AnimationTarget::weights, 1};
  return std::nullopt;
}

std::optional<Interpolation> interpolation_of(const std::string& name) {
  if (name == "STEP") return Interpolation::step;
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
  return std::nullopt;
}

std::size_t morph_weights(const tinygltf::Model& model, int node) {
  const int mesh = model.nodes[static_cast<std::size_t>(node)].mesh;
  if (mesh < 0 || model.meshes[static_cast<std::size_t>(mesh)].primitives.empty()) return 0;
  return model.meshes[static_cast<std::size_t>(mesh)].primitives[0].targets.size();
}

std::vector<float> read_floats(Context& context, Accessors& accessors, int accessor, int components,
                               const std::string& where) {
  accessors.require(accessor, where, {components},
                    {CT::float32, CT::int8, CT::uint8, CT::int16, CT::uint16});
  accessors.check(accessor);
  const std::uint64_t count = accessors[accessor].count;
  context.claim(count, static_cast<std::uint64_t>(components) * sizeof(float), where);
  std::vector<float> values(count * static_cast<std::size_t>(components));
  accessors.read(accessor, 0, count, components, values.data(), Scale::always_normalized);
  return values;
}

bool increases(const std::vector<float>& times) {
  return std::adjacent_find(times.begin(), times.end(),
                            [](float a, float b) { return !(a < b); }) == times.end();
}

bool is_finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
}

// What contradicts itself in a channel; empty if nothing does.
std::string contradiction(const AnimationChannel& channel, std::size_t numbers_per_key) {
  const bool spline = channel.interpolation == Interpolation::cubic_spline;
  const std::size_t per_key = numbers_per_key * (spline ? 3 : 1);
  if (channel.times.empty()) return "it has no key";
  if (per_key == 0) return "its node has no morph target";
  if (channel.values.size() % per_key != 0 ||
      channel.values.size() / per_key != channel.times.size()) {
    return std::to_string(channel.times.size()) + " keys of " + std::to_string(per_key) +
           " numbers do not fit " + std::to_string(channel.values.size()) + " numbers";
  }
  if (!is_finite(channel.times) || !increases(channel.times)) {
    return "its times are not finite or do not increase";
  }
  if (!is_finite(channel.values)) return "its values are not finite";
  if (channel.target != AnimationTarget::rotation) return {};
  for (std::size_t key = 0; key < channel.times.size(); ++key) {
    const std::size_t row = spline ? 3 * key + 1 : key;
    const auto q = channel.values.begin() + static_cast<std::ptrdiff_t>(4 * row);
    if (std::all_of(q, q + 4, [](float x) { return x == 0.0f; })) {
      return "the rotation of key " + std::to_string(key) + " is no quaternion";
    }
  }
  return {};
}

// None, with a warning, if the channel contradicts itself or moves what cannot be moved.
std::optional<AnimationChannel> read_channel(Context& context, const Document& document,
                                             Accessors& accessors,
                                             const tinygltf::Animation& animation,
                                             const tinygltf::AnimationChannel& source,
                                             const std::string& where) {
  const auto target = target_of(source.target_path);
  if (source.target_node < 0 || !target) return std::nullopt;
  if (static_cast<std::size_t>(source.sampler) >= animation.samplers.size()) {
    context.fail(where, "names sampler " + std::to_string(source.sampler) + " of " +
                            std::to_string(animation.samplers.size()));
  }
  const auto& sampler = animation.samplers[static_cast<std::size_t>(source.sampler)];
  const auto interpolation = interpolation_of(sampler.interpolation);
  if (!interpolation) {
    context.warn(where, "interpolation " + printable(sampler.interpolation) +
                            " is unknown, and the channel is left out");
    return std::nullopt;
  }
  const auto& node = document.model.nodes[static_cast<std::size_t>(source.target_node)];
  if (target->target != AnimationTarget::weights && !node.matrix.empty()) {
    context.warn(where, "node " + std::to_string(source.target_node) +
                            " is placed by a matrix, and the channel is left out");
    return std::nullopt;
  }
  AnimationChannel channel;
  channel.node = source.target_node;
  channel.target = target->target;
  channel.interpolation = *interpolation;
  channel.times = read_floats(context, accessors, sampler.input, 1, where);
  channel.values = read_floats(context, accessors, sampler.output, target->components, where);
  const bool weights = channel.target == AnimationTarget::weights;
  const std::string problem =
      contradiction(channel, weights ? morph_weights(document.model, channel.node)
                                     : static_cast<std::size_t>(target->components));
  if (!problem.empty()) {
    context.warn(where, problem + ", and the channel is left out");
    return std::nullopt;
  }
  return channel;
}

}  // namespace

std::vector<Animation> read_animations(Context& context, const Document& document,
                                       Accessors& accessors) {
  std::vector<Animation> animations;
  for (std::size_t i = 0; i < document.model.animations.size(); ++i) {
    const tinygltf::Animation& source = document.model.animations[i];
    Animation& animation = animations.emplace_back();
    animation.name = source.name;
    std::set<std::pair<int, AnimationTarget>> set;
    for (std::size_t c = 0; c < source.channels.size(); ++c) {
      const std::string where = pointer({"animations", i, "channels", c});
      auto channel = read_channel(context, document, accessors, source, source.channels[c], where);
      if (!channel) continue;
      if (!set.emplace(channel->node, channel->target).second) {
        context.warn(where, "sets what a channel before it sets, and is left out");
        continue;
      }
      animation.channels.push_back(std::move(*channel));
    }
  }
  return animations;
}

}  // namespace lumivec::gltf
