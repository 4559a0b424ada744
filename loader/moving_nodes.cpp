#include "loader/moving_nodes.h"

#include <algorithm>
#include <cstdint>

namespace lumivec {

std::vector<int> animated_nodes(const std::vector<Animation>& animations) {
  std::vector<int> nodes;
  for (const Animation& animation : animations) {
    for (const AnimationChannel& channel : animation.channels) {
      if (channel.target != AnimationTarget::weights) nodes.push_back(channel.node);
    }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<int> nodes_below(const std::vector<int>& tops, const std::vector<Node>& nodes) {
  enum class State : std::uint8_t { unknown, still, moves };
  std::vector<State> states(nodes.size(), State::unknown);
  for (const int top : tops) states[static_cast<std::size_t>(top)] = State::moves;
  std::vector<int> order;
  if (tops.empty()) return order;
  std::vector<bool> listed(nodes.size());
  std::vector<int> chain;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    // Up to the root or to an ancestor that has been listed or found still, then down again.
    chain.clear();
    int node = static_cast<int>(i);
    for (; node >= 0; node = nodes[static_cast<std::size_t>(node)].parent) {
      const auto index = static_cast<std::size_t>(node);
      if (listed[index] || states[index] == State::still) break;
      chain.push_back(node);
    }
    bool moves = node >= 0 && listed[static_cast<std::size_t>(node)];
    for (; !chain.empty(); chain.pop_back()) {
      const auto index = static_cast<std::size_t>(chain.back());
      moves = moves || states[index] == State::moves;
      states[index] = moves ? State::moves : State::still;
      listed[index] = moves;
      if (moves) order.push_back(chain.back());
    }
  }
  return order;
}

}  // namespace lumivec
