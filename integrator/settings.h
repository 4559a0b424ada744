// What a render is asked for: one struct for the command, the window and the tests.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lumivec {

// The five parts of the light (method: E L | E S… | E D L | E D…D…L | E D S+ L); a partition of all
// paths.
enum class Term : std::uint8_t { emitted, specular, direct, indirect, caustic };
constexpr int term_count = 5;
constexpr std::array<std::string_view, term_count> term_names = {"emitted", "specular", "direct",
                                                                 "indirect", "caustic"};

// How the light is computed: by unbiased path tracing, or from caches of light vectors.
enum class Integrator : std::uint8_t { path, light_vectors };
constexpr std::array<std::string_view, 2> integrator_names = {"path", "light-vectors"};

// When a cached record may be reused: by the criteria of the 2003 paper, or by derivatives.
enum class Validity : std::uint8_t { paper, hessian };
constexpr std::array<std::string_view, 2> validity_names = {"paper", "hessian"};

// What a light vector's direction is; all but the first are fall-backs.
enum class LightVectorForm : std::uint8_t {
  exact,     // that of eq. 2.2
  weighted,  // ∫ f L cosθ ω dω: of the light that is reflected
  normal,    // the surface's normal
  radiance   // none: the magnitude is the reflected radiance, whatever the BSDF
};
constexpr int light_vector_form_count = 4;
constexpr std::array<std::string_view, light_vector_form_count> light_vector_form_names = {
    "exact", "weighted", "normal", "radiance"};

// The paper's four parameters (section 4.2).
struct PaperParameters {
  float max_variation = 0.3f;          // E_B: relative change of irradiance, > 0
  float min_normal_cosine = 0.9f;      // S_courb, [-1, 1): of the normals at both points
  float min_direction_cosine = 0.95f;  // S_dir, [-1, 1): of both view directions
  int needed_records = 3;              // valid records that an interpolation needs, ≥ 1
  int seeds = 1000;     // pixels, at random, where records are made first (section 2.4)
  int samples = 512;    // rays of a record's hemisphere at most, ≥ 1 (eq. 2.5)
  int max_records = 0;  // no more are made, to compare at equal numbers; 0: no limit
};

// Parts of the hessian validity that can be left out or added, so that their worth can be measured.
struct ValidityParts {
  bool hessian = true;          // radii by second derivatives; else by distances alone
  bool gradient = true;         // extrapolation by first derivatives
  bool neighbour_clamp = true;  // radii differ by no more than the distance between records
  bool leak_guard = true;       // visibility tests toward records behind near obstacles
  bool footprint_clamp = true;  // no radius below the pixels' size
  // Caches the direct light of the environment's even part. At 256 × 256 under a grey sky that
  // takes a quarter from the direct layer's error with 16 samples a pixel, for a fifth more time:
  // sampling pays better, but for pictures of very few samples.
  bool direct_cache = false;
};

// Pixel reconstruction filters, all positive: samples are drawn from the filter, so pixels stay
// independent.
enum class PixelFilter : std::uint8_t { box, tent, gaussian, blackman_harris };

constexpr int max_picture_side = 65536;       // pixels
constexpr int max_picture_samples = 1 << 22;  // a pixel

struct RenderSettings {
  Integrator integrator = Integrator::path;
  Validity validity = Validity::hessian;  // light_vectors only
  PaperParameters paper;
  ValidityParts validity_parts;
  // Relative error of cached light that is aimed at where `error` is 0: radii and sample counts of
  // records follow. A fraction.
  double cache_error = 0.01;
  std::uint64_t cache_bytes = std::uint64_t{1} << 30;  // of all caches; full ones store no more

  int width = 512;   // pixels, [1, max_picture_side]
  int height = 512;  // pixels, [1, max_picture_side]
  PixelFilter filter = PixelFilter::box;

  // What ends a render; each 0 means "not by this". With none set: 64 samples a pixel.
  int samples = 0;       // samples a pixel, at most max_picture_samples
  double seconds = 0.0;  // wall-clock time for sampling
  double error = 0.0;    // target relative error, √relMSE, as a fraction (0.01 = 1%)

  std::uint32_t terms = (1u << term_count) - 1;  // bit i: compute Term(i); others are left black
  int threads = 0;                               // 0: all processors
  std::uint64_t seed = 0;

  // A lobe below this perceptual roughness is specular (S), as delta lobes are; above, it is
  // non-specular (D). Caches interpolate D lobes, so this is where reflections become too sharp to
  // be interpolated. Range [0, 1].
  float specular_roughness = 0.15f;

  int max_depth = 0;  // scattering events a path may have; 0: no limit, Russian roulette only
};

}  // namespace lumivec
