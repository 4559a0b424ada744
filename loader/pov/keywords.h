// The words with a meaning of their own, as numbers. The British spellings mean the same as the
// American ones.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lumivec::pov {

// A word of a scene: keywords have the first numbers, identifiers follow as they are met.
using Word = std::uint32_t;

// clang-format off
#define LUMIVEC_POV_KEYWORDS(X) \
  X(aa_level) X(aa_threshold) X(abs) X(absorption) X(accuracy) X(acos) X(acosh) X(adaptive) \
  X(adc_bailout) X(agate) X(agate_turb) X(albedo) X(all) X(all_intersections) X(alpha) \
  X(altitude) X(always_sample) X(ambient) X(ambient_light) X(ambient_occlusion) X(angle) X(aoi) \
  X(aperture) X(append) X(arc_angle) X(area_illumination) X(area_light) X(array) X(asc) \
  X(ascii) X(asin) X(asinh) X(assumed_gamma) X(atan) X(atan2) X(atanh) X(autostop) X(average) \
  X(b_spline) X(background) X(bezier_spline) X(bicubic_patch) X(bitwise_and) X(bitwise_or) \
  X(bitwise_xor) X(black_hole) X(blob) X(blue) X(blur_samples) X(bounded_by) X(box) X(boxed) \
  X(bozo) X(break) X(brick) X(brick_size) X(brightness) X(brilliance) X(bump_map) X(bump_size) \
  X(bumps) X(camera) X(case) X(caustics) X(ceil) X(cells) X(charset) X(checker) X(chr) \
  X(circular) X(clipped_by) X(clock) X(clock_delta) X(clock_on) X(collect) X(color) \
  X(color_map) X(component) X(composite) X(concat) X(cone) X(confidence) X(conic_sweep) \
  X(conserve_energy) X(contained_by) X(control0) X(control1) X(coords) X(cos) X(cosh) X(count) \
  X(crackle) X(crand) X(cube) X(cubic) X(cubic_spline) X(cubic_wave) X(cutaway_textures) \
  X(cylinder) X(cylindrical) X(datetime) X(debug) X(declare) X(default) X(defined) X(degrees) \
  X(density) X(density_file) X(density_map) X(dents) X(df3) X(difference) X(diffuse) \
  X(dimension_size) X(dimensions) X(direction) X(disc) X(dispersion) X(dispersion_samples) \
  X(dist_exp) X(distance) X(div) X(double_illuminate) X(eccentricity) X(else) X(elseif) \
  X(emission) X(end) X(error) X(error_bound) X(evaluate) X(exp) X(expand_thresholds) \
  X(exponent) X(exterior) X(extinction) X(face_indices) X(facets) X(fade_color) \
  X(fade_distance) X(fade_power) X(falloff) X(falloff_angle) X(false) X(fclose) X(file_exists) \
  X(filter) X(final_clock) X(final_frame) X(finish) X(fisheye) X(flatness) X(flip) X(floor) \
  X(focal_point) X(fog) X(fog_alt) X(fog_offset) X(fog_type) X(fopen) X(for) X(form) \
  X(frame_number) X(frequency) X(fresnel) X(function) X(gamma) X(gather) X(gif) \
  X(global_lights) X(global_settings) X(gradient) X(granite) X(gray) X(gray_threshold) X(green) \
  X(height_field) X(hexagon) X(hf_gray_16) X(hierarchy) X(hollow) X(hypercomplex) X(if) \
  X(ifdef) X(iff) X(ifndef) X(image_height) X(image_map) X(image_pattern) X(image_width) \
  X(importance) X(include) X(initial_clock) X(initial_frame) X(inside) X(inside_vector) X(int) \
  X(interior) X(interior_texture) X(internal) X(interpolate) X(intersection) X(intervals) \
  X(inverse) X(ior) X(irid) X(irid_wavelength) X(isosurface) X(jitter) X(jpeg) X(julia) \
  X(julia_fractal) X(lambda) X(lathe) X(leopard) X(light_group) X(light_source) \
  X(linear_spline) X(linear_sweep) X(ln) X(load_file) X(local) X(location) X(log) X(look_at) \
  X(looks_like) X(low_error_factor) X(macro) X(magnet) X(major_radius) X(mandel) X(map_type) \
  X(marble) X(material) X(material_map) X(matrix) X(max) X(max_extent) X(max_gradient) \
  X(max_intersections) X(max_iteration) X(max_sample) X(max_trace) X(max_trace_level) \
  X(maximum_reuse) X(media) X(media_attenuation) X(media_interaction) X(merge) X(mesh) X(mesh2) \
  X(metallic) X(method) X(metric) X(min) X(min_extent) X(minimum_reuse) X(mm_per_unit) X(mod) \
  X(mortar) X(natural_spline) X(nearest_count) X(no) X(no_bump_scale) X(no_image) \
  X(no_radiosity) X(no_reflection) X(no_shadow) X(noise_generator) X(normal) X(normal_indices) \
  X(normal_map) X(normal_vectors) X(now) X(number_of_waves) X(object) X(octaves) X(off) \
  X(offset) X(omega) X(omnimax) X(on) X(once) X(onion) X(open) X(orient) X(orientation) \
  X(orthographic) X(panoramic) X(parallel) X(parametric) X(pass_through) X(pattern) \
  X(perspective) X(pgm) X(phase) X(phong) X(phong_size) X(photons) X(pi) X(pigment) \
  X(pigment_map) X(pigment_pattern) X(planar) X(plane) X(png) X(point_at) X(poly) X(poly_wave) \
  X(polygon) X(pot) X(pow) X(ppm) X(precision) X(precompute) X(pretrace_end) X(pretrace_start) \
  X(prism) X(prod) X(projected_through) X(pwr) X(quadratic_spline) X(quadric) X(quartic) \
  X(quaternion) X(quick_color) X(quilted) X(radial) X(radians) X(radiosity) X(radius) \
  X(rainbow) X(ramp_wave) X(rand) X(range) X(ratio) X(read) X(reciprocal) X(recursion_limit) \
  X(red) X(reflection) X(reflection_exponent) X(refraction) X(render) X(repeat) X(rgb) X(rgbf) \
  X(rgbft) X(rgbt) X(right) X(ripples) X(rotate) X(roughness) X(samples) X(save_file) X(scale) \
  X(scallop_wave) X(scattering) X(seed) X(select) X(shadowless) X(sin) X(sine_wave) X(sinh) \
  X(size) X(sky) X(sky_sphere) X(slice) X(slope) X(slope_map) X(smooth) X(smooth_triangle) \
  X(solid) X(sor) X(spacing) X(specular) X(sphere) X(sphere_sweep) X(spherical) X(spiral1) \
  X(spiral2) X(spline) X(split_union) X(spotlight) X(spotted) X(sqr) X(sqrt) X(srgb) X(srgbf) \
  X(srgbft) X(srgbt) X(statistics) X(str) X(strcmp) X(strength) X(strlen) X(strlwr) X(strupr) \
  X(sturm) X(substr) X(subsurface) X(sum) X(superellipsoid) X(switch) X(sys) X(t) X(tan) \
  X(tanh) X(target) X(text) X(texture) X(texture_list) X(texture_map) X(tga) X(thickness) \
  X(threshold) X(tiff) X(tightness) X(tile2) X(tiles) X(tiling) X(tolerance) X(toroidal) \
  X(torus) X(trace) X(transform) X(translate) X(translucency) X(transmit) X(triangle) \
  X(triangle_wave) X(true) X(ttf) X(turb_depth) X(turbulence) X(type) X(u) X(u_steps) \
  X(ultra_wide_angle) X(undef) X(union) X(up) X(use_alpha) X(use_color) X(use_index) X(utf8) \
  X(uv_indices) X(uv_mapping) X(uv_vectors) X(v) X(v_steps) X(val) X(variance) X(vaxis_rotate) \
  X(vcross) X(vdot) X(version) X(vertex_vectors) X(vlength) X(vnormalize) X(vrotate) X(vstr) \
  X(vturbulence) X(warning) X(warp) X(water_level) X(waves) X(while) X(width) X(wood) \
  X(wrinkles) X(write) X(x) X(y) X(yes) X(z)
// clang-format on

enum class K : Word {
#define LUMIVEC_POV_ENUMERATOR(word) word##_,
  LUMIVEC_POV_KEYWORDS(LUMIVEC_POV_ENUMERATOR)
#undef LUMIVEC_POV_ENUMERATOR
      keyword_count
};

// The text of a keyword.
std::string_view keyword_text(K keyword);

// The spelling that stands for all: "color" for "colour".
std::string_view usual_spelling(std::string_view word);

// Which number of a vector or color a word after a dot names, from 0 on; none: no component's name.
std::optional<std::size_t> component_of(K word);

}  // namespace lumivec::pov
