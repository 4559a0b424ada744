#include "loader/gltf/materials.h"

#include <algorithm>
#include <cmath>

#include "loader/gltf/extensions.h"

namespace lumivec::gltf {
namespace {

// Radiances up to this keep their products with other factors finite; the sun's disk has 1.6e9.
constexpr float largest_radiance = 1e20f;

// A transmittance of exactly 0 would absorb infinitely strongly.
constexpr float smallest_attenuation = 1e-6f;

class MaterialReader {
 public:
  MaterialReader(Context& context, const Document& document, std::size_t index)
      : context_(context),
        textures_(context, document),
        source_(document.model.materials[index]),
        where_(pointer({"materials", index})) {}

  Material read() {
    base();
    if (find("KHR_materials_unlit")) {
      material_.unlit = true;
      return material_;
    }
    surface();
    emission();
    dielectric();
    transmission();
    clearcoat();
    return material_;
  }

 private:
  const tinygltf::Value* find(const std::string& name) const {
    return find_extension(source_.extensions, name);
  }

  float clamped(double x, double low, double high, const char* name) {
    if (x < low || x > high) {
      context_.warn(
          where_, std::string(name) + " of " + std::to_string(x) + " is out of range and clamped");
    }
    return to_float(std::clamp(x, low, high));
  }

  float unit(double x, const char* name) { return clamped(x, 0.0, 1.0, name); }

  Color color(const Color& c, float low, float high, const char* name) {
    Color result;
    for (int i = 0; i < 3; ++i) result[i] = clamped(c[i], low, high, name);
    return result;
  }

  TextureMap map(const tinygltf::Value& extension, const char* name,
                 Encoding encoding = Encoding::linear) {
    return textures_.map(extension, name, encoding, where_);
  }

  void base() {
    const auto& pbr = source_.pbrMetallicRoughness;
    const auto& factor = pbr.baseColorFactor;
    material_.name = source_.name;
    for (int i = 0; i < 3; ++i) {
      material_.base_color[i] = unit(factor[static_cast<std::size_t>(i)], "baseColorFactor");
    }
    material_.opacity = unit(factor[3], "baseColorFactor");
    material_.base_color_map =
        textures_.map(pbr.baseColorTexture, Encoding::srgb, where_ + "/baseColorTexture");
    material_.double_sided = source_.doubleSided;
    if (source_.alphaMode == "MASK") {
      material_.alpha_mode = AlphaMode::mask;
    } else if (source_.alphaMode == "BLEND") {
      material_.alpha_mode = AlphaMode::blend;
    } else if (source_.alphaMode != "OPAQUE") {
      context_.warn(where_,
                    "alphaMode " + printable(source_.alphaMode) + " is unknown, taken as OPAQUE");
    }
    material_.alpha_cutoff = to_float(source_.alphaCutoff);
  }

  void surface() {
    const auto& pbr = source_.pbrMetallicRoughness;
    material_.metallic = unit(pbr.metallicFactor, "metallicFactor");
    material_.roughness = unit(pbr.roughnessFactor, "roughnessFactor");
    material_.metallic_roughness_map = textures_.map(pbr.metallicRoughnessTexture, Encoding::linear,
                                                     where_ + "/metallicRoughnessTexture");
    material_.normal_map =
        textures_.map(source_.normalTexture, Encoding::linear, where_ + "/normalTexture");
    material_.normal_scale = to_float(source_.normalTexture.scale);
  }

  void emission() {
    double strength = 1.0;
    if (const auto* extension = find("KHR_materials_emissive_strength")) {
      strength = number_or(*extension, "emissiveStrength", strength);
    }
    for (int i = 0; i < 3; ++i) {
      material_.emission[i] =
          clamped(source_.emissiveFactor[static_cast<std::size_t>(i)] * strength, 0.0,
                  largest_radiance, "emission");
    }
    material_.emission_map =
        textures_.map(source_.emissiveTexture, Encoding::srgb, where_ + "/emissiveTexture");
  }

