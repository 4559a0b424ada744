#include "loader/pov/surfaces.h"

#include <algorithm>
#include <cmath>

#include "loader/pov/bumps.h"
#include "loader/pov/pattern_values.h"

namespace lumivec::pov {
namespace {

using Rgb = std::array<double, 3>;

double mean(const Rgb& c) {
  return (c[0] + c[1] + c[2]) / 3.0;
}

// A place in a texture's space, as pattern_values.h has it.
struct TexturePoint {
  V3d at{0.0};
  V3d spread{0.0};
};

TexturePoint moved(const TexturePoint& p, const M44d& transform) {
  if (transform == M44d()) return p;
  const M44d inverse = transform.inverse();
  TexturePoint inside{p.at * inverse, V3d(0.0)};
  inverse.multDirMatrix(p.spread, inside.spread);
  return inside;
}

// The roughness of a gloss whose lobe is as wide as that of an exponent of Phong or Blinn.
float roughness_of(double exponent) {
  const double alpha = std::sqrt(2.0 / (std::max(exponent, 0.0) + 2.0));
  return static_cast<float>(std::clamp(std::sqrt(alpha), 0.0, 1.0));
}

void set_gloss(const Finish& finish, Material& material) {
  const double strength = std::max(finish.phong, finish.specular);
  material.specular = static_cast<float>(std::clamp(strength, 0.0, 1.0));
  if (finish.specular > 0.0 && finish.specular >= finish.phong) {
    material.roughness = roughness_of(1.0 / std::max(finish.roughness, 1e-6));
  } else if (finish.phong > 0.0) {
    material.roughness = roughness_of(finish.phong_size);
  }
}

// A reflectance that is the same from all sides, over a diffuse surface that gets the rest.
void set_reflection(const Finish& finish, const Rgb& pigment, const Interior* interior,
                    Material& material, double gamma) {
  material.roughness = 0.0f;
  if (finish.fresnel || mean(finish.reflection_max) > 2.0 * mean(finish.reflection_min)) {
    material.specular = 1.0f;
    if (interior && interior->ior > 1.0) material.ior = static_cast<float>(interior->ior);
    return;
  }
  Rgb mirror{};
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double tint = 1.0 - finish.reflection_metallic * (1.0 - pigment[i]);
    mirror[i] =
        std::clamp(std::pow(std::max(finish.reflection_max[i], 0.0), gamma) * tint, 0.0, 1.0);
    most = std::max(most, mirror[i]);
  }
  if (most <= 0.0) return;
  material.ior = 0.0f;  // all of what specular says
  material.specular = static_cast<float>(most);
  const double rest = std::max(1.0 - most, 1e-3);
  for (int i = 0; i < 3; ++i) {
    material.specular_color[i] = static_cast<float>(mirror[static_cast<std::size_t>(i)] / most);
    material.base_color[i] = static_cast<float>(std::min(material.base_color[i] / rest, 1.0));
  }
}

void set_absorption(const Interior& interior, Material& material, double gamma) {
  if (interior.fade_power <= 0.0 || interior.fade_distance <= 0.0) return;
  constexpr double exponential = 1000.0;  // fade_power from which on light decays exponentially
  const double left = interior.fade_power >= exponential ? std::exp(-1.0) : 0.5;
  material.attenuation_distance = static_cast<float>(interior.fade_distance);
  for (int i = 0; i < 3; ++i) {
    const double color =
        std::pow(std::max(interior.fade_color[static_cast<std::size_t>(i)], 0.0), gamma);
    material.attenuation_color[i] =
        static_cast<float>(std::clamp(left + (1.0 - left) * color, 1e-4, 1.0));
  }
}

void set_transmission(const ColorFT& color, const Rgb& linear, const Finish& finish,
                      const Interior* interior, Material& material, double gamma) {
  const double filter = std::max(color.filter, 0.0), transmit = std::max(color.transmit, 0.0);
  const double through = std::min(filter + transmit, 1.0);
  if (through <= 0.0) return;
  double ior = interior ? interior->ior : 1.0;
  if (!interior && finish.refraction > 0.0 && finish.ior > 0.0) ior = finish.ior;
  material.transmission = static_cast<float>(through);
  Rgb tint{};
  for (std::size_t i = 0; i < 3; ++i) {
    tint[i] = std::clamp((filter * linear[i] + transmit) / (filter + transmit), 0.0, 1.0);
    const double reflected = linear[i] * finish.diffuse;
    const double value = through * tint[i] + (1.0 - through) * reflected;
    material.base_color[static_cast<int>(i)] = static_cast<float>(std::clamp(value, 0.0, 1.0));
  }
  constexpr double bends = 1.001;
  material.thin_walled = ior < bends;
  material.ior = static_cast<float>(std::max(ior, 1.0));
  material.roughness = 0.0f;
  material.double_sided = material.thin_walled;
  if (!material.thin_walled) material.specular = 1.0f;
  if (interior && !material.thin_walled) set_absorption(*interior, material, gamma);
}

}  // namespace

