#include "loader/gltf/deformations.h"

#include <algorithm>
#include <cmath>

#include "loader/deform.h"
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

bool is_finite(const std::vector<V3f>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const V3f& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  });
}

// The weights and joints of one set; the joint of a zero weight means nothing and becomes 0.
JointSet joint_set(const Context& context, const std::vector<std::uint32_t>& joints,
                   std::vector<V4f> weights, std::size_t joint_count, const std::string& where) {
  JointSet set;
  set.joints.resize(weights.size(), Imath::Vec4<std::uint16_t>(0));
  for (std::size_t vertex = 0; vertex < weights.size(); ++vertex) {
    for (int i = 0; i < 4; ++i) {
      const float weight = weights[vertex][i];
      if (weight == 0.0f) continue;
      if (!std::isfinite(weight) || weight < 0.0f) {
        context.fail(where, "the weights of vertex " + std::to_string(vertex) +
                                " are negative or not finite");
      }
      const std::uint32_t joint = joints[4 * vertex + static_cast<std::size_t>(i)];
      if (joint >= joint_count) {
        context.fail(where, "vertex " + std::to_string(vertex) + " hangs on joint " +
                                std::to_string(joint) + " of " + std::to_string(joint_count));
      }
      set.joints[vertex][i] = static_cast<std::uint16_t>(joint);
    }
  }
  set.weights = std::move(weights);
  return set;
}

// Says what deforming the mesh came upon.
void report(Context& context, const std::string& where, const DeformationFaults& faults) {
  if (faults.not_finite) {
    context.fail(where + "/attributes/POSITION",
                 "the position of vertex " + std::to_string(*faults.not_finite) + " is not finite");
  }
  if (faults.loose > 0) {
    context.warn(where,
                 std::to_string(faults.loose) + " vertices hang on no joint and stay as they are");
  }
  warn_of_normals(context, where, faults.normals);
  warn_of_tangents(context, where, faults.tangents);
}

// Appends copies of elements to an array that is not empty.
template <class Array>
void repeat(const std::vector<std::uint32_t>& elements, Array& array) {
  if (array.empty()) return;
  array.reserve(array.size() + elements.size());
  for (const std::uint32_t i : elements) array.push_back(array[i]);
}

void repeat(const std::vector<std::uint32_t>& vertices, Deformation& deformation) {
  for (MorphTarget& target : deformation.targets) {
    repeat(vertices, target.positions);
    repeat(vertices, target.normals);
    repeat(vertices, target.tangents);
  }
  for (JointSet& set : deformation.joint_sets) {
    repeat(vertices, set.joints);
    repeat(vertices, set.weights);
  }
}

}  // namespace

std::vector<MorphTarget> read_morph_targets(Context& context, Accessors& accessors,
                                            const std::vector<Attributes>& targets,
                                            const Pose& pose, std::uint64_t vertices,
                                            const VertexSelection& selection,
                                            const std::string& where) {
  std::vector<MorphTarget> read(pose.weights.size());
  for (std::size_t i = 0; i < std::min(targets.size(), read.size()); ++i) {
    if (pose.weights[i] == 0.0f && pose.weights_node < 0) continue;
    const std::string place = where + "/targets/" + std::to_string(i);
    const auto deltas = [&](const char* semantic) {
      return read_deltas(context, accessors, targets[i], semantic, vertices, selection, place);
    };
    read[i] = {deltas("POSITION"), deltas("NORMAL"), deltas("TANGENT")};
    if (!is_finite(read[i].positions)) context.fail(place + "/POSITION", "is not finite");
  }
  return read;
}

