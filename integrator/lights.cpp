#include "integrator/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/sampling.h"
#include "integrator/solid_angle_sampling.h"

namespace lumivec {
namespace {

// Points that emissive textures are looked up at to estimate a triangle's mean radiance.
constexpr float texture_probes[][2] = {
    {1.0f / 3, 1.0f / 3}, {0.6f, 0.2f}, {0.2f, 0.6f},   {0.2f, 0.2f},  {0.1f, 0.1f},
    {0.8f, 0.1f},         {0.1f, 0.8f}, {0.45f, 0.45f}, {0.45f, 0.1f}, {0.1f, 0.45f}};
// Emitters whose brightness varies are never thought darker than this share of their factor: probes
// may miss the bright part.
constexpr float min_texture_share = 0.02f;
// Each group of lights (finite, environment, directional) that may contribute gets at least this
// share of the samples.
constexpr float min_group_share = 0.1f;
// Eye paths meet a light through glass by chance, the more rarely the smaller it is; light paths
// aim at the glass. On the Sphere Flake, whose light is a quarter of the room across, light paths
// have a twentieth of the squared error. Only lights that fill much of the scene, relative to its
// radius, are left to eye paths.
constexpr float max_light_traced_size = 0.5f;
// Of the environment, what is this much brighter than its mean: a sun, its glare, lamps.
constexpr float bright_density = 16.0f / (4.0f * pi);
// Light paths keep a table for each light that they start from.
constexpr std::size_t most_large_light_traced = 4096;
// Shadow rays end this much before their target, relative to their length: rounding of the length
// itself.
constexpr float shadow_ray_end = 1.0f - 4e-7f;

float mean(const Color& c) {
  return (c.x + c.y + c.z) * (1.0f / 3.0f);
}

float smooth_step(float t) {
  return t * t * (3.0f - 2.0f * t);
}

float max_abs(const V3f& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

bool is_rectangle(const std::array<V3f, 3>& a, const std::array<V3f, 3>& b, Emitter& emitter) {
  // The corner of a opposite the shared diagonal, then its two neighbours, must be the
  // parallelogram that b completes.
  for (int i = 0; i < 3; ++i) {
    const V3f &corner = a[std::size_t(i)], &p = a[std::size_t((i + 1) % 3)],
              &q = a[std::size_t((i + 2) % 3)];
    const V3f u = p - corner, v = q - corner;
    const float size = std::max(u.length(), v.length());
    const float tolerance = 1e-5f * (size + max_abs(corner));
    if (std::abs(u.dot(v)) > 1e-5f * u.length() * v.length()) continue;
    const V3f opposite = corner + u + v;
    int matches = 0;
    for (const V3f& x : b) {
      matches += (x - opposite).length() < tolerance || (x - p).length() < tolerance ||
                 (x - q).length() < tolerance;
    }
    const bool same_side = (b[1] - b[0]).cross(b[2] - b[0]).dot(u.cross(v)) > 0.0f;
    if (matches != 3 || !same_side) continue;
    emitter.kind = EmitterKind::rectangle;
    emitter.origin = corner;
    emitter.edge_u = u;
    emitter.edge_v = v;
    return true;
  }
  return false;
}

V3f emitter_normal(const Emitter& e) {
  return e.edge_u.cross(e.edge_v).normalized();
}

std::array<V3f, 3> triangle_from(const Emitter& e, const V3f& p) {
  const V3f corner = e.origin - p;
  return {corner, corner + e.edge_u, corner + e.edge_v};
}

}  // namespace

Lights::Lights(const TracedScene& scene) : scene_(scene), environment_(scene.scene()) {
  const Scene& data = scene.scene();
  first_triangle_.assign(data.instances.size(), -1);
  for (std::size_t i = 0; i < data.instances.size(); ++i) add_instance(static_cast<int>(i));
  for (const Light& light : data.lights) add_light(light);
  tree_ = LightTree(bounds_);
  bounds_ = {};
}

void Lights::add(const Emitter& emitter, const LightBounds& bounds) {
  emitters_.push_back(emitter);
  bounds_.push_back(bounds);
}

void Lights::add_instance(int instance) {
  if (!scene_.scene().instances[std::size_t(instance)].visible) return;
  const TracedInstance& traced = scene_.instances()[std::size_t(instance)];
  const Material& material = *traced.material;
  if (material.unlit || mean(material.emission) <= 0.0f) return;
  if (traced.mesh) {
    add_mesh(instance, material);
  } else if (traced.solid < 0) {
    add_sphere(instance, material);
  }
}

void Lights::add_mesh(int instance, const Material& material) {
  const Mesh& mesh = *scene_.instances()[std::size_t(instance)].mesh;
  const bool varying = material.emission_map.image >= 0 || material.pattern >= 0 ||
                       material.alpha_mode != AlphaMode::opaque;
  Emitter emitter;
  emitter.instance = instance;
  emitter.two_sided = material.double_sided;
  emitter.varying = varying;
  emitter.emission = material.emission;
  first_triangle_[std::size_t(instance)] = static_cast<std::int64_t>(triangle_emitter_.size());

  const auto add_area = [&](const Emitter& e, float area) {
    LightBounds bounds;
    const V3f corners[4] = {e.origin, e.origin + e.edge_u, e.origin + e.edge_v,
                            e.origin + e.edge_u + e.edge_v};
    const int count = e.kind == EmitterKind::rectangle ? 4 : 3;
    bounds.min = bounds.max = corners[0];
    for (int i = 1; i < count; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        bounds.min[axis] = std::min(bounds.min[axis], corners[i][axis]);
        bounds.max[axis] = std::max(bounds.max[axis], corners[i][axis]);
      }
    }
    bounds.axis = emitter_normal(e);
    bounds.two_sided = e.two_sided;
    bounds.intensity = mean(e.emission) * area;
    add(e, bounds);
  };

