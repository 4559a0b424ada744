// The part of TracedScene that turns hits into surfaces and materials.
#include "integrator/surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "integrator/texture.h"
#include "integrator/traced_scene.h"

namespace lumivec {
namespace {

// Positions and Embree's own plane distances are off by a few units in the last place of the
// largest coordinate that took part; this many cover them with room to spare, and are still a
// millionth of the surface's size.
constexpr float position_ulps = 32.0f;
constexpr float position_error = position_ulps * 0x1p-24f;

float max_abs(const V3f& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Unit vector, or fallback where the length has no meaning.
V3f unit_or(const V3f& v, const V3f& fallback) {
  const float length2 = v.length2();
  if (!(length2 > std::numeric_limits<float>::min()) || !std::isfinite(length2)) {
    const V3f scaled = v.normalized();  // Imath takes care of very small lengths
    return scaled.length2() > 0.5f && std::isfinite(scaled.length2()) ? scaled : fallback;
  }
  return v * (1.0f / std::sqrt(length2));
}

V2f sphere_uv(const V3f& n) {
  constexpr float inverse_pi = std::numbers::inv_pi_v<float>;
  return {std::atan2(n.z, n.x) * 0.5f * inverse_pi + 0.5f,
          std::acos(std::clamp(n.y, -1.0f, 1.0f)) * inverse_pi};
}

// Turns the surface toward the side the ray came from.
void face(SurfacePoint& point, const V3f& outward, const V3f& shading, const V3f& direction) {
  point.front = direction.dot(outward) < 0.0f;
  const float side = point.front ? 1.0f : -1.0f;
  point.geometric_normal = outward * side;
  point.normal = shading * (shading.dot(outward) < 0.0f ? -side : side);
}

}  // namespace

SurfacePoint TracedScene::sphere_surface(const TracedSphere& sphere, const V3f& origin,
                                         const V3f& direction, float distance) const {
  SurfacePoint point;
  const V3f outward = unit_or(origin + direction * distance - sphere.center, -direction);
  point.position = sphere.center + outward * sphere.radius;
  point.error = position_error * (max_abs(sphere.center) + sphere.radius);
  face(point, outward, outward, direction);
  return point;
}

SurfacePoint TracedScene::solid_surface(const TracedSolid& solid, const RayHit& hit,
                                        const V3f& origin, const V3f& direction) const {
  SurfacePoint point;
  const TracedSolid::Place place =
      solid.place(static_cast<int>(hit.u), {V3d(origin), V3d(direction)}, hit.distance);
  const V3f outward = unit_or(V3f(place.outward), -direction);
  point.position = V3f(place.point);
  point.error = position_error * static_cast<float>(solid.bounds().size().length() * 0.5);
  point.error = std::max(point.error, position_error * max_abs(point.position));
  face(point, outward, outward, direction);
  return point;
}

SurfacePoint TracedScene::surface(const RayHit& hit, const V3f& origin,
                                  const V3f& direction) const {
  const int index = instance_of(hit);
  const TracedInstance& instance = instances_[std::size_t(index)];
  SurfacePoint point;
  if (instance.sphere >= 0) {
    point = sphere_surface(spheres_[std::size_t(instance.sphere)], origin, direction, hit.distance);
  } else if (instance.solid >= 0) {
    point = solid_surface(solids_[std::size_t(instance.solid)], hit, origin, direction);
  } else if (!instance.mesh) {
    const Transforms& t = transforms_[std::size_t(instance.transform)];
    const V3f object =
        unit_or((origin + direction * hit.distance) * t.traced_to_object, V3f(0.0f, 1.0f, 0.0f));
    point.position = object * t.object_to_traced;
    point.error = position_error * (max_abs(point.position) + t.scale);
    const V3f outward = unit_or(object * t.normal, -direction);
    face(point, outward, outward, direction);
  } else {
    const Mesh& mesh = *instance.mesh;
    const Imath::Vec3<std::uint32_t>& corners = mesh.triangles[hit.primitive];
    const V3f &a = instance.vertices[corners.x], &b = instance.vertices[corners.y],
              &c = instance.vertices[corners.z];
    const float w = 1.0f - hit.u - hit.v;
    const Transforms& t = transforms_[std::size_t(instance.transform)];
    V3f outward = (b - a).cross(c - a);
    point.position = a * w + b * hit.u + c * hit.v;
    point.error = position_error * std::max({max_abs(a), max_abs(b), max_abs(c)});
    if (instance.flattened) {
      outward = unit_or(instance.mirrored ? -outward : outward, -direction);
    } else {
      point.position = point.position * t.object_to_traced;
      point.error = point.error * t.scale + position_error * max_abs(point.position);
      outward = unit_or(outward * t.normal, -direction);
    }
    V3f shading = outward;
    if (!instance.flat_shaded) {
      const V3f n = mesh.normals[corners.x] * w + mesh.normals[corners.y] * hit.u +
                    mesh.normals[corners.z] * hit.v;
      shading = unit_or(n * t.normal, outward);
    }
    face(point, outward, shading, direction);
  }
  point.instance = index;
  point.primitive = hit.primitive;
  point.u = hit.u;
  point.v = hit.v;
  point.material = instance.material;
  return point;
}

std::array<V3f, 3> TracedScene::triangle(int index, unsigned primitive) const {
  const TracedInstance& instance = instances_[std::size_t(index)];
  const Imath::Vec3<std::uint32_t>& t = instance.mesh->triangles[primitive];
  std::array<V3f, 3> corners = {instance.vertices[t.x], instance.vertices[t.y],
                                instance.vertices[t.z]};
  if (!instance.flattened) {
    for (V3f& corner : corners)
      corner = corner * transforms_[std::size_t(instance.transform)].object_to_traced;
  }
  if (instance.mirrored) std::swap(corners[1], corners[2]);
  return corners;
}

V2f TracedScene::uv(const SurfacePoint& point, int set) const {
  const TracedInstance& instance = instances_[std::size_t(point.instance)];
  if (instance.mesh) {
    if (std::size_t(set) >= instance.mesh->uvs.size()) return V2f(0.0f);
    const std::vector<V2f>& uvs = instance.mesh->uvs[std::size_t(set)];
    const Imath::Vec3<std::uint32_t>& t = instance.mesh->triangles[point.primitive];
    return uvs[t.x] * (1.0f - point.u - point.v) + uvs[t.y] * point.u + uvs[t.z] * point.v;
  }
  if (instance.solid >= 0) return V2f(0.0f);
  if (instance.transform >= 0) {
    return sphere_uv(
        unit_or(point.position * transforms_[std::size_t(instance.transform)].traced_to_object,
                V3f(0, 1, 0)));
  }
  const M44d m = object_to_traced(point.instance);
  const V3d offset = V3d(point.position) - V3d(m[3][0], m[3][1], m[3][2]);
  V3d object;
  m.inverse().multDirMatrix(offset, object);
  return sphere_uv(V3f(object.normalized()));
}

V4f TracedScene::vertex_color(const SurfacePoint& point) const {
  const TracedInstance& instance = instances_[std::size_t(point.instance)];
  if (!point.material->vertex_colors || !instance.mesh || instance.mesh->colors.empty())
    return V4f(1.0f);
  const std::vector<V4f>& colors = instance.mesh->colors;
  const Imath::Vec3<std::uint32_t>& t = instance.mesh->triangles[point.primitive];
  return colors[t.x] * (1.0f - point.u - point.v) + colors[t.y] * point.u + colors[t.z] * point.v;
}

namespace {

// A texture at a point; white without touching the coordinates where there is none.
V4f texture(const TracedScene& scene, const SurfacePoint& point, const TextureMap& map) {
  return map.image < 0 ? V4f(1.0f)
                       : sample_texture(scene.scene(), map, scene.uv(point, map.uv_set));
}

Color rgb(const V4f& v) {
  return {v.x, v.y, v.z};
}

Color unit_range(const Color& c) {
  return {std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f), std::clamp(c.z, 0.0f, 1.0f)};
}

}  // namespace

PatternedSurface TracedScene::patterned(const SurfacePoint& point) const {
  const auto index = std::size_t(point.material->pattern);
  return scene_.patterns[index]->at(V3d(point.position) + origin_, V3d(point.geometric_normal),
                                    point.error);
}

// On the same side as the normal without bumps: what they turn away from it stays as it is.
V3f TracedScene::bent_normal(const SurfacePoint& point) const {
  const float side = point.front ? 1.0f : -1.0f;
  const V3d outward = V3d(point.normal * side);
  const V3d bent = scene_.patterns[std::size_t(point.material->pattern)]->bent(
      V3d(point.position) + origin_, outward);
  return bent.dot(outward) > 0.0 ? V3f(bent) * side : point.normal;
}

float TracedScene::opacity(const SurfacePoint& point) const {
  const Material& m = *point.material;
  if (m.alpha_mode == AlphaMode::opaque) return 1.0f;
  const float alpha = m.opacity * texture(*this, point, m.base_color_map).w * vertex_color(point).w;
  if (m.alpha_mode == AlphaMode::mask) return alpha >= m.alpha_cutoff ? 1.0f : 0.0f;
  return std::clamp(alpha, 0.0f, 1.0f);
}

Color TracedScene::emission(const SurfacePoint& point) const {
  const Material& m = *point.material;
  if (m.unlit)
    return m.base_color * rgb(texture(*this, point, m.base_color_map)) * rgb(vertex_color(point));
  if (m.emission == Color(0.0f) || !(point.front || m.double_sided)) return Color(0.0f);
  if (m.pattern >= 0) return patterned(point).emission;
  return m.emission * rgb(texture(*this, point, m.emission_map));
}

// The normal that a tangent-space map asks for, on the same side as normal.
V3f TracedScene::mapped_normal(const SurfacePoint& point, const TextureMap& map, float scale,
                               const V3f& normal) const {
  const TracedInstance& instance = instances_[std::size_t(point.instance)];
  const V4f texel = texture(*this, point, map);
  const V3f local((texel.x * 2.0f - 1.0f) * scale, (texel.y * 2.0f - 1.0f) * scale,
                  texel.z * 2.0f - 1.0f);
  // Maps speak of the front side.
  const float side = point.front ? 1.0f : -1.0f;
  const V3f outward = normal * side;
  V3f tangent(0.0f);
  float handedness = 1.0f;
  if (instance.mesh) {
    const Mesh& mesh = *instance.mesh;
    const Imath::Vec3<std::uint32_t>& t = mesh.triangles[point.primitive];
    const Transforms& transforms = transforms_[std::size_t(instance.transform)];
    if (!mesh.tangents.empty()) {
      const V4f &a = mesh.tangents[t.x], &b = mesh.tangents[t.y], &c = mesh.tangents[t.z];
      const V4f mean = a * (1.0f - point.u - point.v) + b * point.u + c * point.v;
      transforms.object_to_traced.multDirMatrix(V3f(mean.x, mean.y, mean.z), tangent);
      handedness = a.w < 0.0f ? -1.0f : 1.0f;
    } else if (std::size_t(map.uv_set) < mesh.uvs.size()) {
      const std::vector<V2f>& uvs = mesh.uvs[std::size_t(map.uv_set)];
      const V2f ab = uvs[t.y] - uvs[t.x], ac = uvs[t.z] - uvs[t.x];
      const float area = ab.x * ac.y - ab.y * ac.x;
      const V3f &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      const V3f along_u = ((b - a) * ac.y - (c - a) * ab.y) * (area < 0.0f ? -1.0f : 1.0f);
      transforms.object_to_traced.multDirMatrix(along_u, tangent);
      // glTF's v grows downwards and its bitangent upwards.
      handedness = area < 0.0f ? 1.0f : -1.0f;
    }
    if (instance.mirrored) handedness = -handedness;
  } else {
    // u runs around the y axis of object space: from +x toward +z.
    const M44d m = object_to_traced(point.instance);
    V3d axis, offset;
    m.multDirMatrix(V3d(0.0, 1.0, 0.0), axis);
    offset = V3d(outward);
    tangent = V3f(offset.cross(axis));
    if (instance.mirrored) tangent = -tangent;
  }
  tangent -= outward * outward.dot(tangent);
  if (!(tangent.length2() > 0.0f)) return normal;
  tangent = unit_or(tangent, V3f(0.0f));
  const V3f bitangent = outward.cross(tangent) * handedness;
  const V3f mapped = unit_or(tangent * local.x + bitangent * local.y + outward * local.z, outward);
  return mapped * side;
}

// What does not depend on the side or direction that the surface is seen from.
SurfaceParameters TracedScene::appearance(const SurfacePoint& point) const {
  const Material& m = *point.material;
  SurfaceParameters p;
  p.base_color = unit_range(m.base_color * rgb(texture(*this, point, m.base_color_map)) *
                            rgb(vertex_color(point)));
  const V4f metallic_roughness = texture(*this, point, m.metallic_roughness_map);
  p.metallic = std::clamp(m.metallic * metallic_roughness.z, 0.0f, 1.0f);
  p.roughness = std::clamp(m.roughness * metallic_roughness.y, 0.0f, 1.0f);
  p.specular = std::clamp(m.specular * texture(*this, point, m.specular_map).w, 0.0f, 1.0f);
  p.specular_color = m.specular_color * rgb(texture(*this, point, m.specular_color_map));
  p.transmission =
      std::clamp(m.transmission * texture(*this, point, m.transmission_map).x, 0.0f, 1.0f);
  p.thin_walled = m.thin_walled;
  p.clearcoat = std::clamp(m.clearcoat * texture(*this, point, m.clearcoat_map).x, 0.0f, 1.0f);
  p.clearcoat_roughness = std::clamp(
      m.clearcoat_roughness * texture(*this, point, m.clearcoat_roughness_map).y, 0.0f, 1.0f);
  if (m.pattern >= 0) {
    const PatternedSurface s = patterned(point);
    p.base_color = unit_range(s.base_color);
    p.roughness = std::clamp(s.roughness, 0.0f, 1.0f);
    p.specular = std::clamp(s.specular, 0.0f, 1.0f);
    p.specular_color = s.specular_color;
    p.transmission = m.transmission > 0.0f ? std::clamp(s.transmission, 0.0f, 1.0f) : 0.0f;
  }
  return p;
}

// Materials without textures look the same everywhere: their appearance is looked up once.
void TracedScene::prepare_constants() {
  const auto varies = [](const Material& m) {
    if (m.pattern >= 0) return true;
    for (const TextureMap* map :
         {&m.base_color_map, &m.metallic_roughness_map, &m.specular_map, &m.specular_color_map,
          &m.transmission_map, &m.clearcoat_map, &m.clearcoat_roughness_map, &m.normal_map,
          &m.clearcoat_normal_map}) {
      if (map->image >= 0) return true;
    }
    return false;
  };
  std::map<const Material*, int> index_of;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    TracedInstance& instance = instances_[i];
    if (!instance.material) continue;  // not visible
    const bool colored =
        instance.mesh && !instance.mesh->colors.empty() && instance.material->vertex_colors;
    if (varies(*instance.material) || colored) continue;
    const auto [entry, added] =
        index_of.try_emplace(instance.material, static_cast<int>(constants_.size()));
    if (added) {
      SurfacePoint point;
      point.instance = static_cast<int>(i);
      point.material = instance.material;
      constants_.push_back(appearance(point));
    }
    instance.constant = entry->second;
  }
}

