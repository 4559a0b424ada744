// The triangles of a primitive: indices or their absence, lists, strips and fans (glTF 2.0,
// section 3.7.2.1).
#pragma once

#include <cstdint>
#include <vector>

#include "loader/gltf/accessors.h"
#include "loader/scene.h"

namespace lumivec::gltf {

using Triangle = Imath::Vec3<std::uint32_t>;

// Does the mode have area? Fails for a number that is no mode. Points and lines have none.
bool has_area(const Context& context, int mode, std::string_view where);

// Every index is checked to be less than vertices. Triangles that name a vertex twice are left out.
// indices: an accessor, or -1 for the vertices in their order.
std::vector<Triangle> read_triangles(Context& context, Accessors& accessors, int mode, int indices,
                                     std::uint64_t vertices, const std::string& where);

}  // namespace lumivec::gltf
