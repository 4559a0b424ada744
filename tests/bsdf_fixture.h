// What the BSDF tests share: random numbers, tables, and the materials that stand for every lobe
// and combination.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "integrator/bsdf.h"
#include "integrator/sampling.h"

namespace lumivec {

const V3f up(0.0f, 0.0f, 1.0f);

// [0, 1), the same numbers with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float operator()() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
  V2f pair() {
    const float x = (*this)();
    return {x, (*this)()};
  }
  V3f direction() {  // uniform on the sphere
    const float z = 2.0f * (*this)() - 1.0f;
    const float phi = 2.0f * pi * (*this)();
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return V3f(r * std::cos(phi), r * std::sin(phi), z).normalized();
  }

 private:
  std::mt19937 engine_;
};

inline const AlbedoTables& test_tables() {
  static const std::vector<float> indices = {1.0f, 1.33f, 1.5f, 2.42f};
  static const AlbedoTables tables(indices);
  return tables;
}

// A direction above the surface with that cosine.
inline V3f at_cosine(float cos_theta, float phi = 0.3f) {
  const float r = std::sqrt(std::max(0.0f, 1.0f - cos_theta * cos_theta));
  return {r * std::cos(phi), r * std::sin(phi), cos_theta};
}

inline SurfaceParameters surface(float roughness) {
  SurfaceParameters p;
  p.normal = p.coat_normal = up;
  p.roughness = roughness;
  return p;
}

inline Bsdf make_bsdf(const SurfaceParameters& p, const V3f& wo, float specular_roughness = 0.15f,
                      Transport transport = Transport::importance) {
  return {p, wo.z >= 0.0f ? up : -up, wo, test_tables(), specular_roughness, transport};
}

// The same surface met from below: normals turn over, and a boundary's index inverts.
inline SurfaceParameters from_below(SurfaceParameters p) {
  p.normal = -p.normal;
  p.coat_normal = -p.coat_normal;
  if (!p.thin_walled && p.eta > 0.0f) p.eta = 1.0f / p.eta;
  return p;
}

struct NamedSurface {
  std::string name;
  SurfaceParameters surface;
};

// White materials without absorption, each with the given roughness of its base.
inline std::vector<NamedSurface> white_surfaces(float roughness) {
  std::vector<NamedSurface> all;
  const auto add = [&](const char* name, auto&& change) {
    SurfaceParameters p = surface(roughness);
    change(p);
    all.push_back({std::string(name) + ", roughness " + std::to_string(roughness), p});
  };
  const auto glass = [](SurfaceParameters& p, float eta) {
    p.transmission = 1.0f;
    p.thin_walled = false;
    p.eta = eta;
  };
  add("diffuse", [](SurfaceParameters& p) { p.specular = 0.0f; });
  add("plastic", [](SurfaceParameters&) {});
  add("water paint", [](SurfaceParameters& p) { p.eta = 1.33f; });
  add("diamond paint", [](SurfaceParameters& p) { p.eta = 2.42f; });
  add("plastic from within", [](SurfaceParameters& p) { p.eta = 1.0f / 1.5f; });
  add("matched index", [](SurfaceParameters& p) { p.eta = 1.0f; });
  add("half specular", [](SurfaceParameters& p) { p.specular = 0.5f; });
  add("tinted specular", [](SurfaceParameters& p) { p.specular_color = Color(0.2f, 1.0f, 9.0f); });
  add("everything reflected", [](SurfaceParameters& p) { p.eta = 0.0f; });
  add("reflectance 0.3", [](SurfaceParameters& p) {
    p.eta = 0.0f;
    p.specular_color = Color(0.3f);
  });
  add("metal", [](SurfaceParameters& p) { p.metallic = 1.0f; });
  add("half metal", [](SurfaceParameters& p) { p.metallic = 0.5f; });
  add("thin", [](SurfaceParameters& p) { p.transmission = 1.0f; });
  add("half thin", [](SurfaceParameters& p) { p.transmission = 0.5f; });
  add("glass", [&](SurfaceParameters& p) { glass(p, 1.5f); });
  add("glass from within", [&](SurfaceParameters& p) { glass(p, 1.0f / 1.5f); });
  add("diamond", [&](SurfaceParameters& p) { glass(p, 2.42f); });
  add("diamond from within", [&](SurfaceParameters& p) { glass(p, 1.0f / 2.42f); });
  add("matched glass", [&](SurfaceParameters& p) { glass(p, 1.0f); });
  add("weak glass from within", [&](SurfaceParameters& p) {
    glass(p, 1.0f / 1.5f);
    p.specular = 0.3f;
  });
  add("half glass", [&](SurfaceParameters& p) {
    glass(p, 1.5f);
    p.transmission = 0.5f;
  });
  add("metal, plastic and glass", [&](SurfaceParameters& p) {
    glass(p, 1.5f);
    p.transmission = 0.6f;
    p.metallic = 0.3f;
  });
  return all;
}

// The same below a coat.
inline std::vector<NamedSurface> coated_surfaces(float roughness, float coat_roughness,
                                                 float strength = 1.0f) {
  std::vector<NamedSurface> all = white_surfaces(roughness);
  for (NamedSurface& s : all) {
    s.name +=
        ", coat " + std::to_string(strength) + " of roughness " + std::to_string(coat_roughness);
    s.surface.clearcoat = strength;
    s.surface.clearcoat_roughness = coat_roughness;
  }
  return all;
}

}  // namespace lumivec
