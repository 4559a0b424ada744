// The vertex attributes of a primitive, as far as its triangles use them, checked and brought to
// one form.
#pragma once

#include <map>
#include <string>

#include "loader/gltf/accessors.h"
#include "loader/scene.h"

namespace lumivec::gltf {

using Attributes = std::map<std::string, int>;  // semantic to accessor

// The vertices that a mesh keeps of its accessors: a range, or a part of one where most of it is
// not used. Files often share one long vertex array among many primitives.
struct VertexSelection {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  std::vector<std::uint32_t> picked;  // ascending, from first; empty: all

  std::uint64_t size() const { return picked.empty() ? count : picked.size(); }
};

// Finds the vertices that the triangles use, and renumbers the triangles to them.
VertexSelection select_vertices(Context& context, const std::string& where, Mesh& mesh);

// components floats for every selected vertex.
void read_selected(Accessors& accessors, int accessor, const VertexSelection& selection,
                   int components, float* to, Scale scale = Scale::as_declared);
void read_selected(Accessors& accessors, int accessor, const VertexSelection& selection,
                   int components, std::uint32_t* to);

// The vertex arrays of mesh, whose triangles are there already. Fails where an accessor does not
// suit its semantic, or a position is not finite; repairs normals, tangents, texture coordinates
// and colours with a warning.
void read_vertices(Context& context, Accessors& accessors, const Attributes& attributes,
                   const VertexSelection& selection, const std::string& where, Mesh& mesh);

// Fails unless every position is finite.
void check_positions(const Context& context, const std::string& where, const Mesh& mesh);

}  // namespace lumivec::gltf
