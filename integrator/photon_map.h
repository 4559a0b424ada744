// The cache of caustic light: photons where light from the lights lands on a non-specular lobe
// after specular events alone, and where it lands on a broad lobe after specular and glossy ones.
//
// Each photon is a light vector that brings a share of a light's flux; what a surface makes of
// those around a point is a density estimate over a disc on its tangent plane. The disc grows with
// the size of a pixel there, shrinks where photons are many, and shrinks from one map to the next,
// so that the mean of the pictures that are made with each converges to the reference (Jensen 2001;
// Knaus and Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach").
//
// Near walls and edges the disc is only as large as the surface under it: short rays along the
// surface find where it ends. Paths that gather light, of which each counts for little, see few
// of the photons, and no edges. A look-up takes about 1 µs and 0.02 µs for each photon
// found.
#pragma once

#include <cstdint>
#include <vector>

#include "integrator/bsdf.h"
#include "integrator/framebuffer.h"
#include "integrator/point_tree.h"
#include "integrator/traced_scene.h"

namespace lumivec {

struct Photon {
  V3f position{0.0f};        // traced space
  V3f direction{0.0f};       // unit, to where the light comes from
  V3f normal{0.0f};          // unit, geometric, on that side
  Color flux{0.0f};          // lm, to be divided by the number of light paths
  bool caustic = true;       // came over specular lobes alone; else over glossy ones too
  std::uint16_t events = 0;  // of scattering before
};

// Where the light of photons is asked for.
struct PhotonQuery {
  V3f position{0.0f};          // traced space
  V3f geometric_normal{0.0f};  // unit, on the eye's side
  float error = 0.0f;          // as in SurfacePoint
  float radius = 0.0f;         // of the disc in the first map, scene units
  float most_radius = 0.0f;    // where photons are few, for paths that gather light
  bool gathering = false;      // for a path that gathers light
  bool glossy = true;          // whether photons over specular lobes count for the glossy lobe
  std::uint32_t seed = 0;      // of the directions in which edges are looked for
  int max_events = 0;          // that a path may have beyond this one's; 0: no limit
};

// Radiance toward the eye, by what the photons met before.
struct PhotonLight {
  Color caustic{0.0f};
  Color patchy{0.0f};
};

class PhotonMap {
 public:
  // scene must outlive this.
  explicit PhotonMap(const TracedScene& scene) : scene_(scene) {}

  // Replaces all photons by those of `paths` light paths. number: of the map, from 0 on.
  // widen: factor of the discs' area, for maps of few paths. gather_stride: paths that gather light
  // see one photon in so many, ≥ 1.
  void build(std::vector<Photon> photons, std::uint64_t paths, std::uint32_t number,
             float widen = 1.0f, std::uint32_t gather_stride = usual_gather_stride);
  static constexpr std::uint32_t usual_gather_stride = 16;

  bool empty() const { return photons_.empty(); }
  std::size_t size() const { return photons_.size(); }
  std::size_t bytes() const {
    return photons_.capacity() * sizeof(Photon) + tree_.bytes() + few_tree_.bytes();
  }

  // What a surface makes of the photons around a point.
  PhotonLight reflect(const PhotonQuery& query, const Bsdf& bsdf,
                      RenderStatistics& statistics) const;

 private:
  static constexpr int directions = 8;
  void find_edges(const PhotonQuery& query, const Frame& frame, float radius, float turn,
                  std::array<float, directions>& edges, RenderStatistics& statistics) const;

  const TracedScene& scene_;
  std::vector<Photon> photons_;
  PointTree tree_, few_tree_;  // of all photons, and of every gather_stride_-th
  std::uint32_t gather_stride_ = usual_gather_stride;
  float flux_scale_ = 0.0f;  // one over the number of light paths
  float shrink_ = 1.0f;      // of discs' areas, from the first map to this one
};

}  // namespace lumivec
