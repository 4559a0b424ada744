// Embree filters for surfaces that a ray may pass straight through: alpha cut-outs and blends, and
// thin walls.
//
// Straight passage through partial opacity is no event. It is decided by a hash of the ray's seed
// and the surface, so that the answer is the same however often Embree asks. Shadow rays also pass
// smooth thin walls, which tint them.
#pragma once

#include "integrator/embree_api.h"

namespace lumivec {

// Drops hits on what is transparent at the point. The context must be a TraceQuery's.
void filter_intersection(const RTCFilterFunctionNArguments* arguments);

// Drops hits on what is transparent, and on smooth thin walls, whose transmittance is multiplied
// into the query's.
void filter_occlusion(const RTCFilterFunctionNArguments* arguments);

}  // namespace lumivec
