// Plays the animations of a scene (glTF 2.0, section 3.11 and appendix C): nodes move shapes,
// lights and cameras, morph weights and joints move vertices.
//
// A pose follows from the animations and times that are asked for, and from nothing before: what
// none of them sets is at rest, as the file leaves it. The scene keeps what that takes (Motion in
// loader/scene.h); materials, images and the environment are never touched.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

struct PlayedAnimation {
  std::size_t animation = 0;  // index into Scene::animations
  double seconds = 0.0;       // any number; clamped to the first and last key of each channel
};

// What posing a scene changed: indices into the scene's arrays, ascending. All else is untouched.
struct PoseChanges {
  std::vector<int> instances;  // their transform, or whether they are visible
  std::vector<int> meshes;     // positions, normals and tangents, never their number; rarely the
                               // order of each triangle's corners
  std::vector<int> lights;     // their transform
  std::vector<int> cameras;    // their transform

  bool empty() const;
};

// Poses the scene by one animation. Times that differ only beyond the last key change nothing.
// Costs what moves: a matrix product per animated node and those below it, one pass per deformed
// mesh; meshes are skinned by several threads. Throws std::out_of_range for an animation that the
// scene does not have, before anything changes.
PoseChanges pose_scene(Scene& scene, std::size_t animation, double seconds);

// Poses it by several at once; where two set the same property, the later one does. By none, the
// scene is at rest, bit for bit as it was loaded.
PoseChanges pose_scene(Scene& scene, std::span<const PlayedAnimation> played);

// The time of its last key, in seconds; it begins at 0. 0 for an animation without channels.
double animation_length(const Animation& animation);

}  // namespace lumivec
