// The cache of view-independent light vectors of one term: where records may be used, and what they
// say there.
//
// Each record holds inside an ellipse on its tangent plane whose half axes follow from the second
// derivatives of the irradiance there: over a disc of radius R linear extrapolation errs by
// π λ R⁴ / 4 (Schwarzhaupt, Jensen and Jarosz 2012), so that R = (4 ε E A / π λ)^¼ for a relative
// error ε, a mean irradiance E, and an area A that the budget is for. ε A is the budget that a
// look-up states, which may change with the eye and with time; records store R for a budget of 1.
//
// Look-ups may run while records are inserted; a look-up costs about 0.3 µs and 0.05 µs for each
// record found.
#pragma once

#include <cstdint>
#include <vector>

#include "integrator/irradiance_record.h"
#include "integrator/point_tree.h"
#include "integrator/settings.h"
#include "integrator/stable_array.h"
#include "integrator/traced_scene.h"

namespace lumivec {

// Where light is asked for.
struct CachePoint {
  V3f position{0.0f};          // traced space
  V3f geometric_normal{0.0f};  // unit
  V3f normal{0.0f};            // unit, interpolated, before normal maps
  float error = 0.0f;          // as in SurfacePoint
  float footprint = 0.0f;      // size of a pixel there, scene units; 0: none
  int instance = -1;           // index into Scene::instances
};

struct CachedLight {
  LightSum light;
  V3f sky_normal{0.0f};
  float weight = 0.0f;  // sum of the weights of the records that were used
  int records = 0;
};

class IrradianceCache {
 public:
  // scene must outlive this.
  IrradianceCache(const TracedScene& scene, const ValidityParts& parts, std::uint64_t max_bytes);

  // Interpolates between the records that hold at a point, for a budget in scene units². False:
  // their weights add up to less than needed_weight. visibility_rays is counted up.
  bool look_up(const CachePoint& point, float budget, float needed_weight, CachedLight& result,
               std::uint64_t& visibility_rays) const;

  // Adds a record. False: the memory is used up, and nothing is stored. Thread-safe.
  bool insert(const IrradianceRecord& record);

  std::uint32_t size() const { return tree_.size(); }
  bool full() const;
  // How far a record must be looked for so that it serves pixels of that size at that budget.
  static float least_reach(float footprint, float budget);
  // The relative error that is aimed at: below one percent detail as fine as pixels is asked for,
  // and finer. Not while others look up.
  void set_error(double error);
  // Half axes are not shorter where a record is used for pixels of that size, scene units.
  float least_half_axis(const IrradianceRecord& r, float footprint) const;
  std::uint64_t bytes() const;
  const IrradianceRecord& record(std::uint32_t i) const { return records_[i]; }

  // To change records; not while others look up. Afterwards commit() must be called, which bounds
  // radii by those of neighbours, and makes look-ups fast.
  IrradianceRecord& edit(std::uint32_t i) { return records_[i]; }
  void commit(float budget);
  // Likewise without the bounds.
  void rebuild();
  // Forgets all records; not while others use the cache.
  void clear();

 private:
  float weight(const IrradianceRecord& record, const CachePoint& point, float scale) const;
  bool may_be_hidden(const IrradianceRecord& record, const V2f& offset) const;

  const TracedScene& scene_;
  const ValidityParts parts_;
  const std::uint64_t max_bytes_;
  float least_share_ = 1.0f;  // of what half axes are at least, usually
  PointTree tree_;
  StableArray<IrradianceRecord> records_;
};

}  // namespace lumivec
