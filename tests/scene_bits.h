// Two scenes compared bit by bit, in all that posing may touch.
#pragma once

#include <cstring>
#include <string>

#include "loader/scene.h"

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool same_bits(const lumivec::M44d& a, const lumivec::M44d& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// The first thing that differs; empty if nothing does.
inline std::string difference(const lumivec::Scene& a, const lumivec::Scene& b) {
  const auto at = [](const char* what, std::size_t i) {
    return std::string(what) + " " + std::to_string(i);
  };
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    const lumivec::Mesh& m = a.meshes[i];
    const lumivec::Mesh& n = b.meshes.at(i);
    if (!same_bits(m.positions, n.positions)) return at("positions of mesh", i);
    if (!same_bits(m.normals, n.normals)) return at("normals of mesh", i);
    if (!same_bits(m.tangents, n.tangents)) return at("tangents of mesh", i);
    if (!same_bits(m.triangles, n.triangles)) return at("triangles of mesh", i);
  }
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    if (!same_bits(a.instances[i].object_to_world, b.instances.at(i).object_to_world)) {
      return at("transform of instance", i);
    }
    if (a.instances[i].visible != b.instances[i].visible) return at("visibility of instance", i);
  }
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    if (!same_bits(a.lights[i].object_to_world, b.lights.at(i).object_to_world)) {
      return at("light", i);
    }
  }
  for (std::size_t i = 0; i < a.cameras.size(); ++i) {
    if (!same_bits(a.cameras[i].camera_to_world, b.cameras.at(i).camera_to_world)) {
      return at("camera", i);
    }
  }
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    if (!same_bits(a.nodes[i].local_to_parent, b.nodes.at(i).local_to_parent) ||
        !same_bits(a.nodes[i].local_to_world, b.nodes[i].local_to_world)) {
      return at("node", i);
    }
  }
  return {};
}
