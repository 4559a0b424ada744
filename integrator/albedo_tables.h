// Directional albedos of the GGX lobes over (cosθ, roughness), for energy compensation.
#pragma once

#include <span>
#include <vector>

namespace lumivec {

class AlbedoTables {
 public:
  // indices: the refraction indices n of the scene's materials (each is needed as n and as 1/n).
  // Milliseconds each.
  explicit AlbedoTables(std::span<const float> indices);
};

}  // namespace lumivec
