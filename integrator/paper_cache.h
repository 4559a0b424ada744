// The indirect light of a picture by the method of 2003: light vectors that are kept by position
// and view direction (section 3.2) and reused by the paper's criteria (section 4.2).
//
// A light vector stands for all light that the diffuse and broad lobes of a surface make of its
// indirect light; glossy and specular lobes go on by path tracing. Of surfaces that let light pass
// it stands for the diffuse lobe alone: the rest comes from both sides. Lambertian surfaces look
// the same from everywhere, so that their records have no view direction and no part in p for it.
//
// Look-ups may run while records are inserted; one takes 0.2 to 0.5 µs and 0.03 µs for each record
// near by.
#pragma once

#include <cstdint>

#include "integrator/bsdf.h"
#include "integrator/irradiance_cache.h"
#include "integrator/light_vector_cache.h"
#include "integrator/media.h"
#include "integrator/paper_validity.h"

namespace lumivec {

// A place that the eye sees, where light is asked for.
struct PaperPoint {
  CachePoint place;
  V3f view{0.0f};  // unit, to where it is seen from
  SurfaceParameters surface;
  MediumStack media;
};

// The kinds of lobes of a surface that light vectors stand for, bit 1 << kind each.
std::uint32_t paper_kinds(const Bsdf& bsdf, const SurfaceParameters& surface);

// BSDF times the cosine for light from unit direction wi, of some kinds of lobes.
Color paper_f_cos(const Bsdf& bsdf, std::uint32_t kinds, const V3f& wi);

// The colour of a texture that records are made for, and that radiance without a direction is
// relative to. Not black, since what is black here may be white a step further.
Color paper_base_color(const Color& base_color);

class PaperCache {
 public:
  PaperCache(const PaperParameters& parameters, std::uint64_t max_bytes);

  // The radiance (cd·m⁻²) that the point's lobes of paper_kinds() make of indirect light: by the
  // record that was made there if there is one, otherwise by the weighted mean of all valid ones.
  // False: they are fewer than needed. bsdf: of the point.
  bool look_up(const PaperPoint& point, const Bsdf& bsdf, Color& radiance) const;

  // Adds the record of a point, Lambertian or not. False: the memory is used up, and nothing is
  // stored. Thread-safe.
  bool insert(const PaperPoint& point, const PaperRecord& record, bool lambertian);

  std::uint64_t size() const { return flat_tree_.size() + directional_.record_count(); }
  std::uint64_t bytes() const {
    return flat_tree_.bytes() + flat_records_.bytes() + directional_.bytes();
  }
  // Makes look-ups faster. Not while others use the cache.
  void balance();

 private:
  const PaperParameters parameters_;
  const std::uint64_t max_bytes_;
  // Of Lambertian surfaces, by position alone.
  PointTree flat_tree_;
  StableArray<PaperRecord> flat_records_;
  LightVectorCache<PaperRecord> directional_;
};

}  // namespace lumivec