Color linear_color(double red, double green, double blue, double gamma) {
  const auto linear = [&](double x) {
    return static_cast<float>(std::pow(std::max(x, 0.0), gamma));
  };
  return {linear(red), linear(green), linear(blue)};
}

namespace {

// What all points of a texture share.
struct Setting {
  const Interior* interior = nullptr;
  double gamma = 1.0;
  bool lamp = false;
};

Material dull_surface() {
  Material material;
  material.double_sided = true;
  material.specular = 0.0f;
  material.roughness = 1.0f;
  return material;
}

Material plain_surface(const ColorFT& color, const Finish& finish, const Setting& setting,
                       SurfaceNotes& notes) {
  Material material = dull_surface();
  const Color c = linear_color(color.red, color.green, color.blue, setting.gamma);
  const Rgb linear = {c.x, c.y, c.z};
  Rgb diffuse{};
  for (std::size_t i = 0; i < 3; ++i) diffuse[i] = std::clamp(linear[i] * finish.diffuse, 0.0, 1.0);
  material.base_color = Color(static_cast<float>(diffuse[0]), static_cast<float>(diffuse[1]),
                              static_cast<float>(diffuse[2]));
  set_gloss(finish, material);
  if (mean(finish.reflection_max) > 0.0)
    set_reflection(finish, linear, setting.interior, material, setting.gamma);
  if (color.filter + color.transmit > 0.0)
    set_transmission(color, linear, finish, setting.interior, material, setting.gamma);
  // Surfaces that only glow are lamps or screens; elsewhere ambient stands for what light passes
  // on.
  const bool glows = setting.lamp || finish.diffuse == 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double shine = finish.emission[k] + (glows ? finish.ambient[k] : 0.0);
    material.emission[i] = static_cast<float>(std::max(shine, 0.0) * linear[k]);
  }
  notes.ambient |= !glows && mean(finish.ambient) > 0.0;
  notes.metallic |= finish.metallic > 0.0 && std::max(finish.phong, finish.specular) > 0.0;
  notes.brilliance |= finish.brilliance != 1.0;
  return material;
}

// The share of light that a mirror or gloss reflects head-on.
float reflectance(const Material& m) {
  if (m.ior == 0.0f) return m.specular;
  const float r = (m.ior - 1.0f) / (m.ior + 1.0f);
  return m.specular * r * r;
}

// Takes over the kind of reflection that surface has, in shares of the whole.
void take_reflection(Material& material, const Material& surface) {
  material.specular = surface.specular;
  material.specular_color = surface.specular_color;
  material.roughness = surface.roughness;
  material.ior = surface.ior;
  material.thin_walled = surface.thin_walled;
}

Material between(const Material& a, const Material& b, float share) {
  Material m = reflectance(a) * (1.0f - share) >= reflectance(b) * share ? a : b;
  const auto mix = [share](const auto& x, const auto& y) { return x + (y - x) * share; };
  m.base_color = mix(a.base_color, b.base_color);
  m.emission = mix(a.emission, b.emission);
  m.transmission = mix(a.transmission, b.transmission);
  m.thin_walled = a.thin_walled && b.thin_walled;
  m.double_sided = a.double_sided && b.double_sided;
  const Material& clearer = b.transmission > a.transmission ? b : a;
  m.attenuation_distance = clearer.attenuation_distance;
  m.attenuation_color = clearer.attenuation_color;
  if (a.ior == b.ior) {
    m.specular = mix(a.specular, b.specular);
    m.roughness = mix(a.roughness, b.roughness);
    m.specular_color = mix(a.specular_color, b.specular_color);
  }
  return m;
}

