#include "loader/pov/surfaces.h"

#include <algorithm>
#include <cmath>

#include "loader/pov/pattern_values.h"

namespace lumivec::pov {
namespace {

using Rgb = std::array<double, 3>;

double mean(const Rgb& c) {
  return (c[0] + c[1] + c[2]) / 3.0;
}

ColorFT average(const Pigment& pigment, const Imath::Box3d& bounds, SurfaceNotes& notes) {
  if (pigment.pattern.kind == K::keyword_count && !pigment.image) return pigment.color;
  notes.averaged = true;
  constexpr int steps = 5;  // along each axis, away from the edges
  ColorFT sum;
  bool approximate = false;
  constexpr double weight = 1.0 / (steps * steps * steps);
  const bool known = !bounds.isEmpty();
  constexpr double farthest = 100.0;  // of infinite shapes a part is as good as all
  for (int i = 0; i < steps * steps * steps; ++i) {
    const int at[3] = {i % steps, i / steps % steps, i / (steps * steps)};
    V3d p;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = known ? std::max(bounds.min[axis], -farthest) : 0.0;
      const double high = known ? std::min(bounds.max[axis], farthest) : 1.0;
      p[axis] = low + (high - low) * (at[axis] + 0.37) / steps;
    }
    const ColorFT c = pigment_color(pigment, p, approximate);
    sum = {sum.red + weight * c.red, sum.green + weight * c.green, sum.blue + weight * c.blue,
           sum.filter + weight * c.filter, sum.transmit + weight * c.transmit};
  }
  return sum;
}

// The topmost layer that lets nothing through, or else the topmost of all; of textures that a
// pattern chooses, the first.
const TextureLayer& shown_layer(const Texture& texture, SurfaceNotes& notes) {
  const TextureLayer* layer = &texture.layers.back();
  if (texture.layers.size() > 1) notes.layers = true;
  for (auto it = texture.layers.rbegin(); it != texture.layers.rend(); ++it) {
    const ColorFT& c = it->pigment.color;
    if (it->pigment.pattern.kind == K::keyword_count && c.filter + c.transmit > 0.5) continue;
    layer = &*it;
    break;
  }
  for (int depth = 0; depth < 8 && !layer->textures.empty(); ++depth) {
    const auto& inner = layer->textures.front().second;
    if (!inner || inner->layers.empty()) break;
    notes.averaged = true;
    layer = &inner->layers.back();
  }
  return *layer;
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

Material surface_of(const Texture& texture, const Interior* interior, const SurfaceChoice& choice,
                    SurfaceNotes& notes) {
  Material material;
  material.double_sided = true;
  material.specular = 0.0f;
  material.roughness = 1.0f;
  if (texture.layers.empty()) return material;
  const TextureLayer& layer = shown_layer(texture, notes);
  const Finish& finish = layer.finish;
  const ColorFT color = average(layer.pigment, choice.bounds, notes);
  const Color c = linear_color(color.red, color.green, color.blue, choice.gamma);
  const Rgb linear = {c.x, c.y, c.z};
  Rgb diffuse{};
  for (std::size_t i = 0; i < 3; ++i) diffuse[i] = std::clamp(linear[i] * finish.diffuse, 0.0, 1.0);
  material.base_color = Color(static_cast<float>(diffuse[0]), static_cast<float>(diffuse[1]),
                              static_cast<float>(diffuse[2]));
  set_gloss(finish, material);
  if (mean(finish.reflection_max) > 0.0)
    set_reflection(finish, linear, interior, material, choice.gamma);
  if (color.filter + color.transmit > 0.0)
    set_transmission(color, linear, finish, interior, material, choice.gamma);
  // Surfaces that only glow are lamps or screens; elsewhere ambient stands for what light passes
  // on.
  const bool glows = choice.lamp || finish.diffuse == 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double shine = finish.emission[k] + (glows ? finish.ambient[k] : 0.0);
    material.emission[i] = static_cast<float>(std::max(shine, 0.0) * linear[k]);
  }
  notes.ambient |= !glows && mean(finish.ambient) > 0.0;
  notes.bumps |= layer.has_normal;
  notes.metallic |= finish.metallic > 0.0 && std::max(finish.phong, finish.specular) > 0.0;
  notes.brilliance |= finish.brilliance != 1.0;
  return material;
}

}  // namespace lumivec::pov
