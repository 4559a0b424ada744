#include "viewer/window/shown_settings.h"

#include <vector>

#include "viewer/camera_text.h"
#include "viewer/text_format.h"

namespace lumivec {
namespace {

constexpr int all_digits = 9;  // of a float, so that it reads back as the same

// As a shell takes it for one word.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

std::string color_text(const Color& c) {
  return format_number(double(c.x), all_digits) + "," + format_number(double(c.y), all_digits) +
         "," + format_number(double(c.z), all_digits);
}

std::string name_or(const std::string& name, std::size_t index) {
  return name.empty() ? std::to_string(index) : name;
}

std::string scene_options(const SceneSource& source) {
  std::string text;
  const auto add = [&](const std::string& option, const std::string& value) {
    text += " " + option + " " + quoted(value);
  };
  if (!source.load.scene.empty()) add("--scene", source.load.scene);
  if (source.load.allow_outside_files) text += " --allow-outside-files";
  for (const auto& folder : source.load.include_paths) add("--include-path", folder.string());
  const EnvironmentChoice& sky = source.environment;
  if (!sky.name.empty()) add("--environment", sky.name.string());
  if (sky.strength != 1.0)
    text += " --environment-strength " + format_number(sky.strength, all_digits);
  if (sky.rotation != 0.0)
    text += " --environment-rotation " + format_number(sky.rotation, all_digits);
  if (source.pose.seconds) text += " --at " + format_number(*source.pose.seconds, all_digits);
  if (!source.pose.animation.empty()) add("--animation", source.pose.animation);
  return text;
}

}  // namespace

std::string settings_text(const ShownPicture& shown) {
  const WindowState& state = shown.state;
  const DisplayOptions& display = shown.display;
  std::string text = "--camera " + camera_text(state.camera.camera(), state.camera.pivot()) +
                     " --terms " + terms_text(state.terms) + " --exposure " +
                     format_number(state.look.exposure, all_digits) + " --display " +
                     quoted(display.display) + " --view " + quoted(display.view);
  if (!display.look.empty()) text += " --look " + quoted(display.look);
  if (!display.config.empty()) text += " --ocio " + quoted(display.config);
  text += " --size " + std::to_string(shown.size.width) + "x" + std::to_string(shown.size.height) +
          " --seed " + std::to_string(state.knobs.seed) + " --cache-error " +
          format_number(100.0 * state.knobs.error, all_digits);
  if (!state.knobs.light_vectors) text += " --integrator path";
  text += scene_options(shown.scene.source);

  std::vector<std::string> notes;
  if (state.layer != Layer::light)
    notes.push_back(std::string("layer ") + layer_names[std::size_t(state.layer)]);
  if (state.look.mode == DisplayMode::false_color) notes.emplace_back("false colour");
  if (state.look.mode == DisplayMode::nan_map) notes.emplace_back("NaN map");
  if (state.look.channel != Channel::color)
    notes.push_back(std::string("channel ") + channel_names[std::size_t(state.look.channel)]);
  if (state.wipe)
    notes.push_back("path tracing left of " + format_number(double(state.wipe_place)));
  if (state.error_map) notes.emplace_back("error map");
  const std::string changed = patch_text(shown.patch, shown.scene.scene);
  if (!changed.empty()) notes.push_back("changed: " + changed);
  std::string separator = " # ";
  for (const std::string& note : notes) {
    text += separator + note;
    separator = "; ";
  }
  return text;
}

std::string patch_text(const ScenePatch& patch, const Scene& scene) {
  std::string text;
  const auto begin = [&](const std::string& what) {
    if (!text.empty()) text += "; ";
    text += what;
  };
  const auto number = [](float value) { return format_number(double(value), all_digits); };
  for (const auto& [index, m] : patch.materials) {
    begin("material " + name_or(m.name, index) + ": base " + color_text(m.base_color) +
          ", roughness " + number(m.roughness) + ", metallic " + number(m.metallic) +
          ", specular " + number(m.specular) + ", clear coat " + number(m.clearcoat) +
          ", transmission " + number(m.transmission) + ", emission " + color_text(m.emission));
  }
  for (const auto& [index, light] : patch.lights)
    begin("light " + name_or(light.name, index) + ": " + color_text(light.intensity));
  for (const auto& [index, place] : patch.places) {
    begin("object " + name_or(scene.instances[index].name, index) + ": matrix");
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 3; ++column)
        text.append(row + column == 0 ? " " : ",").append(format_number(place[row][column], 17));
    }
  }
  if (patch.environment) {
    begin("sky: " + color_text(patch.environment->radiance) + ", turned " +
          number(patch.environment->rotation) + " radians");
  }
  return text;
}

}  // namespace lumivec
