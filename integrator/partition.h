// The partition of light paths into five terms, as a state machine run from the eye.
#pragma once

#include <array>

#include "integrator/bsdf.h"
#include "integrator/settings.h"

namespace lumivec {

// The state is the term to which light found now would belong; it starts at Term::emitted (E L).
// Scattering on a lobe of the given kind: E S… is specular; E D direct; E D S+ caustic; E D … D …
// indirect.
constexpr Term after_event(Term term, LobeKind kind) {
  const bool specular = kind == LobeKind::specular;
  switch (term) {
    case Term::emitted:
      return specular ? Term::specular : Term::direct;
    case Term::specular:
      return Term::specular;
    case Term::direct:
    case Term::caustic:
      return specular ? Term::caustic : Term::indirect;
    case Term::indirect:
      break;
  }
  return Term::indirect;
}

constexpr std::uint32_t term_bit(Term term) {
  return 1u << static_cast<unsigned>(term);
}

// The terms that a path in this state can still contribute to.
constexpr std::uint32_t reachable_terms(Term term) {
  constexpr std::uint32_t indirect = term_bit(Term::indirect);
  constexpr std::uint32_t caustic = term_bit(Term::caustic) | indirect;
  constexpr std::uint32_t direct = term_bit(Term::direct) | caustic;
  constexpr std::uint32_t specular = term_bit(Term::specular);
  constexpr std::array<std::uint32_t, term_count> reachable = {
      term_bit(Term::emitted) | specular | direct, specular, direct, indirect, caustic};
  return reachable[static_cast<std::size_t>(term)];
}

}  // namespace lumivec
