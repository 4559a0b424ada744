// All solids of a scene as one geometry of Embree's, which asks for their bounds and boundaries.
#pragma once

#include "integrator/embree_api.h"

namespace lumivec {

class TracedScene;

// Makes a user geometry hold TracedScene::solids, one primitive each. The scene must outlive it,
// and its solids may not change any more.
void set_solids(RTCGeometry geometry, const TracedScene& scene);

}  // namespace lumivec
