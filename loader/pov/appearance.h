// How surfaces look, as a scene says it: pigments, normals, finishes, textures, interiors. Colors
// are as written, in the gamma that GlobalSettings::assumed_gamma says.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "loader/pov/keywords.h"
#include "loader/pov/measure.h"
#include "loader/pov/token.h"
#include "loader/scene.h"

namespace lumivec::pov {

struct Function;
struct Object;
struct Pigment;

struct ColorFT {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double filter = 0.0;    // share of light that passes, tinted
  double transmit = 0.0;  // share of light that passes unchanged
};

// What happens to a point before a pattern sees it, in the order of the scene.
struct PatternStep {
  enum class Kind : std::uint8_t { transform, turbulence, warp };
  Kind kind = Kind::transform;
  M44d transform;       // of the pattern; points take the inverse
  V3d turbulence{0.0};  // strength along each axis
  double octaves = 6.0;
  double omega = 0.5;
  double lambda = 2.0;
  K warp =
      K::repeat_;  // repeat, black_hole, turbulence, cylindrical, spherical, toroidal, planar, cube
  std::vector<V3d> vectors;                // of the warp, in the order of the scene
  std::vector<std::pair<K, V3d>> options;  // of the warp: offset, flip, strength and the like
};

struct MapPicture;

struct ImageUse {
  std::string file;
  std::uint32_t named_in = 0;  // the source that names it
  K format = K::png_;
  int map_type = 0;
  bool once = false;
  int interpolate = 0;
  double gamma = 0.0;  // 0: the file's own
  bool use_index = false;
  std::vector<std::pair<int, double>> filter;    // by palette index, -1: all
  std::vector<std::pair<int, double>> transmit;  // likewise
  std::shared_ptr<const MapPicture> picture;     // of image maps (image_maps.h); null: none
};

// A number, mostly in [0, 1], for each point of space.
struct Pattern {
  K kind = K::keyword_count;  // its keyword; keyword_count: none
  Place place;
  V3d vector{0.0};                               // gradient, slope and the like
  std::vector<double> numbers;                   // of the kind, in the order of the scene
  std::vector<std::pair<K, double>> parameters;  // form, metric, exponent and the like
  K wave = K::ramp_wave_;
  double wave_exponent = 1.0;
  double frequency = 1.0;
  double phase = 0.0;
  int noise_generator = 0;                 // 0: the scene's
  std::shared_ptr<const Pigment> pigment;  // pigment_pattern
  std::shared_ptr<const Object> object;
  std::shared_ptr<const Function> function;
  std::shared_ptr<const ImageUse> image;
  std::vector<PatternStep> steps;
  Measure measure;
};

using ColorMap = std::vector<std::pair<double, ColorFT>>;

struct Pigment {
  ColorFT color;      // where nothing else says
  bool black = true;  // nothing was said
  Pattern pattern;
  ColorMap color_map;
  std::vector<std::pair<double, std::shared_ptr<const Pigment>>> pigment_map;
  std::vector<ColorFT> colors;                           // of checker, brick, hexagon, object
  std::vector<std::shared_ptr<const Pigment>> pigments;  // likewise
  std::shared_ptr<const ImageUse> image;
  bool uv_mapping = false;
  Measure measure;
};

struct Normal {
  Pattern pattern;
  double amount = 0.5;
  double bump_size = 1.0;
  double accuracy = 0.02;
  std::vector<std::pair<double, std::shared_ptr<const Normal>>> normal_map;
  std::vector<std::pair<double, std::array<double, 2>>> slope_map;
  std::vector<std::shared_ptr<const Normal>> normals;  // of checker, brick, hexagon
  std::shared_ptr<const ImageUse> image;
  bool uv_mapping = false;
  bool no_bump_scale = false;
  Measure measure;
};

struct Finish {
  std::array<double, 3> ambient{0.1, 0.1, 0.1};
  std::array<double, 3> emission{0.0, 0.0, 0.0};
  double diffuse = 0.6;
  double diffuse_back = 0.0;
  bool diffuse_albedo = false;
  double brilliance = 1.0;
  double crand = 0.0;
  double phong = 0.0;
  bool phong_albedo = false;
  double phong_size = 40.0;
  double specular = 0.0;
  bool specular_albedo = false;
  double roughness = 0.05;
  double metallic = 0.0;
  std::array<double, 3> reflection_min{0.0, 0.0, 0.0};
  std::array<double, 3> reflection_max{0.0, 0.0, 0.0};
  bool fresnel = false;
  double reflection_falloff = 1.0;
  double reflection_exponent = 1.0;
  double reflection_metallic = 0.0;
  bool conserve_energy = false;
  double irid = 0.0;
  bool subsurface = false;
  bool use_alpha = false;
  double ior = 0.0;            // of scenes before version 3.1; 0: not given
  double refraction = 0.0;     // likewise
  double caustics = 0.0;       // likewise
  double fade_distance = 0.0;  // likewise
  double fade_power = 0.0;     // likewise
};

struct TextureLayer {
  Pigment pigment;
  Normal normal;
  bool has_normal = false;
  Finish finish;
  // Of textures that choose among others by a pattern; then the above says nothing.
  Pattern pattern;
  std::vector<std::pair<double, std::shared_ptr<const struct Texture>>> textures;
  M44d transform;  // of the layer, after the transforms of its parts
  Place place;
};

// Layers, the lowest first.
struct Texture {
  std::vector<TextureLayer> layers;
  bool uv_mapping = false;
  Measure measure;
};

struct Media {
  std::array<double, 3> absorption{};
  std::array<double, 3> emission{};
  std::array<double, 3> scattering{};
  int scattering_type = 0;
  Place place;
};

struct Interior {
  double ior = 1.0;
  double caustics = 0.0;
  double dispersion = 1.0;
  double fade_distance = 0.0;
  double fade_power = 0.0;
  std::array<double, 3> fade_color{0.0, 0.0, 0.0};
  std::vector<Media> media;
};

struct MaterialBlock {
  std::shared_ptr<const Texture> texture;
  std::shared_ptr<const Texture> interior_texture;
  std::shared_ptr<const Interior> interior;
};

}  // namespace lumivec::pov
