#include "loader/gltf/pose.h"

#include <algorithm>
#include <cmath>

#include "loader/gltf/normals.h"
#include "loader/transforms.h"

namespace lumivec::gltf {
namespace {

using CT = ComponentType;

// Deltas of one semantic of one target; empty if the target has none.
std::vector<V3f> read_deltas(Context& context, Accessors& accessors, const Attributes& target,
                             const std::string& semantic, std::uint64_t vertices,
                             const VertexSelection& selection, const std::string& where) {
  const auto it = target.find(semantic);
  if (it == target.end() || !accessors.has_data(it->second)) return {};
  const std::string user = where + "/" + semantic;
  accessors.require(it->second, user, {3},
                    {CT::float32, CT::int8, CT::uint8, CT::int16, CT::uint16});
  accessors.check(it->second);
  if (accessors[it->second].count != vertices) {
    context.fail(user, "has " + std::to_string(accessors[it->second].count) + " elements for " +
                           std::to_string(vertices) + " vertices");
  }
  context.claim(selection.size(), sizeof(V3f), where);
  std::vector<V3f> deltas(selection.size());
  read_selected(accessors, it->second, selection, 3, &deltas[0].x);
  return deltas;
}

template <class Vector>
void add(const std::vector<V3f>& deltas, float weight, std::vector<Vector>& to) {
  if (to.empty()) return;
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    for (int c = 0; c < 3; ++c) to[i][c] += weight * deltas[i][c];
  }
}

struct Influence {
  std::vector<std::uint32_t> joints;  // 4 per vertex
  std::vector<float> weights;         // likewise
};

// The sets JOINTS_0 and WEIGHTS_0, JOINTS_1 and so on.
std::vector<Influence> read_influences(Context& context, Accessors& accessors,
                                       const Attributes& attributes,
                                       const VertexSelection& selection, const std::string& where) {
  std::vector<Influence> influences;
  const std::uint64_t vertices = accessors[attributes.at("POSITION")].count;
  for (std::size_t set = 0;; ++set) {
    const auto joints = attributes.find("JOINTS_" + std::to_string(set));
    const auto weights = attributes.find("WEIGHTS_" + std::to_string(set));
    if (joints == attributes.end() || weights == attributes.end()) break;
    accessors.require(joints->second, where + "/attributes/" + joints->first, {4},
                      {CT::uint8, CT::uint16});
    accessors.require(weights->second, where + "/attributes/" + weights->first, {4},
                      {CT::float32, CT::uint8, CT::uint16});
    for (const int accessor : {joints->second, weights->second}) {
      accessors.check(accessor);
      if (accessors[accessor].count == vertices) continue;
      context.fail(where, "has joints or weights for " + std::to_string(accessors[accessor].count) +
                              " of " + std::to_string(vertices) + " vertices");
    }
    context.claim(selection.size(), 4 * (sizeof(std::uint32_t) + sizeof(float)), where);
    Influence& influence = influences.emplace_back();
    influence.joints.resize(4 * selection.size());
    influence.weights.resize(4 * selection.size());
    read_selected(accessors, joints->second, selection, 4, influence.joints.data());
    read_selected(accessors, weights->second, selection, 4, influence.weights.data(),
                  Scale::always_normalized);
  }
  return influences;
}

// The blend of a vertex's joints; false if it has no weight.
bool blend(const Context& context, const std::vector<Influence>& influences,
           const std::vector<M44d>& joints, std::size_t vertex, const std::string& where,
           M44d& sum) {
  sum = M44d(0.0);
  double total = 0.0;
  for (const Influence& influence : influences) {
    for (std::size_t i = 4 * vertex; i < 4 * vertex + 4; ++i) {
      const double weight = influence.weights[i];
      if (weight == 0.0) continue;
      if (!std::isfinite(weight) || weight < 0.0) {
        context.fail(where, "the weights of vertex " + std::to_string(vertex) +
                                " are negative or not finite");
      }
      const std::uint32_t joint = influence.joints[i];
      if (joint >= joints.size()) {
        context.fail(where, "vertex " + std::to_string(vertex) + " hangs on joint " +
                                std::to_string(joint) + " of " + std::to_string(joints.size()));
      }
      sum += joints[joint] * weight;
      total += weight;
    }
  }
  if (total == 0.0) return false;
  sum *= 1.0 / total;
  return true;
}

V3d direction_times(const V3d& v, const M44d& m) {
  V3d result;
  m.multDirMatrix(v, result);
  return result;
}

// The transform of normals up to a positive factor: exists for singular matrices too.
V3d normal_times(const V3d& n, const M44d& m, double determinant) {
  const V3d x(m[0][0], m[0][1], m[0][2]);
  const V3d y(m[1][0], m[1][1], m[1][2]);
  const V3d z(m[2][0], m[2][1], m[2][2]);
  const V3d result = y.cross(z) * n.x + z.cross(x) * n.y + x.cross(y) * n.z;
  return determinant < 0.0 ? -result : result;
}

}  // namespace

