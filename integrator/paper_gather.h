// Makes the paper's records of indirect light (section 2.5): one path through each cell of a
// stratified hemisphere (eq. 2.5), traced to its own end, and from the cells the light vector (eq.
// 2.2, 2.3), the mean distance d_moy and the variation ΔE.
//
// ΔE is the length of the paper's gradient (eq. 2.6), which sees how the cosines of what the cells
// hit change as the point moves, and not that other light comes into view; relative to E. Light
// from all around at distance r has 4 / (3 r), so that E_B is what bounds most records: whether
// d_moy is the plain mean, as here, or the harmonic one makes no difference on the Cornell box.
#pragma once

#include <cstdint>

#include "integrator/paper_cache.h"
#include "integrator/path_tracer.h"

namespace lumivec {

// The record of a point. bsdf: of the point with paper_base_color(). samples: paths at most, ≥ 1;
// seed: of their random numbers. ends: what their ends see of the caches, photons at most.
PaperRecord make_paper_record(const PathTracer& tracer, const TracedScene& scene,
                              const PaperPoint& point, const Bsdf& bsdf, int samples,
                              std::uint32_t seed, RenderStatistics& statistics,
                              const CacheUse& ends = {});

}  // namespace lumivec
