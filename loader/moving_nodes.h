// Which nodes of a scene animations move.
#pragma once

#include <vector>

#include "loader/scene.h"

namespace lumivec {

// The nodes whose transform an animation sets, ascending.
std::vector<int> animated_nodes(const std::vector<Animation>& animations);

// These and all nodes below them, parents before children. Costs a pass over the nodes.
std::vector<int> nodes_below(const std::vector<int>& tops, const std::vector<Node>& nodes);

}  // namespace lumivec
