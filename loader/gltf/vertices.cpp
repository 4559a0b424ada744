#include "loader/gltf/vertices.h"

#include <algorithm>
#include <cmath>

#include "loader/gltf/normals.h"

namespace lumivec::gltf {
namespace {

using CT = ComponentType;

static_assert(sizeof(V2f) == 8 && sizeof(V3f) == 12 && sizeof(V4f) == 16);  // read in place

template <class T>
void read_picked(Accessors& accessors, int accessor, const VertexSelection& selection,
                 int components, T* to, const auto&... scale) {
  if (selection.picked.empty()) {
    accessors.read(accessor, selection.first, selection.count, components, to, scale...);
    return;
  }
  const auto width = static_cast<std::size_t>(components);
  std::vector<T> range(selection.count * width);
  std::copy_n(to, std::min(width, range.size()), range.begin());
  for (std::size_t i = width; i < range.size(); ++i) range[i] = range[i - width];
  accessors.read(accessor, selection.first, selection.count, components, range.data(), scale...);
  for (const std::uint32_t i : selection.picked) {
    to = std::copy_n(range.data() + i * width, width, to);
  }
}

// Accessor of a semantic, or -1; fails if its shape is wrong or it does not match the positions in
// number.
int find_attribute(Accessors& accessors, const Context& context, const Attributes& attributes,
                   const std::string& semantic, const std::string& where,
                   std::initializer_list<int> components, std::initializer_list<CT> types) {
  const auto it = attributes.find(semantic);
  if (it == attributes.end()) return -1;
  const std::string user = where + "/attributes/" + semantic;
  accessors.require(it->second, user, components, types);
  accessors.check(it->second);
  const std::uint64_t vertices = accessors[attributes.at("POSITION")].count;
  if (accessors[it->second].count != vertices) {
    context.fail(user, "has " + std::to_string(accessors[it->second].count) + " elements for " +
                           std::to_string(vertices) + " vertices");
  }
  return it->second;
}

template <class Vector>
bool is_finite(const Vector& v) {
  for (unsigned i = 0; i < Vector::dimensions(); ++i) {
    if (!std::isfinite(v[static_cast<int>(i)])) return false;
  }
  return true;
}

std::vector<V2f> read_uvs(Context& context, Accessors& accessors, int accessor,
                          const VertexSelection& selection, const std::string& where) {
  std::vector<V2f> uvs(selection.size());
  read_selected(accessors, accessor, selection, 2, &uvs[0].x);
  std::size_t repaired = 0;
  for (V2f& uv : uvs) {
    if (is_finite(uv)) continue;
    uv = V2f(0.0f);
    ++repaired;
  }
  if (repaired > 0) {
    context.warn(where, std::to_string(repaired) + " texture coordinates are not finite, set to 0");
  }
  return uvs;
}

std::vector<V4f> read_colors(Context& context, Accessors& accessors, int accessor,
                             const VertexSelection& selection, const std::string& where) {
  std::vector<V4f> colors(selection.size(), V4f(1.0f));
  read_selected(accessors, accessor, selection, 4, &colors[0].x, Scale::always_normalized);
  std::size_t repaired = 0;
  for (V4f& color : colors) {
    bool repair = false;
    for (int i = 0; i < 4; ++i) {
      if (color[i] >= 0.0f && color[i] <= 1.0f) continue;
      color[i] = std::isnan(color[i]) ? 1.0f : std::clamp(color[i], 0.0f, 1.0f);
      repair = true;
    }
    repaired += repair;
  }
  if (repaired > 0) {
    context.warn(where, std::to_string(repaired) + " vertex colors lie outside 0 to 1, clamped");
  }
  return colors;
}

}  // namespace

VertexSelection select_vertices(Context& context, const std::string& where, Mesh& mesh) {
  VertexSelection selection;
  if (mesh.triangles.empty()) return selection;
  std::uint32_t first = mesh.triangles[0].x;
  std::uint32_t last = first;
  for (const auto& t : mesh.triangles) {
    first = std::min({first, t.x, t.y, t.z});
    last = std::max({last, t.x, t.y, t.z});
  }
  selection.first = first;
  selection.count = std::uint64_t{last} - first + 1;
  // Only a range of more vertices than corners can be mostly unused, if the triangles share
  // vertices as usual.
  std::vector<std::uint32_t> renumbered;
  if (selection.count > mesh.triangles.size()) {
    context.claim(selection.count, 2 * sizeof(std::uint32_t), where);
    renumbered.assign(selection.count, 0);
    for (const auto& t : mesh.triangles) {
      for (int i = 0; i < 3; ++i) renumbered[t[i] - first] = 1;
    }
    const auto used =
        static_cast<std::uint64_t>(std::count(renumbered.begin(), renumbered.end(), 1u));
    if (2 * used > selection.count)
      renumbered.clear();  // what would be saved is less than what is kept
  }
  if (!renumbered.empty()) {
    for (std::uint32_t i = 0; i < selection.count; ++i) {
      if (renumbered[i] == 0) continue;
      renumbered[i] = static_cast<std::uint32_t>(selection.picked.size());
      selection.picked.push_back(i);
    }
  }
  if (first == 0 && renumbered.empty()) return selection;
  for (auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      t[i] -= first;
      if (!renumbered.empty()) t[i] = renumbered[t[i]];
    }
  }
  return selection;
}

