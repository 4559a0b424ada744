// Which paths eye paths leave to light paths (light_tracer.h), as a state machine run from the eye.
#pragma once

#include "integrator/bsdf.h"
#include "integrator/settings.h"

namespace lumivec {

// What decides whether a path that now ended at certain lights would be left to light_tracer.h.
struct CausticState {
  // Light paths bring photons, which are found from wherever the path has come; else they are
  // connected to the eye, from vertices that it sees directly.
  bool photons = false;
  bool scattered = false;  // a D event has been, and nothing specular before the first
  bool broad = false;      // the first of them, with photons any, was one of a broad lobe
  bool bent = false;       // since the last D: an S event other than straight through a thin wall
  bool patchy = false;     // since the last broad D: such an S event or one of a glossy lobe

  void event(LobeKind kind, bool straight, Term after) {
    if (straight || (!photons && after == Term::specular)) return;
    if (kind == LobeKind::specular) {
      bent = scattered;
      patchy = broad;
      return;
    }
    patchy = kind == LobeKind::glossy && broad;
    if (!scattered || photons) broad = broad || is_broad(kind);
    scattered = true;
    bent = false;
  }

  // After the events so far, and after one more of that kind.
  bool left_to_light_paths() const { return bent || patchy; }
  bool left_to_light_paths(LobeKind next) const {
    return next == LobeKind::specular ? scattered : next == LobeKind::glossy && broad;
  }
};

}  // namespace lumivec
