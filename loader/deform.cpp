#include "loader/deform.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "loader/surface_directions.h"
#include "loader/transforms.h"

namespace lumivec {
namespace {

constexpr std::size_t grain = 1024;  // vertices a task: tens of microseconds

template <class Vector>
void add(const std::vector<V3f>& deltas, float weight, std::vector<Vector>& to) {
  if (to.empty()) return;
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    for (int c = 0; c < 3; ++c) to[i][c] += weight * deltas[i][c];
  }
}

// Moved normals leave tangents behind that no target moves.
void straighten_tangents(Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    V4f& tangent = mesh.tangents[i];
    const V3f& n = mesh.normals[i];
    V3f t(tangent.x, tangent.y, tangent.z);
    t -= n * n.dot(t);
    if (!normalize(t)) t = perpendicular(n);
    tangent = V4f(t.x, t.y, t.z, tangent.w);
  }
}

// The blend of a vertex's joints; false if it has no weight.
bool blend(const std::vector<JointSet>& sets, const std::vector<M44d>& joints, std::size_t vertex,
           M44d& sum) {
  sum = M44d(0.0);
  double total = 0.0;
  for (const JointSet& set : sets) {
    for (int i = 0; i < 4; ++i) {
      const double weight = set.weights[vertex][i];
      if (weight == 0.0) continue;
      sum += joints[set.joints[vertex][i]] * weight;
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

// Does m mirror?
bool move_vertex(const M44d& m, std::size_t vertex, Mesh& mesh) {
  V3d position;
  m.multVecMatrix(V3d(mesh.positions[vertex]), position);
  mesh.positions[vertex] = V3f(position);
  const double determinant = determinant3(m);
  if (!mesh.normals.empty()) {
    V3f& normal = mesh.normals[vertex];
    normal = V3f(normal_times(V3d(normal), m, determinant));
  }
  if (!mesh.tangents.empty()) {
    V4f& tangent = mesh.tangents[vertex];
    const V3f t(direction_times(V3d(tangent.x, tangent.y, tangent.z), m));
    tangent = V4f(t.x, t.y, t.z, determinant < 0.0 ? -tangent.w : tangent.w);
  }
  return determinant < 0.0;
}

bool is_finite(const V3f& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void renew(Mesh& mesh, DeformationFaults& faults) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (is_finite(mesh.positions[i])) continue;
    mesh.positions[i] = V3f(0.0f);
    if (!faults.not_finite) faults.not_finite = i;
  }
  faults.normals += renew_normals(mesh);
  faults.tangents += renew_tangents(mesh);
}

}  // namespace

DeformationFaults morph(const std::vector<MorphTarget>& targets, const std::vector<float>& weights,
                        Mesh& mesh) {
  DeformationFaults faults;
  bool moved = false;
  bool normals_moved = false;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (weights[i] == 0.0f) continue;
    add(targets[i].positions, weights[i], mesh.positions);
    add(targets[i].normals, weights[i], mesh.normals);
    add(targets[i].tangents, weights[i], mesh.tangents);
    moved = true;
    normals_moved |= !targets[i].normals.empty();
  }
  if (!moved) return faults;
  renew(mesh, faults);
  if (normals_moved) straighten_tangents(mesh);
  return faults;
}

DeformationFaults skin(const std::vector<JointSet>& joint_sets,
                       const std::vector<M44d>& joint_matrices, bool& turned, Mesh& mesh) {
  std::atomic<std::size_t> mirrored = 0;
  std::atomic<std::size_t> loose = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.positions.size(), grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      std::size_t mirrored_here = 0;
                      std::size_t loose_here = 0;
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        M44d m;
                        if (!blend(joint_sets, joint_matrices, i, m)) {
                          ++loose_here;
                          continue;
                        }
                        mirrored_here += move_vertex(m, i, mesh);
                      }
                      mirrored += mirrored_here;
                      loose += loose_here;
                    });
  // A mesh that its joints mirror shows its other side unless its triangles turn too.
  const bool turn = 2 * mirrored > mesh.positions.size();
  if (turn != turned) {
    for (auto& t : mesh.triangles) std::swap(t.y, t.z);
  }
  turned = turn;
  DeformationFaults faults;
  faults.loose = loose;
  renew(mesh, faults);
  return faults;
}

std::vector<M44d> joint_matrices(const Skin& skin, const std::vector<Node>& nodes) {
  std::vector<M44d> matrices(skin.joints.size());
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    matrices[i] =
        skin.inverse_binds[i] * nodes[static_cast<std::size_t>(skin.joints[i])].local_to_world;
  }
  return matrices;
}

DeformationFaults deform(const std::vector<M44d>& joints, Deformation& deformation, Mesh& mesh) {
  mesh.positions = deformation.positions;
  mesh.normals = deformation.normals;
  mesh.tangents = deformation.tangents;
  DeformationFaults faults = morph(deformation.targets, deformation.weights, mesh);
  if (deformation.skin >= 0) {
    const DeformationFaults skinned =
        skin(deformation.joint_sets, joints, deformation.turned, mesh);
    faults.loose = skinned.loose;
    faults.normals += skinned.normals;
    faults.tangents += skinned.tangents;
    if (!faults.not_finite) faults.not_finite = skinned.not_finite;
  }
  deformation.bounds = faults.not_finite ? Imath::Box3d() : bounds_of(mesh);
  return faults;
}

Imath::Box3d bounds_of(const Mesh& mesh) {
  Imath::Box3f box;
  for (const V3f& p : mesh.positions) box.extendBy(p);
  return {V3d(box.min), V3d(box.max)};
}

}  // namespace lumivec