Material surface_at(const Texture& texture, const TexturePoint& p, const Setting& setting,
                    SurfaceNotes& notes);

// Of textures that a pattern chooses from.
Material chosen_surface(const TextureLayer& layer, const TexturePoint& p, const Setting& setting,
                        SurfaceNotes& notes) {
  const auto surface = [&](std::size_t i) {
    const auto& texture = layer.textures[std::min(i, layer.textures.size() - 1)].second;
    return texture ? surface_at(*texture, p, setting, notes) : dull_surface();
  };
  const auto value = pattern_value(layer.pattern, p.at, p.spread);
  if (!value) {
    notes.averaged = true;
    return surface(0);
  }
  if (chooses(layer.pattern)) return surface(static_cast<std::size_t>(*value));
  const auto [i, share] = place_in(layer.textures, *value);
  if (share == 0.0) return surface(i);
  return between(surface(i), surface(i + 1), static_cast<float>(share));
}

ColorFT layer_color(const TextureLayer& layer, const TexturePoint& p, SurfaceNotes& notes) {
  return pigment_color(layer.pigment, p.at, notes.averaged, p.spread);
}

// Lays surface on top of material: cover is its share that lets nothing through, passed what of
// each color reaches what lies below.
void lay_on(Material& material, const Material& surface, float cover, const Color& passed) {
  material.base_color = surface.base_color * cover + material.base_color * passed;
  material.emission = surface.emission * cover + material.emission * passed;
  material.transmission *= 1.0f - cover;
  if (reflectance(surface) * cover > reflectance(material) * (1.0f - cover)) {
    take_reflection(material, surface);
    material.specular *= cover;
  }
}

Material surface_at(const Texture& texture, const TexturePoint& p, const Setting& setting,
                    SurfaceNotes& notes) {
  Material material = dull_surface();
  bool lowest = true;
  for (const TextureLayer& layer : texture.layers) {
    const TexturePoint inside = moved(p, layer.transform);
    if (!layer.textures.empty()) {
      const Material chosen = chosen_surface(layer, inside, setting, notes);
      if (lowest) {
        material = chosen;
      } else {
        lay_on(material, chosen, 1.0f - chosen.transmission,
               chosen.base_color * chosen.transmission);
      }
      lowest = false;
      continue;
    }
    ColorFT color = layer_color(layer, inside, notes);
    if (lowest) {
      material = plain_surface(color, layer.finish, setting, notes);
      lowest = false;
      continue;
    }
    const double filter = std::clamp(color.filter, 0.0, 1.0);
    const double transmit = std::clamp(color.transmit, 0.0, 1.0 - filter);
    const Color linear = linear_color(color.red, color.green, color.blue, setting.gamma);
    const Color passed = linear * static_cast<float>(filter) + Color(static_cast<float>(transmit));
    color.filter = color.transmit = 0.0;
    lay_on(material, plain_surface(color, layer.finish, setting, notes),
           static_cast<float>(1.0 - filter - transmit), passed);
  }
  return material;
}

class TexturePattern final : public SurfacePattern {
 public:
  TexturePattern(std::shared_ptr<const Texture> texture, std::shared_ptr<const Interior> interior,
                 const SurfaceChoice& choice, const Material& mean)
      : texture_(std::move(texture)),
        interior_(std::move(interior)),
        setting_{interior_.get(), choice.gamma, choice.lamp},
        world_to_texture_(choice.world_to_texture),
        normal_to_texture_(choice.world_to_texture.inverse().transposed()),
        normal_to_world_(choice.world_to_texture.transposed()),
        bumps_(has_bumps(*texture_)),
        mirrors_(mean.ior == 0.0f) {}

