// A scene as the language describes it: everything that was said, nothing lost, in left-handed
// coordinates and the units of the scene.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "loader/pov/shapes.h"

namespace lumivec::pov {

enum class LightShape : std::uint8_t { point, spotlight, cylinder };

struct AreaLight {
  V3d axis1{0.0};
  V3d axis2{0.0};
  int count1 = 1;
  int count2 = 1;
  bool circular = false;
  bool orient = false;
};

struct LightSource {
  V3d location{0.0};
  ColorFT color;
  LightShape shape = LightShape::point;
  bool parallel = false;
  V3d point_at{0.0, 0.0, 1.0};
  double radius = 30.0;   // degrees; scene units for cylinder
  double falloff = 45.0;  // likewise
  double tightness = 0.0;
  std::optional<AreaLight> area;
  double fade_distance = 0.0;
  double fade_power = 0.0;  // 0: the light does not fade
  bool shadowless = false;
  std::shared_ptr<const Object> looks_like;
  std::shared_ptr<const Object> projected_through;
};

// What objects seldom have.
struct ObjectExtras {
  std::vector<std::shared_ptr<const Object>> clipped_by;
  std::vector<std::shared_ptr<const Object>> bounded_by;
  bool clipped_by_bounds = false;
  std::shared_ptr<const Texture> interior_texture;
};

struct Object {
  Shape shape;
  Place place;
  std::shared_ptr<const Texture> texture;  // null: that of the object around, or the default
  std::shared_ptr<const Interior> interior;
  std::shared_ptr<const M44d> transform;          // to the space around; null: none
  std::shared_ptr<const M44d> texture_transform;  // of the texture, since it was given; null: none
  std::shared_ptr<const ObjectExtras> extras;
  Measure measure;
  bool inverse = false;
  bool hollow = false;
  bool no_shadow = false;
  bool no_image = false;
  bool no_reflection = false;
  bool no_radiosity = false;
  bool double_illuminate = false;
  bool uv_mapping = false;
};

enum class CameraType : std::uint8_t {
  perspective,
  orthographic,
  fisheye,
  ultra_wide_angle,
  omnimax,
  panoramic,
  spherical,
  cylinder
};

struct PovCamera {
  CameraType type = CameraType::perspective;
  int cylinder_type = 1;
  V3d location{0.0};
  V3d direction{0.0, 0.0, 1.0};
  V3d right{1.33, 0.0, 0.0};
  V3d up{0.0, 1.0, 0.0};
  V3d sky{0.0, 1.0, 0.0};
  double angle = 0.0;  // degrees; 0: not given
  double vertical_angle = 0.0;
  double aperture = 0.0;  // focal blur; 0: none
  V3d focal_point{0.0};
  Place place;
};

struct SkySphere {
  std::vector<Pigment> pigments;
  double emission = 1.0;
  std::vector<PatternStep> steps;
  Place place;
};

struct RadiositySettings {
  bool on = false;
  std::vector<std::pair<K, double>> settings;  // as written
};

struct PhotonSettings {
  bool on = false;
  double spacing = 0.0;
  double count = 0.0;
  std::vector<std::pair<K, double>> settings;
};

struct GlobalSettings {
  double assumed_gamma = 1.0;
  bool has_assumed_gamma = false;
  std::array<double, 3> ambient_light{1.0, 1.0, 1.0};
  double max_trace_level = 5.0;
  int noise_generator = 2;
  double mm_per_unit = 10.0;
  RadiositySettings radiosity;
  PhotonSettings photons;
};

// A feature that was said and that a picture may miss.
struct Mention {
  Place place;
  std::string what;
};

struct PovScene {
  double version = 3.7;
  GlobalSettings settings;
  std::vector<std::shared_ptr<const Object>> objects;  // light sources too
  std::optional<PovCamera> camera;
  std::optional<ColorFT> background;
  std::optional<SkySphere> sky_sphere;
  std::shared_ptr<const Texture> default_texture;
  std::vector<Mention> mentions;
  std::string debug_text;  // what #debug says, up to a bound
};

}  // namespace lumivec::pov
