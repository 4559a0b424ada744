#include "loader/gltf/triangles.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace lumivec::gltf {
namespace {

static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));  // indices are read in place

std::uint32_t restart_value(ComponentType type) {
  if (type == ComponentType::uint8) return std::numeric_limits<std::uint8_t>::max();
  if (type == ComponentType::uint16) return std::numeric_limits<std::uint16_t>::max();
  return std::numeric_limits<std::uint32_t>::max();
}

void read_indices(const Context& context, Accessors& accessors, int indices, std::uint64_t count,
                  std::uint64_t vertices, const std::string& where, std::uint32_t* to) {
  if (indices < 0) {
    std::iota(to, to + count, 0u);
    return;
  }
  accessors.read(indices, 0, count, 1, to);
  if (count == 0) return;
  const std::uint32_t largest = *std::max_element(to, to + count);
  if (largest == restart_value(accessors[indices].component_type)) {
    context.fail(where + "/indices", "hold the primitive restart value " + std::to_string(largest),
                 "split the primitive where it restarts");
  }
  if (largest >= vertices) {
    context.fail(where + "/indices", "hold index " + std::to_string(largest) + ", but there are " +
                                         std::to_string(vertices) + " vertices");
  }
}

// Triangle i of a strip is (i, i + 1, i + 2) with the last two exchanged where i is odd, of a fan
// (i + 1, i + 2, 0): so the winding stays.
void expand(const std::vector<std::uint32_t>& corners, bool fan, std::vector<Triangle>& triangles) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (fan) {
      triangles[i] = {corners[i + 1], corners[i + 2], corners[0]};
    } else {
      const std::size_t odd = i % 2;
      triangles[i] = {corners[i], corners[i + 1 + odd], corners[i + 2 - odd]};
    }
  }
}

bool repeats_a_vertex(const Triangle& t) {
  return t.x == t.y || t.y == t.z || t.z == t.x;
}

}  // namespace

bool has_area(const Context& context, int mode, std::string_view where) {
  if (mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    context.fail(where, "mode " + std::to_string(mode) + " is none of 0 to 6");
  }
  return mode >= TINYGLTF_MODE_TRIANGLES;
}

std::vector<Triangle> read_triangles(Context& context, Accessors& accessors, int mode, int indices,
                                     std::uint64_t vertices, const std::string& where) {
  std::uint64_t corners = vertices;
  if (indices >= 0) {
    accessors.require(indices, where + "/indices", {1},
                      {ComponentType::uint8, ComponentType::uint16, ComponentType::uint32});
    accessors.check(indices);
    corners = accessors[indices].count;
  }
  const bool list = mode == TINYGLTF_MODE_TRIANGLES;
  std::uint64_t count = corners / 3;
  if (!list) count = corners < 3 ? 0 : corners - 2;
  if (corners < 3 || (list && corners % 3 != 0)) {
    context.warn(where, std::to_string(corners) + " corners do not make whole triangles");
  }
  context.claim(count, sizeof(Triangle), where);
  if (!list) context.claim(corners, sizeof(std::uint32_t), where);

  std::vector<Triangle> triangles(count);
  if (list && count > 0) {
    read_indices(context, accessors, indices, 3 * count, vertices, where, &triangles[0].x);
  } else if (count > 0) {
    std::vector<std::uint32_t> order(corners);
    read_indices(context, accessors, indices, corners, vertices, where, order.data());
    expand(order, mode == TINYGLTF_MODE_TRIANGLE_FAN, triangles);
  }
  std::erase_if(triangles, repeats_a_vertex);
  return triangles;
}

}  // namespace lumivec::gltf
