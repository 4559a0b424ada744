#include "loader/gltf/animations.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

// None, if the channel does not move a node or contradicts itself.
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
  AnimationChannel channel;
  channel.node = source.target_node;
  channel.target = target->target;
  channel.interpolation = *interpolation;
  channel.times = read_floats(context, accessors, sampler.input, 1, where);
  channel.values = read_floats(context, accessors, sampler.output, target->components, where);

  std::size_t per_key = static_cast<std::size_t>(target->components);
  if (channel.target == AnimationTarget::weights) {
    per_key = morph_weights(document.model, channel.node);
  }
  if (*interpolation == Interpolation::cubic_spline) per_key *= 3;
  if (channel.times.empty() || per_key == 0 ||
      channel.values.size() / per_key != channel.times.size() ||
      channel.values.size() % per_key != 0 || !is_finite(channel.times) ||
      !is_finite(channel.values) || !increases(channel.times)) {
    context.warn(where, "keys and values do not fit each other, and the channel is left out");
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
    for (std::size_t c = 0; c < source.channels.size(); ++c) {
      auto channel = read_channel(context, document, accessors, source, source.channels[c],
                                  pointer({"animations", i, "channels", c}));
      if (channel) animation.channels.push_back(std::move(*channel));
    }
  }
  return animations;
}

}  // namespace lumivec::gltf