  PatternedSurface at(const V3d& point, const V3d& normal, double error) const noexcept override {
    TexturePoint p{point * world_to_texture_, V3d(0.0)};
    world_to_texture_.multDirMatrix(normal * error, p.spread);
    SurfaceNotes notes;
    const Material m = surface_at(*texture_, p, setting_, notes);
    PatternedSurface surface;
    surface.base_color = finite(m.base_color);
    surface.emission = finite(m.emission);
    surface.specular_color = finite(m.specular_color);
    surface.roughness = m.roughness;
    surface.transmission = m.transmission;
    // The index of refraction is the material's: where that mirrors, gloss is a faint mirror.
    surface.specular = mirrors_ ? reflectance(m) : m.specular;
    return surface;
  }

  V3d bent(const V3d& point, const V3d& normal) const noexcept override {
    if (!bumps_) return normal;
    V3d inside, outside;
    normal_to_texture_.multDirMatrix(normal, inside);
    bool approximate = false;
    normal_to_world_.multDirMatrix(
        bent_normal(*texture_, point * world_to_texture_, inside, approximate), outside);
    const double length = outside.length();
    return length > 0.0 && std::isfinite(length) ? outside / length : normal;
  }

 private:
  static Color finite(const Color& c) {
    static constexpr float most = 1e30f;
    const auto bounded = [](float x) { return x > 0.0f ? std::min(x, most) : 0.0f; };
    return {bounded(c.x), bounded(c.y), bounded(c.z)};
  }

  std::shared_ptr<const Texture> texture_;
  std::shared_ptr<const Interior> interior_;
  Setting setting_;
  M44d world_to_texture_;
  M44d normal_to_texture_, normal_to_world_;  // of planes
  bool bumps_;
  bool mirrors_;
};

// What all the points say together.
Material mean_surface(const Texture& texture, const Setting& setting, const SurfaceChoice& choice,
                      SurfaceNotes& notes) {
  constexpr int points = 128;
  // Points of the R3 sequence, which do not fall into step with the cells of a pattern.
  constexpr double step[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  constexpr double farthest = 100.0;  // of infinite shapes a part is as good as all
  const bool known = !choice.bounds.isEmpty(), bumps = has_bumps(texture);
  Material sum;
  for (int i = 0; i < points; ++i) {
    V3d p;
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = known ? choice.bounds.center()[axis] : 0.5;
      const double half = known ? std::min(choice.bounds.size()[axis] / 2.0, farthest) : 0.5;
      const double turns = 0.5 + step[axis] * (i + 1);
      p[axis] = middle + half * (2.0 * (turns - std::floor(turns)) - 1.0);
    }
    const V3d at = p * choice.world_to_texture;
    const Material m = surface_at(texture, {at, V3d(0.0)}, setting, notes);
    if (bumps) bent_normal(texture, at, V3d(0.0, 1.0, 0.0), notes.bumps);
    sum = i == 0 ? m : between(sum, m, 1.0f / static_cast<float>(i + 1));
  }
  return sum;
}

}  // namespace

bool varies(const Texture& texture) {
  return has_bumps(texture) ||
         std::any_of(texture.layers.begin(), texture.layers.end(), [](const TextureLayer& layer) {
           return !layer.textures.empty() || layer.pigment.image ||
                  layer.pigment.pattern.kind != K::keyword_count;
         });
}

Material surface_of(const Texture& texture, const Interior* interior, const SurfaceChoice& choice,
                    SurfaceNotes& notes) {
  const Setting setting{interior, choice.gamma, choice.lamp};
  if (varies(texture)) return mean_surface(texture, setting, choice, notes);
  return surface_at(texture, {}, setting, notes);
}

std::shared_ptr<const SurfacePattern> pattern_of(std::shared_ptr<const Texture> texture,
                                                 std::shared_ptr<const Interior> interior,
                                                 const SurfaceChoice& choice,
                                                 const Material& mean) {
  return std::make_shared<const TexturePattern>(std::move(texture), std::move(interior), choice,
                                                mean);
}

}  // namespace lumivec::pov
