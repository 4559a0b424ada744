// What is known of a path while it is traced: one lane of a stream of them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "integrator/bsdf.h"
#include "integrator/caustic_state.h"
#include "integrator/media.h"
#include "integrator/ray_packet.h"
#include "integrator/settings.h"
#include "integrator/sobol.h"
#include "integrator/surface.h"
#include "integrator/visible_surfaces.h"

namespace lumivec {

// Continuations of each path from its first vertex on. Light from further away has nearly all of
// the variance, and what leads to the first vertex (the eye's ray, light sampling there) need not
// be traced anew for it. On the Cornell boxes four have the squared error of four paths for the
// time of two and a half (Arvo and Kirk 1990).
constexpr std::uint32_t usual_splits = 4;
// Likewise from glass that the eye sees, beside cached light. On Sphere Flake eight take 2.3 times
// as long as one and have a sixth of its squared error; four 1.8 times, and three tenths.
constexpr std::uint32_t mirror_splits = 8;
// Random numbers for the pixel's position and light sampling at the first vertex are drawn once a
// path, others once a continuation.
constexpr std::uint32_t first_continued_block = 2;

// The first vertex of a path, kept until all of the path's continuations have left it.
struct PathFork {
  SurfacePoint point;
  SurfaceParameters parameters;
  Bsdf bsdf;
  V3f receiver;
  std::uint32_t light_samples;  // that were taken there
  Color throughput;
  MediumStack media;
  float length;  // of the path from the eye
};

// A vertex with cached light, where the path stays for several light samples before it goes on by
// the lobes that are left.
struct PathStop {
  SurfacePoint point;
  SurfaceParameters parameters;
  Bsdf bsdf;
  Bsdf rest;  // without the lobes whose light is cached
  std::uint32_t cached_kinds;
  V3f receiver;

  // Whether the cached lobe is the diffuse one alone, which is easily sampled by itself.
  bool samples_sky() const { return cached_kinds == kind_bit(LobeKind::diffuse); }
};

struct PathLane {
  bool active = false;
  bool camera_ray = false;
  RayMask ray_kind = other_ray;  // of the ray that is traced next
  bool ended = false;            // nothing more to trace but perhaps a shadow ray
  std::uint32_t pixel = 0;       // of the tile
  std::uint32_t sample = 0;
  std::uint32_t seed = 0;          // of the pixel
  std::uint32_t continuation = 0;  // of the splits that leave the first vertex
  std::uint32_t splits = usual_splits;
  bool probe = false;  // left a diffuse lobe whose other light is cached: brings caustics alone
  bool probe_bent = false;  // since then an S event other than straight through a thin wall
  float length = 0.0f;      // of the path from the eye, scene units
  int depth = 0;            // scattering events so far

  V3f origin{0.0f}, direction{0.0f};
  float near = 0.0f, far = std::numeric_limits<float>::infinity();
  Color throughput{0.0f};
  float radiance_scale =
      1.0f;  // product of squared ratios of indices: what throughput owes to refraction alone
  Term term = Term::emitted;
  MediumStack media;
  CausticState caustic;

  // How light sampling at the last vertex could have found what this ray finds.
  float light_trials = 0.0f;  // light samples there; 0: none
  V3f vertex{0.0f}, vertex_normal{0.0f};
  float scatter_pdf = 0.0f;

  std::uint32_t light_samples = 1, light_sample = 0;  // of the vertex, and which of them is next
  // The diffuse lobe has the direct light of the environment's even part there.
  bool even_cached = false;
  bool shadow = false;
  RayMask shadow_mask = all_rays;  // 0: nothing is in the way
  V3f shadow_origin{0.0f}, shadow_target{0.0f};
  // If nothing is in between: of non-specular and of specular lobes.
  Color shadow_light[2] = {Color(0.0f), Color(0.0f)};
  // Besides, of the diffuse lobe, if thin walls are in between and nothing else: what is cached
  // otherwise.
  Color shadow_even{0.0f};
  Term shadow_term[2] = {Term::direct, Term::specular};

  std::array<Color, term_count> radiance;
  float photons = 0.0f;  // brightness that photons brought
  Color albedo{0.0f};
  V3f normal{0.0f}, position{0.0f};
  float hit_depth = 0.0f;
  std::int32_t object = -1;
  bool follows_mirror =
      false;  // left the first hit by a specular lobe, until it hits what that shows
  float mirrored = shows_nothing;

  PathLane() { radiance.fill(Color(0.0f)); }

  void add(Term to, const Color& light) { radiance[static_cast<std::size_t>(to)] += light; }

  // Continuations have a sequence of their own, of which each takes a point, so that those of one
  // pixel are spread evenly over all of its samples. So do further samples of a use.
  std::uint32_t index_of(std::uint32_t block, std::uint32_t uses = 1, std::uint32_t use = 0) const {
    const bool continued = block >= first_continued_block;
    const std::uint32_t index = sample * (continued ? splits : 1) + (continued ? continuation : 0);
    return index * uses + use;
  }
  // Blocks of random numbers for light sampling at the path's last vertex and for scattering there.
  std::uint32_t light_block() const { return 1 + 2 * static_cast<std::uint32_t>(depth); }
  std::uint32_t scatter_block() const { return light_block() + 1; }
};

// A block of random numbers of each of eight lanes.
struct DrawnBlocks {
  Lanes8 index, block;
  std::array<std::array<float, 4>, 8> points;
};

// What the lanes draw ahead.
struct DrawnNumbers {
  DrawnBlocks for_lights, to_scatter;
  std::array<V3f, 8> directions;  // by the cosine, of to_scatter
};

}  // namespace lumivec
