#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>

#include "viewer/commands/common_options.h"
#include "viewer/commands/view.h"
#include "viewer/errors.h"
#include "viewer/window/key_table.h"

namespace lumivec {

std::string view_footer() {
  return key_help() +
         "\n  lumivec view room.gltf\n"
         "  lumivec view room.gltf --environment sky --view Raw\n"
         "  lumivec view --environment sky     # lights what is dropped on the window\n\n"
         "  --scene, --allow-outside-files, --at and --animation are for the first file that is\n"
         "  opened, the other options for later ones too; --exposure auto measures each.";
}

void add_view_options(CLI::App& app, ViewOptions& options) {
  WindowOptions& window = options.window;
  add_scene_options(app, options.source.file, options.source.load);
  add_value_option(app, "--camera", "NAME|INDEX|VIEW",
                   "Camera of the scene, or eye=X,Y,Z/target=X,Y,Z, with /up=X,Y,Z and "
                   "/yfov=DEGREES if wanted [the first]",
                   [&window](const std::string& text) { window.camera = text; })
      ->group("Scene");
  add_value_option(app, "--at", "SECONDS", "Pose the scene at this moment of an animation",
                   [&options](const std::string& text) {
                     constexpr double a_year = 365.0 * 86400.0;
                     options.source.pose.seconds = parse_number("--at", text, 0.0, a_year);
                   })
      ->group("Scene");
  add_value_option(app, "--animation", "NAME|INDEX", "Which animation [the first]",
                   [&options](const std::string& text) { options.source.pose.animation = text; })
      ->group("Scene");
  add_environment_options(app, options.source.environment, "Scene");
  const std::string group = "Window";
  add_value_option(app, "--size", "WxH|N", "Of the window [as last time]",
                   [&window](const std::string& text) { window.size = parse_size("--size", text); })
      ->group(group);
  add_value_option(app, "--pixel-size", "N",
                   "Screen pixels a side of one of the picture's [as fast as needed]",
                   [&window](const std::string& text) {
                     constexpr std::uint64_t most = 16;
                     window.pixel_size = int(parse_whole("--pixel-size", text, 1, most));
                   })
      ->group(group);
  add_value_option(
      app, "--terms", "LIST", "Parts of the light that are shown at first [all]",
      [&window](const std::string& text) { window.terms = parse_terms("--terms", text); })
      ->group(group);
  add_value_option(app, "-o,--output", "FOLDER",
                   "Where pictures and camera paths are written [here]",
                   [&window](const std::string& text) { window.folder = text; })
      ->group(group);
  add_value_option(app, "--threads", "N", "Processors to use [0: all]",
                   [&window](const std::string& text) {
                     constexpr std::uint64_t most = 4096;
                     window.threads = int(parse_whole("--threads", text, 0, most));
                   })
      ->group(group);
  add_value_option(app, "--seed", "N", "Of the random numbers [0]",
                   [&window](const std::string& text) {
                     window.seed =
                         parse_whole("--seed", text, 0, std::numeric_limits<std::uint64_t>::max());
                   })
      ->group(group);
  add_value_option(app, "--script", "FILE", "Replay the events of a file (for tests)",
                   [&window](const std::string& text) { window.script = text; })
      ->group(group);
  app.add_flag_callback(
         "--fresh", [&window] { window.remember = false; },
         "Neither read nor write the settings that the window remembers")
      ->group(group);
  add_display_options(app, window.automatic_exposure, window.exposure, window.display);
}

void check_view_options(const CLI::App& app, const ViewOptions& options) {
  const WindowOptions& window = options.window;
  if (options.source.file.empty() && !window.camera.empty())
    throw UsageError("--camera: no scene is given; name one");
  if (app.count("--animation") && !app.count("--at"))
    throw UsageError("--animation: no moment is given; add --at SECONDS");
  std::error_code error;
  if (!std::filesystem::is_directory(window.folder, error))
    throw UsageError(window.folder.string() + ": is no folder; make it first, or name another");
}

}  // namespace lumivec