SurfaceParameters TracedScene::parameters(const SurfacePoint& point, float outside_ior) const {
  const Material& m = *point.material;
  const int constant = instances_[std::size_t(point.instance)].constant;
  SurfaceParameters p = constant >= 0 ? constants_[std::size_t(constant)] : appearance(point);
  p.normal = point.normal;
  p.coat_normal = point.normal;
  if (constant < 0) {
    if (m.pattern >= 0) p.normal = bent_normal(point);
    if (m.normal_map.image >= 0) {
      p.normal = mapped_normal(point, m.normal_map, m.normal_scale, point.normal);
    }
    if (m.clearcoat_normal_map.image >= 0) {
      p.coat_normal =
          mapped_normal(point, m.clearcoat_normal_map, m.clearcoat_normal_scale, point.normal);
    }
  }
  const bool from_inside = !point.front && !m.thin_walled && m.transmission > 0.0f;
  // Shadow rays pass thin walls without knowing their surroundings: nothing else may either.
  const float around = m.thin_walled && m.transmission > 0.0f ? 1.0f : outside_ior;
  p.eta = from_inside && m.ior > 0.0f ? around / m.ior : m.ior / around;
  return p;
}

Color TracedScene::thin_transmittance(const SurfacePoint& point, const V3f& wo) const {
  // Only the delta lobe is asked for, and what is a delta lobe does not depend on the specular
  // threshold.
  const Bsdf bsdf(parameters(point, 1.0f), point.geometric_normal, wo, *albedo_tables_, 0.0f);
  return bsdf.thin_transmittance();
}

}  // namespace lumivec
