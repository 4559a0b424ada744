// Which parts of a scene can throw caustics: bounds of everything with a specular or glossy lobe.
#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/light_tracer.h"

namespace lumivec {
namespace {

// Aiming costs time in proportion to the casters; more of them than this are joined with their
// neighbours.
constexpr std::size_t max_casters = 32;

// Paths toward casters that are at most glossy are drawn this much less often: their patches of
// light are broad.
constexpr float glossy_worth = 0.2f;

// The least roughness that a factor and a map (its green channel) leave a lobe with.
float least_roughness(const Scene& scene, float factor, const TextureMap& map) {
  if (map.image < 0) return factor;
  const Image& image = scene.images[std::size_t(map.image)];
  if (image.rgba8.empty()) return 0.0f;
  std::uint8_t least = 255;
  for (std::size_t i = 1; i < image.rgba8.size(); i += 4) least = std::min(least, image.rgba8[i]);
  return factor * static_cast<float>(least) / 255.0f;
}

// Whether the base may have glossy lobes, if it is not too rough or too smooth for them.
bool may_be_glossy(const Material& m) {
  if (m.metallic > 0.0f || m.transmission > 0.0f || m.ior <= 0.0f) return true;
  const Color& tint = m.specular_color;
  return normal_reflectance(m.ior) * m.specular * std::max({tint.x, tint.y, tint.z}) >=
         glossy_reflectance;
}

// The least roughness of the lobes that can throw caustics; 1 where there are none.
float sharpest_lobe(const Scene& scene, const Material& m, float specular_roughness) {
  if (m.unlit) return 1.0f;
  float sharpest = 1.0f;
  if (m.specular > 0.0f || m.metallic > 0.0f || m.transmission > 0.0f)
    sharpest = least_roughness(scene, m.roughness, m.metallic_roughness_map);
  if (m.clearcoat > 0.0f) {
    sharpest = std::min(sharpest,
                        least_roughness(scene, m.clearcoat_roughness, m.clearcoat_roughness_map));
  }
  if (sharpest >= specular_roughness && !may_be_glossy(m)) return 1.0f;
  return sharpest;
}

BoundingSphere instance_bounds(const TracedScene& scene, int index) {
  const TracedInstance& instance = scene.instances()[std::size_t(index)];
  if (instance.sphere >= 0) {
    const TracedSphere& s = scene.spheres()[std::size_t(instance.sphere)];
    return {s.center, s.radius};
  }
  if (instance.solid >= 0) {
    const Imath::Box3d& box = scene.solids()[std::size_t(instance.solid)].bounds();
    return {V3f(box.center()), static_cast<float>(box.size().length() * 0.5)};
  }
  const M44d m = scene.object_to_traced(index);
  V3d low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
  const auto extend = [&](const V3d& p) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  };
  if (instance.mesh) {
    for (const V3f& p : instance.mesh->positions) extend(V3d(p) * m);
  } else {
    const Instance& placed = scene.scene().instances[std::size_t(index)];
    const double r = scene.scene().spheres[std::size_t(placed.sphere)].radius;
    for (int corner = 0; corner < 8; ++corner) {
      extend(V3d((corner & 1) ? r : -r, (corner & 2) ? r : -r, (corner & 4) ? r : -r) * m);
    }
  }
  if (!(low.x <= high.x)) return {};
  return {V3f((low + high) * 0.5), static_cast<float>((high - low).length() * 0.5)};
}

BoundingSphere join(const BoundingSphere* begin, const BoundingSphere* end) {
  V3f low(std::numeric_limits<float>::infinity()), high(-std::numeric_limits<float>::infinity());
  for (const BoundingSphere* s = begin; s != end; ++s) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], s->center[i] - s->radius);
      high[i] = std::max(high[i], s->center[i] + s->radius);
    }
  }
  BoundingSphere all{(low + high) * 0.5f, 0.0f};
  for (const BoundingSphere* s = begin; s != end; ++s) {
    all.radius = std::max(all.radius, (s->center - all.center).length() + s->radius);
  }
  return all;
}

// Splits a run of spheres at the median of the longest axis until each part is one of `parts`
// groups.
void group(BoundingSphere* begin, BoundingSphere* end, std::size_t parts,
           std::vector<BoundingSphere>& out) {
  if (parts <= 1 || end - begin <= 1) {
    out.push_back(join(begin, end));
    return;
  }
  V3f low(std::numeric_limits<float>::infinity()), high(-std::numeric_limits<float>::infinity());
  for (const BoundingSphere* s = begin; s != end; ++s) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], s->center[i]);
      high[i] = std::max(high[i], s->center[i]);
    }
  }
  const V3f size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  BoundingSphere* middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [axis](const BoundingSphere& a, const BoundingSphere& b) {
    return a.center[axis] < b.center[axis];
  });
  group(begin, middle, parts / 2, out);
  group(middle, end, parts - parts / 2, out);
}

}  // namespace

std::vector<BoundingSphere> caustic_casters(const TracedScene& scene, float specular_roughness) {
  const float specular = std::max(specular_roughness, delta_roughness);
  std::vector<float> sharpest;
  for (const Material& m : scene.scene().materials) {
    sharpest.push_back(sharpest_lobe(scene.scene(), m, specular));
  }
  std::vector<BoundingSphere> casters;
  const auto add = [&](float roughest, float least, float worth) {
    std::vector<BoundingSphere> all;
    for (std::size_t i = 0; i < scene.instances().size(); ++i) {
      if (!scene.scene().instances[i].visible) continue;
      const int material = scene.scene().instances[i].material;
      const float roughness = material < 0 ? 1.0f : sharpest[std::size_t(material)];
      if (!(roughness < roughest) || roughness < least) continue;
      const BoundingSphere bounds = instance_bounds(scene, static_cast<int>(i));
      if (bounds.radius > 0.0f) all.push_back(bounds);
    }
    const std::size_t first = casters.size();
    if (all.size() > max_casters) {
      group(all.data(), all.data() + all.size(), max_casters, casters);
    } else {
      casters.insert(casters.end(), all.begin(), all.end());
    }
    for (std::size_t i = first; i < casters.size(); ++i) casters[i].worth = worth;
  };
  add(specular, 0.0f, 1.0f);
  add(glossy_roughness, specular, glossy_worth);
  return casters;
}

}  // namespace lumivec
