// Chooses a light by its estimated contribution: a binary tree over the lights' bounds of position,
// direction and power. Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights
// with Adaptive Tree Splitting". Cost: one descent, about 20 ns a level.
#pragma once

#include <cstdint>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

// What is known of a light, or of a group of lights, before it is sampled.
struct LightBounds {
  V3f min, max;                // traced space
  V3f axis{0.0f, 0.0f, 1.0f};  // unit; middle of the directions in which light leaves
  float cos_spread = 1.0f;     // cosine of the largest angle between axis and a surface normal
  float cos_emission =
      0.0f;  // cosine of the largest angle between a normal and the light that leaves there
  float intensity = 0.0f;  // mean over the channels, cd, along the normal
  bool two_sided = false;
};

class LightTree {
 public:
  // lights: bounds with a positive intensity; an empty list makes an empty tree.
  explicit LightTree(const std::vector<LightBounds>& lights);
  LightTree() = default;

  bool empty() const { return nodes_.empty(); }

  // Estimate of the irradiance that all lights bring to p, lx. normal (0, 0, 0): any receiving
  // direction.
  float importance(const V3f& p, const V3f& normal) const;

  // Index of a light chosen with probability (> 0) by u in [0, 1); -1 if none can reach p. u is
  // rescaled to [0, 1) anew.
  int sample(const V3f& p, const V3f& normal, float& u, float& probability) const;

  // The probability with which sample() chooses the light.
  float probability(const V3f& p, const V3f& normal, int light) const;

 private:
  struct Node {
    LightBounds bounds;
    int second = -1;  // index of the second child; the first follows its parent. Leaf: -1
    int light = -1;   // leaf only
  };

  int build(const std::vector<LightBounds>& lights, std::vector<int>& order, int begin, int end,
            int depth, std::uint64_t trail);

  std::vector<Node> nodes_;
  std::vector<std::uint64_t>
      trails_;  // by light: which child to take at each level, lowest bit first
};

}  // namespace lumivec