  if (mesh.triangles.size() == 2 && !varying) {
    Emitter rectangle = emitter;
    const auto a = scene_.triangle(instance, 0), b = scene_.triangle(instance, 1);
    if (is_rectangle(a, b, rectangle)) {
      triangle_emitter_.insert(triangle_emitter_.end(), 2, static_cast<int>(emitters_.size()));
      rectangle.error = 64.0f * 0x1p-24f * std::max({max_abs(a[0]), max_abs(a[1]), max_abs(a[2])});
      add_area(rectangle, rectangle.edge_u.cross(rectangle.edge_v).length());
      return;
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::array<V3f, 3> corners = scene_.triangle(instance, static_cast<unsigned>(i));
    emitter.primitive = static_cast<unsigned>(i);
    emitter.origin = corners[0];
    emitter.edge_u = corners[1] - corners[0];
    emitter.edge_v = corners[2] - corners[0];
    emitter.error = 64.0f * 0x1p-24f *
                    std::max({max_abs(corners[0]), max_abs(corners[1]), max_abs(corners[2])});
    const float area = 0.5f * emitter.edge_u.cross(emitter.edge_v).length();
    if (varying) {
      Color sum(0.0f);
      SurfacePoint point;
      point.instance = instance;
      point.primitive = emitter.primitive;
      point.material = &material;
      for (const auto& probe : texture_probes) {
        point.u = probe[0];
        point.v = probe[1];
        point.position = emitter.origin + emitter.edge_u * probe[0] + emitter.edge_v * probe[1];
        sum += scene_.emission(point) * scene_.opacity(point);
      }
      emitter.emission = sum * (1.0f / static_cast<float>(std::size(texture_probes))) +
                         material.emission * min_texture_share;
    }
    const bool usable = area > 0.0f && std::isfinite(area);
    triangle_emitter_.push_back(usable ? static_cast<int>(emitters_.size()) : -1);
    if (usable) add_area(emitter, area);
  }
}

void Lights::add_sphere(int instance, const Material& material) {
  const TracedInstance& traced = scene_.instances()[std::size_t(instance)];
  Emitter emitter;
  emitter.instance = instance;
  emitter.two_sided = material.double_sided;
  emitter.varying = material.emission_map.image >= 0 || material.pattern >= 0 ||
                    material.alpha_mode != AlphaMode::opaque;
  emitter.emission = material.emission;
  LightBounds bounds;
  V3f extent;
  float cross_section;  // mean projected area
  if (traced.sphere >= 0) {
    const TracedSphere& sphere = scene_.spheres()[std::size_t(traced.sphere)];
    emitter.kind = EmitterKind::sphere;
    emitter.origin = sphere.center;
    emitter.radius = sphere.radius;
    extent = V3f(sphere.radius);
    cross_section = pi * sphere.radius * sphere.radius;
  } else {
    emitter.kind = EmitterKind::ellipsoid;
    const M44d m = scene_.object_to_traced(instance);
    const double r =
        scene_.scene()
            .spheres[std::size_t(scene_.scene().instances[std::size_t(instance)].sphere)]
            .radius;
    emitter.origin = V3f(V3d(m[3][0], m[3][1], m[3][2]));
    double axes[3];
    for (int i = 0; i < 3; ++i) {
      axes[i] = r * V3d(m[i][0], m[i][1], m[i][2]).length();
      extent[i] = static_cast<float>(r * V3d(m[0][i], m[1][i], m[2][i]).length());
    }
    cross_section = pi * static_cast<float>(std::pow(axes[0] * axes[1] * axes[2], 2.0 / 3.0));
  }
  emitter.error = 64.0f * 0x1p-24f * (max_abs(emitter.origin) + max_abs(extent));
  bounds.min = emitter.origin - extent;
  bounds.max = emitter.origin + extent;
  bounds.cos_spread = -1.0f;
  bounds.intensity = mean(emitter.emission) * cross_section;
  bounds.two_sided = emitter.two_sided;
  first_triangle_[std::size_t(instance)] = static_cast<std::int64_t>(emitters_.size());
  add(emitter, bounds);
}

void Lights::add_light(const Light& light) {
  if (mean(light.intensity) <= 0.0f) return;
  has_delta_ = true;
  const M44d& m = light.object_to_world;
  const V3f axis = V3f(-V3d(m[2][0], m[2][1], m[2][2]).normalized());
  if (light.kind == LightKind::directional) {
    directional_.push_back({-axis, light.intensity, light.casts_shadows});
    return;
  }
  Emitter emitter;
  emitter.kind = light.kind == LightKind::spot   ? EmitterKind::spot
                 : light.kind == LightKind::beam ? EmitterKind::beam
                                                 : EmitterKind::point;
  emitter.light = &light;
  emitter.origin = V3f(V3d(m[3][0], m[3][1], m[3][2]) - scene_.origin());
  emitter.edge_u = axis;
  emitter.emission = light.intensity;
  LightBounds bounds;
  bounds.min = bounds.max = emitter.origin;
  bounds.axis = axis;
  bounds.intensity = mean(light.intensity);
  // The tree knows only lights that fall off with the square: equal to this one across the scene.
  if (light.fade_distance > 0.0f) {
    const float across = scene_.radius();
    bounds.intensity *= faded(light, across) * across * across;
  }
  if (light.kind == LightKind::spot) {
    emitter.cos_inner = std::cos(light.inner_cone);
    emitter.cos_outer = std::cos(light.outer_cone);
    // As a "normal" that may point anywhere in the cone and emits along itself only: no falloff is
    // assumed inside.
    bounds.cos_spread = emitter.cos_outer;
    bounds.cos_emission = std::cos(1e-3f);
  } else {
    bounds.cos_spread = -1.0f;
  }
  add(emitter, bounds);
}

float Lights::directional_weight(const DirectionalLight& light, const V3f& normal) const {
  const float cosine = normal == V3f(0.0f) ? 1.0f : std::max(0.0f, light.direction.dot(normal));
  return mean(light.illuminance) * cosine;
}

// Each group's share follows its estimated irradiance, but no group is starved by a wrong estimate.
Lights::Shares Lights::shares(const V3f& p, const V3f& normal) const {
  const float tree = tree_.importance(p, normal);
  const float environment = pi * environment_.mean_radiance();
  float directional = 0.0f;
  for (const DirectionalLight& light : directional_)
    directional += directional_weight(light, normal);
  const float sum = tree + environment + directional;
  Shares result;
  if (!(sum > 0.0f) || !std::isfinite(sum)) return result;
  const int groups = (tree > 0.0f) + (environment > 0.0f) + (directional > 0.0f);
  const float spread = 1.0f - min_group_share * static_cast<float>(groups);
  const auto share = [&](float weight) {
    return weight > 0.0f ? min_group_share + spread * (weight / sum) : 0.0f;
  };
  result.tree = share(tree);
  result.environment = share(environment);
  result.directional_scale = directional > 0.0f ? share(directional) / directional : 0.0f;
  return result;
}

// Beyond everything: the scene is radius() around traced space's origin.
V3f Lights::far_along(const V3f& p, const V3f& direction) const {
  return p + direction * (2.0f * (scene_.radius() + p.length()));
}

bool Lights::sample(const V3f& p, const V3f& normal, float u_light, const V2f& u,
                    LightSample& out) const {
  out.environment = false;
  out.shadowed = true;
  if (directional_.empty() && environment_.black()) {
    float probability;
    const int index = tree_.sample(p, normal, u_light, probability);
    if (index < 0 || !sample_emitter(emitters_[std::size_t(index)], p, u, out)) return false;
    out.pdf *= probability;
    return out.pdf > 0.0f;
  }
  const Shares share = shares(p, normal);
  if (u_light < share.tree) {
    u_light = std::min(u_light / share.tree, 0x1.fffffep-1f);
    float probability;
    const int index = tree_.sample(p, normal, u_light, probability);
    if (index < 0 || !sample_emitter(emitters_[std::size_t(index)], p, u, out)) return false;
    out.pdf *= probability * share.tree;
    return out.pdf > 0.0f;
  }
  u_light -= share.tree;
  out.distance = std::numeric_limits<float>::infinity();
  if (u_light < share.environment) {
    out.direction = environment_.sample(u, out.pdf);
    out.target = far_along(p, out.direction);
    out.radiance = environment_.radiance(out.direction);
    out.pdf *= share.environment;
    out.delta = false;
    out.environment = true;
    out.light_traced = environment_light_traced(out.direction);
    return out.pdf > 0.0f;
  }
  u_light -= share.environment;
  for (const DirectionalLight& light : directional_) {
    const float probability = directional_weight(light, normal) * share.directional_scale;
    if (u_light < probability) {
      out.direction = light.direction;
      out.target = far_along(p, light.direction);
      out.radiance = light.illuminance;
      out.pdf = probability;
      out.delta = true;
      out.shadowed = light.casts_shadows;
      out.light_traced = leaves_caustics_;
      return true;
    }
    u_light -= probability;
  }
  return false;
}

float spot_falloff(const Emitter& spot, const V3f& direction) {
  const float cosine = direction.dot(spot.edge_u);
  if (cosine <= spot.cos_outer) return 0.0f;
  const float within =
      spot.light && spot.light->tightness > 0.0f ? std::pow(cosine, spot.light->tightness) : 1.0f;
  if (cosine >= spot.cos_inner) return within;
  const float ramp = (cosine - spot.cos_outer) / (spot.cos_inner - spot.cos_outer);
  return within * (spot.light && spot.light->smooth_edge ? smooth_step(ramp) : ramp * ramp);
}

float faded(const Light& light, float distance) {
  if (!(light.fade_distance > 0.0f)) return 1.0f / (distance * distance);
  return 2.0f / (1.0f + std::pow(distance / light.fade_distance, light.fade_power));
}

V3f shadow_offset(const Light& light, const V2f& u) {
  const V2f at = light.round_shadows ? sample_disc(u) : V2f(2.0f * u.x - 1.0f, 2.0f * u.y - 1.0f);
  return light.shadow_u * at.x + light.shadow_v * at.y;
}

// What is left of a beam so far from its axis.
float beam_falloff(const Light& beam, float from_axis) {
  if (from_axis >= beam.outer_radius) return 0.0f;
  const float left = 1.0f - from_axis / beam.outer_radius;
  const float within = beam.tightness > 0.0f ? std::pow(left, beam.tightness) : 1.0f;
  if (from_axis <= beam.inner_radius) return within;
  return within *
         smooth_step((beam.outer_radius - from_axis) / (beam.outer_radius - beam.inner_radius));
}

bool Lights::sample_emitter(const Emitter& e, const V3f& p, const V2f& u, LightSample& out) const {
  out.delta = false;
  out.light_traced = e.light_traced;
  SurfacePoint point;  // on the light, for what varies over it
  V3f normal(0.0f);
  switch (e.kind) {
    case EmitterKind::point:
    case EmitterKind::spot: {
      const V3f to_light = e.origin - p;
      const float d2 = to_light.length2();
      if (!(d2 > 0.0f)) return false;
      out.distance = std::sqrt(d2);
      out.direction = to_light * (1.0f / out.distance);
      out.target = e.origin + shadow_offset(*e.light, u);
      out.shadowed = e.light->casts_shadows;
      out.radiance = e.emission * faded(*e.light, out.distance);
      if (e.kind == EmitterKind::spot) {
        const float falloff = spot_falloff(e, -out.direction);
        if (falloff <= 0.0f) return false;
        out.radiance *= falloff;
      }
      out.pdf = 1.0f;
      out.delta = true;
      return true;
    }
    case EmitterKind::beam: {
      const V3f along = p - e.origin;
      out.distance = along.dot(e.edge_u);
      if (!(out.distance > 0.0f)) return false;
      const float falloff = beam_falloff(*e.light, (along - e.edge_u * out.distance).length());
      if (!(falloff > 0.0f)) return false;
      out.direction = -e.edge_u;
      out.target = p - e.edge_u * out.distance;
      out.shadowed = e.light->casts_shadows;
      out.radiance = e.emission * (falloff * faded(*e.light, out.distance));
      out.pdf = 1.0f;
      out.delta = true;
      return true;
    }
    case EmitterKind::sphere: {
      const V3f to_center = e.origin - p;
      const float d2 = to_center.length2();
      if (d2 <= e.radius * e.radius) {
        if (!e.two_sided) return false;
        const float z = 1.0f - 2.0f * u.x, r = std::sqrt(std::max(0.0f, 1.0f - z * z));
        out.direction = V3f(r * std::cos(2.0f * pi * u.y), r * std::sin(2.0f * pi * u.y), z);
        const float along = to_center.dot(out.direction);
        out.distance = along + std::sqrt(std::max(0.0f, along * along + e.radius * e.radius - d2));
        out.pdf = 1.0f / (4.0f * pi);
      } else {
        const SphereCone cone = sphere_cone(to_center, e.radius);
        out.direction = sample_sphere_cone(cone, e.radius, u, out.distance);
        out.pdf = cone.pdf;
      }
      normal = (out.direction * out.distance - to_center) * (1.0f / e.radius);
      break;
    }
    case EmitterKind::rectangle: {
      const SphericalRectangle r = spherical_rectangle(e.origin - p, e.edge_u, e.edge_v);
      normal = emitter_normal(e);
      V3f to_point;
      if (r.solid_angle > min_solid_angle) {
        to_point = sample_spherical_rectangle(r, u);
        out.distance = to_point.length();
        out.pdf = 1.0f / r.solid_angle;
      } else {
        to_point = e.origin - p + e.edge_u * u.x + e.edge_v * u.y;
        const float d2 = to_point.length2();
        out.distance = std::sqrt(d2);
        out.pdf = d2 * out.distance /
                  (std::abs(normal.dot(to_point)) * e.edge_u.cross(e.edge_v).length());
      }
      out.direction = to_point * (1.0f / out.distance);
      break;
    }
    case EmitterKind::triangle: {
      const std::array<V3f, 3> corners = triangle_from(e, p);
      const float solid_angle = triangle_solid_angle(corners);
      const V3f cross = e.edge_u.cross(e.edge_v);
      normal = cross.normalized();
      V3f to_point;
      if (solid_angle > min_solid_angle) {
        out.direction = sample_spherical_triangle(corners, u);
        const float cosine = out.direction.dot(normal);
        if (cosine == 0.0f) return false;
        out.distance = corners[0].dot(normal) / cosine;
        if (!(out.distance > 0.0f)) return false;
        out.pdf = 1.0f / solid_angle;
        to_point = out.direction * out.distance;
      } else {
        const float root = std::sqrt(u.x);
        to_point = corners[0] * (1.0f - root) + corners[1] * (root * (1.0f - u.y)) +
                   corners[2] * (root * u.y);
        const float d2 = to_point.length2();
        out.distance = std::sqrt(d2);
        out.direction = to_point * (1.0f / out.distance);
        out.pdf = d2 / (std::abs(normal.dot(out.direction)) * 0.5f * cross.length());
      }
      const V3f from_corner = to_point - corners[0];
      const float area2 = cross.length2();
      point.u = std::clamp(from_corner.cross(e.edge_v).dot(cross) / area2, 0.0f, 1.0f);
      point.v = std::clamp(e.edge_u.cross(from_corner).dot(cross) / area2, 0.0f, 1.0f);
      // A mirrored instance's second and third corners were exchanged when its triangle was taken.
      if (scene_.instances()[std::size_t(e.instance)].mirrored) std::swap(point.u, point.v);
      break;
    }
    case EmitterKind::ellipsoid: {
      const float z = 1.0f - 2.0f * u.x, r = std::sqrt(std::max(0.0f, 1.0f - z * z));
      const V3d object(r * std::cos(2.0f * pi * u.y), r * std::sin(2.0f * pi * u.y), z);
      const M44d m = scene_.object_to_traced(e.instance);
      const double radius =
          scene_.scene()
              .spheres[std::size_t(scene_.scene().instances[std::size_t(e.instance)].sphere)]
              .radius;
      const V3f to_point = V3f(object * radius * m) - p;
      V3d n;
      m.inverse().transposed().multDirMatrix(object, n);
      // The map of areas from the unit sphere: |det M| r² |M⁻ᵀ n|.
      const float stretch =
          static_cast<float>(std::abs(m.determinant()) * radius * radius * n.length());
      normal = V3f(n.normalized());
      const float d2 = to_point.length2();
      out.distance = std::sqrt(d2);
      out.direction = to_point * (1.0f / out.distance);
      out.pdf = d2 / (std::abs(normal.dot(out.direction)) * 4.0f * pi * stretch);
      break;
    }
  }
  if (!(out.distance > 0.0f)) return false;  // p lies on the light
  const float facing = -out.direction.dot(normal);
  if (facing <= 0.0f && !e.two_sided) return false;
  if (!(out.pdf > 0.0f) || !std::isfinite(out.pdf)) return false;
  const V3f on_light = p + out.direction * out.distance;
  out.target = p + (on_light + normal * (facing < 0.0f ? -e.error : e.error) - p) * shadow_ray_end;
  out.radiance = e.emission;
  if (e.varying) {
    point.instance = e.instance;
    point.primitive = e.primitive;
    point.position = on_light;
    point.front = facing > 0.0f;
    point.material = scene_.instances()[std::size_t(e.instance)].material;
    out.radiance = scene_.emission(point) * scene_.opacity(point);
  }
  return true;
}

float Lights::emitter_pdf(const Emitter& e, const V3f& p, const SurfacePoint& hit) const {
  const V3f to_hit = hit.position - p;
  switch (e.kind) {
    case EmitterKind::sphere: {
      const V3f to_center = e.origin - p;
      if (to_center.length2() <= e.radius * e.radius)
        return e.two_sided ? 1.0f / (4.0f * pi) : 0.0f;
      // The cone's rays only ever see the near side.
      return hit.front ? sphere_cone(to_center, e.radius).pdf : 0.0f;
    }
    case EmitterKind::rectangle: {
      const SphericalRectangle r = spherical_rectangle(e.origin - p, e.edge_u, e.edge_v);
      if (r.solid_angle > min_solid_angle) return 1.0f / r.solid_angle;
      const V3f cross = e.edge_u.cross(e.edge_v);
      const float d2 = to_hit.length2();
      return d2 * std::sqrt(d2) / std::abs(cross.dot(to_hit));
    }
    case EmitterKind::triangle: {
      const float solid_angle = triangle_solid_angle(triangle_from(e, p));
      if (solid_angle > min_solid_angle) return 1.0f / solid_angle;
      const V3f cross = e.edge_u.cross(e.edge_v);
      const float d2 = to_hit.length2();
      return 2.0f * d2 * std::sqrt(d2) / std::abs(cross.dot(to_hit));
    }
    case EmitterKind::ellipsoid: {
      const M44d m = scene_.object_to_traced(e.instance);
      const double radius =
          scene_.scene()
              .spheres[std::size_t(scene_.scene().instances[std::size_t(e.instance)].sphere)]
              .radius;
      const V3d object = (V3d(hit.position) * m.inverse()).normalized();
      V3d n;
      m.inverse().transposed().multDirMatrix(object, n);
      const float stretch =
          static_cast<float>(std::abs(m.determinant()) * radius * radius * n.length());
      const float d2 = to_hit.length2();
      return d2 * std::sqrt(d2) /
             (std::abs(hit.geometric_normal.dot(to_hit)) * 4.0f * pi * stretch);
    }
    case EmitterKind::point:
    case EmitterKind::spot:
    case EmitterKind::beam:
      break;
  }
  return 0.0f;
}

// The emitter that the emissive surface belongs to; -1: light sampling does not know it.
int Lights::emitter_of(const SurfacePoint& hit) const {
  const std::int64_t first = first_triangle_[std::size_t(hit.instance)];
  if (first < 0) return -1;
  const bool mesh = scene_.instances()[std::size_t(hit.instance)].mesh != nullptr;
  return mesh ? triangle_emitter_[std::size_t(first) + hit.primitive] : static_cast<int>(first);
}

bool Lights::leaves_all_caustics() const {
  return leaves_caustics_ && (environment_.black() || leaves_environment_) &&
         std::all_of(emitters_.begin(), emitters_.end(),
                     [](const Emitter& emitter) { return emitter.light_traced; });
}

bool Lights::environment_light_traced(const V3f& direction) const {
  return leaves_caustics_ && (leaves_environment_ || environment_.pdf(direction) > bright_density);
}

float Lights::environment_light_traced_share() const {
  if (!leaves_caustics_ || environment_.black()) return 0.0f;
  return leaves_environment_ ? 1.0f : environment_.share_above(bright_density);
}

bool Lights::light_traced(const SurfacePoint& hit) const {
  if (!leaves_caustics_) return false;
  const int index = emitter_of(hit);
  return index >= 0 && emitters_[std::size_t(index)].light_traced;
}

void Lights::leave_caustics_to_light_paths(bool of_large_lights) {
  leaves_caustics_ = true;
  leaves_environment_ = of_large_lights;
  of_large_lights = of_large_lights && emitters_.size() <= most_large_light_traced;
  for (Emitter& e : emitters_) {
    if (e.kind == EmitterKind::point || e.kind == EmitterKind::spot) {
      e.light_traced = true;
      continue;
    }
    if (e.kind == EmitterKind::beam) continue;  // no photons leave it
    const bool simple = !e.varying && e.kind != EmitterKind::ellipsoid;
    const float size =
        e.kind == EmitterKind::sphere ? e.radius : std::max(e.edge_u.length(), e.edge_v.length());
    e.light_traced = simple && (of_large_lights || size < max_light_traced_size * scene_.radius());
  }
}

float Lights::pdf(const V3f& p, const V3f& normal, const SurfacePoint& hit) const {
  const int index = emitter_of(hit);
  if (index < 0) return 0.0f;
  float choice = tree_.probability(p, normal, index);
  if (!directional_.empty() || !environment_.black()) choice *= shares(p, normal).tree;
  if (!(choice > 0.0f)) return 0.0f;
  const float pdf = choice * emitter_pdf(emitters_[std::size_t(index)], p, hit);
  return std::isfinite(pdf) ? pdf : 0.0f;
}

float Lights::pdf_environment(const V3f& p, const V3f& normal, const V3f& direction) const {
  return environment_.black() ? 0.0f : shares(p, normal).environment * environment_.pdf(direction);
}

}  // namespace lumivec
