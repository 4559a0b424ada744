#include "viewer/commands/common_options.h"

#include "viewer/option_values.h"

namespace lumivec {

CLI::Option* add_value_option(CLI::App& app, const std::string& names,
                              const std::string& value_name, const std::string& description,
                              const std::function<void(const std::string&)>& read) {
  return app.add_option_function<std::string>(names, read, description)->type_name(value_name);
}

namespace {

// Of POV-Ray scenes, which are programs.
void add_language_options(CLI::App& app, LoadOptions& options) {
  constexpr double most = 1e18;
  const std::string group = "POV-Ray scenes";
  app.add_option_function<std::vector<std::string>>(
         "--include-path",
         [&options](const std::vector<std::string>& folders) {
           options.include_paths.assign(folders.begin(), folders.end());
         },
         "Folder that includes are searched in; may be repeated")
      ->type_name("FOLDER")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(group);
  const auto bound = [&](const std::string& name, const std::string& description, double least,
                         double largest, auto& value) {
    add_value_option(app, name, "N", description,
                     [name, least, largest, &value](const std::string& text) {
                       value = static_cast<std::decay_t<decltype(value)>>(
                           parse_number(name, text, least, largest));
                     })
        ->group(group);
  };
  LanguageLimits& limits = options.language;
  bound("--max-steps", "Bound on directives, macro calls and passes of loops [200000000]", 1.0,
        most, limits.max_steps);
  bound("--max-recursion", "Bound on macros within macros [10000]", 1.0, 1e6,
        limits.max_macro_depth);
  bound("--max-nesting", "Bound on blocks and brackets within each other [400]", 1.0, 2000.0,
        limits.max_nesting);
  bound("--max-chain", "Bound on declared things that hold each other [2000]", 1.0, 5000.0,
        limits.max_depth);
  bound("--max-parts", "Bound on the parts of one object, function or texture [50000000]", 1.0,
        most, limits.max_parts);
  bound("--max-bytes", "Bound on the memory that the scene takes [8589934592]", 1.0, most,
        options.max_bytes);
  bound("--max-file-size", "Bound on each file's bytes [1073741824]", 1.0, most,
        limits.max_file_bytes);
}

}  // namespace

void add_scene_options(CLI::App& app, std::filesystem::path& file, LoadOptions& options) {
  add_value_option(app, "SCENE", "", "Scene file: glTF 2.0 (.gltf, .glb) or POV-Ray (.pov)",
                   [&file](const std::string& text) { file = text; });
  add_value_option(app, "--scene", "NAME|INDEX",
                   "Which scene of a file of several [the file's default]",
                   [&options](const std::string& text) { options.scene = text; })
      ->group("Scene");
  app.add_flag("--allow-outside-files", options.allow_outside_files,
               "Let the scene read files outside its own folder")
      ->group("Scene");
  add_language_options(app, options);
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
  add_value_option(app, "--look", "NAME", "Look of the configuration [the view's own]",
                   [&options](const std::string& text) { options.look = text; })
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
