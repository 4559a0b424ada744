// What a render hands over: five terms and the first-hit data of every pixel, row 0 at the top.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "integrator/settings.h"
#include "loader/scene.h"

namespace lumivec {

// Means over the samples of each pixel. Arrays are width × height long. A pixel that no sample
// reached is black.
struct Framebuffer {
  int width = 0;
  int height = 0;
  std::array<std::vector<Color>, term_count> terms;  // radiance, cd·m⁻², indexed by Term
  std::vector<Color> albedo;                         // [0, 1], first hit, mean over samples
  std::vector<V3f> normal;  // world space, unit length or shorter at edges, mean over samples
  std::vector<V3f>
      position;  // world space, scene units, of the pixel's first sample; 0 if it hits nothing
  std::vector<float>
      depth;  // scene units along the view axis, of the first sample; +inf if it hits nothing
  std::vector<std::int32_t>
      object;  // index into Scene::instances, of the first sample; -1 if it hits nothing
  std::vector<std::uint32_t> samples;  // that went into the means

  std::size_t pixel_count() const { return std::size_t(width) * std::size_t(height); }

  // The sum of the five terms at pixel i: the picture.
  Color beauty(std::size_t i) const {
    Color sum(0.0f);
    for (const std::vector<Color>& term : terms) sum += term[i];
    return sum;
  }
};

struct RenderStatistics {
  double seconds_prepare = 0.0;  // building acceleration structures, lights and tables
  double seconds_sample = 0.0;   // sampling
  std::uint64_t rays_camera = 0;
  std::uint64_t rays_scatter = 0;
  std::uint64_t rays_shadow = 0;
  std::uint64_t samples = 0;          // camera paths in all
  std::uint64_t light_paths = 0;      // paths started at lights
  std::uint64_t photons = 0;          // that light paths brought to maps
  std::uint64_t gather_paths = 0;     // paths that made records
  std::uint64_t rays_visibility = 0;  // short tests toward records
  std::uint64_t cache_hits = 0, cache_misses = 0;
  std::uint64_t records = 0;      // in the caches
  std::uint64_t cache_bytes = 0;  // of the caches
  // Of records by the paper's criteria, by LightVectorForm: all but the first fell back.
  std::array<std::uint64_t, light_vector_form_count> light_vectors{};
  double seconds_cache = 0.0;  // making records
  std::array<std::uint64_t, term_count>
      dropped{};                 // non-finite samples left out, by the term that was not finite
  double error_estimate = -1.0;  // own estimate of √relMSE, as a fraction; < 0: none was made
  bool stopped_early = false;    // by the caller

  // Adds up what was traced; times and estimates are left alone.
  void add_counts(const RenderStatistics& from) {
    rays_camera += from.rays_camera;
    rays_scatter += from.rays_scatter;
    rays_shadow += from.rays_shadow;
    rays_visibility += from.rays_visibility;
    samples += from.samples;
    light_paths += from.light_paths;
    photons += from.photons;
    gather_paths += from.gather_paths;
    cache_hits += from.cache_hits;
    cache_misses += from.cache_misses;
    for (std::size_t i = 0; i < term_count; ++i) dropped[i] += from.dropped[i];
  }
};

}  // namespace lumivec