void apply_morph_targets(Context& context, Accessors& accessors,
                         const std::vector<Attributes>& targets, const std::vector<float>& weights,
                         std::uint64_t vertices, const VertexSelection& selection,
                         const std::string& where, Mesh& mesh) {
  bool turned = false;
  for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
    if (weights[i] == 0.0f) continue;
    const std::string place = where + "/targets/" + std::to_string(i);
    const auto deltas = [&](const char* semantic) {
      return read_deltas(context, accessors, targets[i], semantic, vertices, selection, place);
    };
    add(deltas("POSITION"), weights[i], mesh.positions);
    add(deltas("NORMAL"), weights[i], mesh.normals);
    add(deltas("TANGENT"), weights[i], mesh.tangents);
    turned = true;
  }
  if (!turned) return;
  check_positions(context, where, mesh);
  repair_normals(context, where, mesh);
  if (mesh.normals.empty()) mesh.tangents = {};
  repair_tangents(context, where, mesh);
}

void apply_skin(Context& context, Accessors& accessors, const Attributes& attributes,
                const std::vector<M44d>& joint_matrices, const VertexSelection& selection,
                const std::string& where, Mesh& mesh) {
  const auto influences = read_influences(context, accessors, attributes, selection, where);
  if (influences.empty()) {
    context.warn(where, "has a skin but no joints and weights, and stays as it is");
    return;
  }
  std::size_t mirrored = 0;
  std::size_t loose = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    M44d m;
    if (!blend(context, influences, joint_matrices, i, where, m)) {
      ++loose;
      continue;
    }
    V3d position;
    m.multVecMatrix(V3d(mesh.positions[i]), position);
    mesh.positions[i] = V3f(position);
    const double determinant = determinant3(m);
    mirrored += determinant < 0.0;
    if (mesh.normals.empty()) continue;
    mesh.normals[i] = V3f(normal_times(V3d(mesh.normals[i]), m, determinant));
    if (mesh.tangents.empty()) continue;
    V4f& tangent = mesh.tangents[i];
    const V3f t(direction_times(V3d(tangent.x, tangent.y, tangent.z), m));
    tangent = V4f(t.x, t.y, t.z, determinant < 0.0 ? -tangent.w : tangent.w);
  }
  if (loose > 0) {
    context.warn(where, std::to_string(loose) + " vertices hang on no joint and stay as they are");
  }
  // A mesh that its joints mirror shows its other side unless its triangles turn too.
  if (2 * mirrored > mesh.positions.size()) {
    for (auto& t : mesh.triangles) std::swap(t.y, t.z);
  }
  check_positions(context, where, mesh);
  repair_normals(context, where, mesh);
  if (mesh.normals.empty()) mesh.tangents = {};
  repair_tangents(context, where, mesh);
}

std::vector<M44d> joint_matrices(Context& context, Accessors& accessors, const tinygltf::Skin& skin,
                                 const std::string& where, const std::vector<M44d>& worlds) {
  const std::size_t count = skin.joints.size();
  context.claim(count, sizeof(M44d) + 16 * sizeof(float), where);
  std::vector<M44d> matrices(count);
  if (skin.inverseBindMatrices >= 0) {
    const std::string user = where + "/inverseBindMatrices";
    accessors.require(skin.inverseBindMatrices, user, {16}, {CT::float32});
    accessors.check(skin.inverseBindMatrices);
    if (accessors[skin.inverseBindMatrices].count < count) {
      context.fail(user, "has fewer matrices than the skin has joints");
    }
    std::vector<float> numbers(16 * count);
    accessors.read(skin.inverseBindMatrices, 0, count, 16, numbers.data());
    for (std::size_t i = 0; i < count; ++i) {
      // Column-major matrices of column vectors lie in memory as row-major ones of row vectors do.
      for (std::size_t k = 0; k < 16; ++k) {
        const float x = numbers[16 * i + k];
        if (!std::isfinite(x)) context.fail(user, "matrix " + std::to_string(i) + " is not finite");
        matrices[i][static_cast<int>(k / 4)][k % 4] = x;
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    matrices[i] *= worlds[static_cast<std::size_t>(skin.joints[i])];
    if (!is_finite(matrices[i])) {
      context.fail(where, "joint " + std::to_string(i) + " has no finite transform");
    }
  }
  return matrices;
}

}  // namespace lumivec::gltf