void read_selected(Accessors& accessors, int accessor, const VertexSelection& selection,
                   int components, float* to, Scale scale) {
  read_picked(accessors, accessor, selection, components, to, scale);
}

void read_selected(Accessors& accessors, int accessor, const VertexSelection& selection,
                   int components, std::uint32_t* to) {
  read_picked(accessors, accessor, selection, components, to);
}

void read_vertices(Context& context, Accessors& accessors, const Attributes& attributes,
                   const VertexSelection& selection, const std::string& where, Mesh& mesh) {
  const auto find = [&](const std::string& semantic, std::initializer_list<int> components,
                        std::initializer_list<CT> types) {
    return find_attribute(accessors, context, attributes, semantic, where, components, types);
  };
  // Position and UV types are those of KHR_mesh_quantization, which the core types are a part of.
  const std::initializer_list<CT> quantized = {CT::float32, CT::int8, CT::uint8, CT::int16,
                                               CT::uint16};
  const std::initializer_list<CT> directions = {CT::float32, CT::int8, CT::int16};
  const std::uint64_t count = selection.size();

  const int positions = find("POSITION", {3}, quantized);
  context.claim(count, sizeof(V3f), where);
  mesh.positions.resize(count);
  read_selected(accessors, positions, selection, 3, &mesh.positions[0].x);
  check_positions(context, where, mesh);

  if (const int normals = find("NORMAL", {3}, directions); normals >= 0) {
    context.claim(count, sizeof(V3f), where);
    mesh.normals.resize(count);
    read_selected(accessors, normals, selection, 3, &mesh.normals[0].x);
    repair_normals(context, where, mesh);
  }
  if (const int tangents = find("TANGENT", {4}, directions);
      tangents >= 0 && !mesh.normals.empty()) {  // without normals, tangents are to be ignored
    context.claim(count, sizeof(V4f), where);
    mesh.tangents.resize(count);
    read_selected(accessors, tangents, selection, 4, &mesh.tangents[0].x);
    repair_tangents(context, where, mesh);
  }
  for (std::size_t set = 0;; ++set) {
    const int uvs = find("TEXCOORD_" + std::to_string(set), {2}, quantized);
    if (uvs < 0) break;
    context.claim(count, sizeof(V2f), where);
    mesh.uvs.push_back(read_uvs(context, accessors, uvs, selection, where));
  }
  if (const int colors = find("COLOR_0", {3, 4}, {CT::float32, CT::uint8, CT::uint16});
      colors >= 0) {
    context.claim(count, sizeof(V4f), where);
    mesh.colors = read_colors(context, accessors, colors, selection, where);
  }
}

void check_positions(const Context& context, const std::string& where, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!is_finite(mesh.positions[i])) {
      context.fail(where + "/attributes/POSITION",
                   "the position of vertex " + std::to_string(i) + " is not finite");
    }
  }
}

}  // namespace lumivec::gltf