  void dielectric() {
    if (const auto* extension = find("KHR_materials_ior")) {
      const double ior = number_or(*extension, "ior", material_.ior);
      constexpr double highest = 100.0;  // far above any substance; F0 is 0.96
      if (ior != 0.0)
        material_.ior = clamped(ior, 1.0, highest, "ior");
      else
        material_.ior = 0.0f;
    }
    if (const auto* extension = find("KHR_materials_specular")) {
      constexpr float brightest = 1e6f;  // F0 saturates at 1 long before
      material_.specular = unit(number_or(*extension, "specularFactor", 1.0), "specularFactor");
      material_.specular_map = map(*extension, "specularTexture");
      material_.specular_color = color(color_or(*extension, "specularColorFactor", Color(1.0f)),
                                       0.0f, brightest, "specularColorFactor");
      material_.specular_color_map = map(*extension, "specularColorTexture", Encoding::srgb);
    }
  }

  void transmission() {
    if (const auto* extension = find("KHR_materials_transmission")) {
      material_.transmission =
          unit(number_or(*extension, "transmissionFactor", 0.0), "transmissionFactor");
      material_.transmission_map = map(*extension, "transmissionTexture");
    }
    // The thickness itself is for renderers that do not know where the other side is.
    const auto* volume = find("KHR_materials_volume");
    if (!volume || number_or(*volume, "thicknessFactor", 0.0) <= 0.0) return;
    material_.thin_walled = false;
    if (volume->Has("attenuationDistance")) {
      const float distance = to_float(number_or(*volume, "attenuationDistance", 0.0));
      if (distance > 0.0f) {
        material_.attenuation_distance = distance;
      } else {
        context_.warn(where_, "attenuationDistance is not positive and left out");
      }
    }
    material_.attenuation_color =
        color(color_or(*volume, "attenuationColor", Color(1.0f)), 0.0f, 1.0f, "attenuationColor");
    for (int i = 0; i < 3; ++i) {
      material_.attenuation_color[i] =
          std::max(material_.attenuation_color[i], smallest_attenuation);
    }
  }

  void clearcoat() {
    const auto* coat = find("KHR_materials_clearcoat");
    if (!coat) return;
    material_.clearcoat = unit(number_or(*coat, "clearcoatFactor", 0.0), "clearcoatFactor");
    material_.clearcoat_map = map(*coat, "clearcoatTexture");
    material_.clearcoat_roughness =
        unit(number_or(*coat, "clearcoatRoughnessFactor", 0.0), "clearcoatRoughnessFactor");
    material_.clearcoat_roughness_map = map(*coat, "clearcoatRoughnessTexture");
    material_.clearcoat_normal_map = map(*coat, "clearcoatNormalTexture");
    if (coat->Has("clearcoatNormalTexture")) {
      material_.clearcoat_normal_scale =
          to_float(number_or(coat->Get("clearcoatNormalTexture"), "scale", 1.0));
    }
  }

  Context& context_;
  Textures textures_;
  const tinygltf::Material& source_;
  const std::string where_;
  Material material_;
};

// What glTF says of a primitive without a material: a white metal, as rough as can be.
Material default_material() {
  Material material;
  material.metallic = 1.0f;
  return material;
}

}  // namespace

Materials::Materials(Context& context, const Document& document, Scene& scene)
    : context_(context),
      document_(document),
      scene_(scene),
      used_(document.model.materials.size() + 1, -1) {}

int Materials::use(int material) {
  const std::size_t index = material >= 0 ? static_cast<std::size_t>(material) : used_.size() - 1;
  if (used_[index] < 0) {
    used_[index] = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(material >= 0 ? MaterialReader(context_, document_, index).read()
                                             : default_material());
  }
  return used_[index];
}

}  // namespace lumivec::gltf
