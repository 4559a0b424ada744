// Options that several commands share, described once.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>

#include "loader/load_scene.h"
#include "viewer/display_transform.h"
#include "viewer/scene_input.h"

namespace lumivec {

// An option with one value: read takes its text. names as CLI11 takes them, "-o,--output"; a name
// without dashes is an argument. value_name is what the help calls the value.
CLI::Option* add_value_option(CLI::App& app, const std::string& names,
                              const std::string& value_name, const std::string& description,
                              const std::function<void(const std::string&)>& read);

// The scene file and how it is read: SCENE, --scene, --allow-outside-files, and what POV-Ray scenes
// need: --include-path and bounds.
void add_scene_options(CLI::App& app, std::filesystem::path& file, LoadOptions& options);

// --exposure, --display, --view, --look, --ocio.
void add_display_options(CLI::App& app, bool& automatic_exposure, double& exposure,
                         DisplayOptions& options);

// --environment and what turns it and makes it brighter.
void add_environment_options(CLI::App& app, EnvironmentChoice& choice, const std::string& group);

}  // namespace lumivec
