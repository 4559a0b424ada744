// How much a thing that is made of others holds.
//
// Loops can build chains that are as deep as they are long, and doublings that hold more than any
// walk could visit. Whoever puts one thing into another adds its measure, and Parser::contain
// refuses what is too deep or too large, so that nothing that walks or destroys it need watch its
// stack.
#pragma once

#include <cstdint>

namespace lumivec::pov {

struct Measure {
  std::uint32_t depth = 1;  // things within each other
  std::uint64_t count = 1;  // things in all, each as often as it is met
};

// Bounds on what is evaluated at many points.
constexpr std::uint64_t most_pigments = 10'000;

}  // namespace lumivec::pov