std::vector<JointSet> read_joint_sets(Context& context, Accessors& accessors,
                                      const Attributes& attributes,
                                      const VertexSelection& selection, std::size_t joint_count,
                                      const std::string& where) {
  std::vector<JointSet> sets;
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
    context.claim(selection.size(), 6 * sizeof(std::uint32_t) + sizeof(V4f), where);
    std::vector<std::uint32_t> numbers(4 * selection.size());
    std::vector<V4f> shares(selection.size());
    read_selected(accessors, joints->second, selection, 4, numbers.data());
    read_selected(accessors, weights->second, selection, 4, &shares[0].x, Scale::always_normalized);
    sets.push_back(joint_set(context, numbers, std::move(shares), joint_count, where));
  }
  return sets;
}

Skin read_skin(Context& context, Accessors& accessors, const tinygltf::Skin& source,
               const std::string& where) {
  const std::size_t count = source.joints.size();
  context.claim(count, 2 * sizeof(M44d) + 16 * sizeof(float) + sizeof(int), where);
  Skin skin{source.joints, std::vector<M44d>(count)};
  if (source.inverseBindMatrices < 0) return skin;
  const std::string user = where + "/inverseBindMatrices";
  accessors.require(source.inverseBindMatrices, user, {16}, {CT::float32});
  accessors.check(source.inverseBindMatrices);
  if (accessors[source.inverseBindMatrices].count < count) {
    context.fail(user, "has fewer matrices than the skin has joints");
  }
  std::vector<float> numbers(16 * count);
  accessors.read(source.inverseBindMatrices, 0, count, 16, numbers.data());
  for (std::size_t i = 0; i < count; ++i) {
    // Column-major matrices of column vectors lie in memory as row-major ones of row vectors do.
    for (std::size_t k = 0; k < 16; ++k) {
      const float x = numbers[16 * i + k];
      if (!std::isfinite(x)) context.fail(user, "matrix " + std::to_string(i) + " is not finite");
      skin.inverse_binds[i][static_cast<int>(k / 4)][k % 4] = x;
    }
  }
  return skin;
}

void apply_pose(Context& context, Accessors& accessors, const tinygltf::Primitive& primitive,
                const Pose& pose, const VertexSelection& selection, const std::string& where,
                const std::optional<TangentSpace>& space, Mesh& mesh, Deformation& deformation) {
  const auto provide_tangents = [&] {
    const bool missing = space && mesh.tangents.empty() && !mesh.normals.empty() &&
                         static_cast<std::size_t>(space->uv_set) < mesh.uvs.size();
    return missing ? compute_tangents(context, where, *space, mesh) : std::vector<std::uint32_t>();
  };
  const std::uint64_t vertices = accessors[primitive.attributes.at("POSITION")].count;
  deformation.targets =
      read_morph_targets(context, accessors, primitive.targets, pose, vertices, selection, where);
  deformation.weights = deformation.rest_weights = pose.weights;
  deformation.weights_node = pose.weights_node;
  if (pose.posed_skin) {
    deformation.joint_sets = read_joint_sets(context, accessors, primitive.attributes, selection,
                                             pose.posed_skin->skin.joints.size(), where);
    deformation.skin = pose.posed_skin->kept;
  }
  if (pose.weights_node < 0) {
    report(context, where, morph(deformation.targets, pose.weights, mesh));
    deformation.targets.clear();
    deformation.weights.clear();
    deformation.rest_weights.clear();
  }
  if (!pose.is_animated()) {
    bool turned = false;
    if (pose.posed_skin) {
      report(context, where, skin(deformation.joint_sets, pose.posed_skin->joints, turned, mesh));
    }
    provide_tangents();
    return;
  }
  // Tangents of the mesh at rest move with it: which vertices they are to be doubled at, and which
  // share one, must not change under animation.
  repeat(provide_tangents(), deformation);
  context.claim(mesh.positions.size(), 2 * sizeof(V3f) + sizeof(V4f), where);
  deformation.positions = mesh.positions;
  deformation.normals = mesh.normals;
  deformation.tangents = mesh.tangents;
  report(
      context, where,
      deform(pose.posed_skin ? pose.posed_skin->joints : std::vector<M44d>(), deformation, mesh));
}

}  // namespace lumivec::gltf
