#include "viewer/commands/common_options.h"

#include "viewer/option_values.h"

namespace lumivec {

CLI::Option* add_value_option(CLI::App& app, const std::string& names,
                              const std::string& value_name, const std::string& description,
                              const std::function<void(const std::string&)>& read) {
  return app.add_option_function<std::string>(names, read, description)->type_name(value_name);
}

void add_scene_options(CLI::App& app, std::filesystem::path& file, LoadOptions& options) {
  add_value_option(app, "SCENE", "", "Scene file: glTF 2.0 (.gltf, .glb)",
                   [&file](const std::string& text) { file = text; });
  add_value_option(app, "--scene", "NAME|INDEX",
                   "Which scene of a file of several [the file's default]",
                   [&options](const std::string& text) { options.scene = text; })
      ->group("Scene");
  app.add_flag("--allow-outside-files", options.allow_outside_files,
               "Let the scene read files outside its own folder")
      ->group("Scene");
}

void add_display_options(CLI::App& app, bool& automatic_exposure, double& exposure,
                         DisplayOptions& options) {
  // 64 stops either way are 1e±19: beyond any scene, and far from float's limits.
  constexpr double most_stops = 64.0;
  const std::string group = "Display (PNG, JPEG and FLIP; OpenEXR holds radiance)";
  add_value_option(app, "--exposure", "STOPS|auto",
                   "Brightness, or 'auto': the logarithmic mean becomes middle grey [0]",
                   [&](const std::string& text) {
                     automatic_exposure = text == "auto";
                     if (automatic_exposure) return;
                     exposure = parse_number("--exposure", text, -most_stops, most_stops);
                   })
      ->group(group);
  add_value_option(app, "--display", "NAME", "Display to encode for [the configuration's first]",
                   [&options](const std::string& text) { options.display = text; })
      ->group(group);
  add_value_option(app, "--view", "NAME", "View on that display [the configuration's first]",
                   [&options](const std::string& text) { options.view = text; })
      ->group(group);
  add_value_option(app, "--ocio", "FILE|builtin",
                   "OpenColorIO configuration [environment variable OCIO, else the built-in ACES]",
                   [&options](const std::string& text) { options.config = text; })
      ->group(group);
}

void add_environment_options(CLI::App& app, EnvironmentChoice& choice, const std::string& group) {
  add_value_option(app, "--environment", "FILE|sky|none",
                   "Latitude-longitude picture that replaces the scene's environment; sky: a plain "
                   "one, built in [the scene's; sky if the scene holds no light]",
                   [&choice](const std::string& text) { choice.name = text; })
      ->group(group);
  add_value_option(app, "--environment-strength", "X", "Factor of its radiance [1]",
                   [&choice](const std::string& text) {
                     constexpr double most = 1e9;
                     choice.strength = parse_number("--environment-strength", text, 0.0, most);
                   })
      ->group(group);
  add_value_option(app, "--environment-rotation", "DEGREES",
                   "Its turn about +Y, counter-clockwise seen from above [0]",
                   [&choice](const std::string& text) {
                     constexpr double most = 1e6;
                     choice.rotation = parse_number("--environment-rotation", text, -most, most);
                   })
      ->group(group);
}

}  // namespace lumivec
