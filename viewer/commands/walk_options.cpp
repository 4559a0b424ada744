#include <CLI/CLI.hpp>
#include <limits>

#include "viewer/commands/common_options.h"
#include "viewer/commands/walk.h"
#include "viewer/errors.h"

namespace lumivec {
namespace {

void add_walk_group(CLI::App& app, WalkOptions& options) {
  const std::string group = "Walk";
  add_value_option(
      app, "--path", "orbit:DEGREES|dolly:UNITS|FILE",
      "Where the camera goes: around what it looks at, straight on, or by the keys of "
      "a JSON file",
      [&options](const std::string& text) { options.path = parse_camera_path("--path", text); })
      ->group(group);
  add_value_option(app, "--frames", "N", "Frames of the walk [60]",
                   [&options](const std::string& text) {
                     constexpr std::uint64_t most = 1'000'000;
                     options.frames = int(parse_whole("--frames", text, 1, most));
                   })
      ->group(group);
  add_value_option(app, "--animation", "NAME|INDEX",
                   "Plays an animation of the scene from its beginning, again and again",
                   [&options](const std::string& text) { options.animation = text; })
      ->group(group);
  add_value_option(app, "--fps", "N", "Frames in a second of the animation and of the movie [30]",
                   [&options](const std::string& text) {
                     constexpr double most = 1e4;
                     options.frames_per_second = parse_number("--fps", text, 1e-3, most);
                   })
      ->group(group);
  add_value_option(app, "--mode", "NAME",
                   "path or lv: every pixel of every frame anew, by path tracing or light vectors; "
                   "rc or rc+lv: with the shading of earlier frames [rc+lv]",
                   [&options](const std::string& text) {
                     options.mode = parse_word("--mode", text, {"path", "rc", "lv", "rc+lv"});
                   })
      ->group(group);
  add_value_option(
      app, "--reuse", "shading|image",
      "What rc keeps: how surfaces look, while what the eye sees is traced afresh; or "
      "the pixels themselves, moved to where they are seen now [shading]",
      [&options](const std::string& text) {
        const bool image = parse_word("--reuse", text, {"shading", "image"}) == "image";
        options.reuse = image ? Reuse::image : Reuse::shading;
      })
      ->group(group);
  add_value_option(app, "--frame-time", "MS",
                   "What tracing may fill up, with the shading of earlier frames [33]",
                   [&options](const std::string& text) {
                     constexpr double most = 1e6;
                     options.frame_time =
                         1e-3 * parse_number_above("--frame-time", text, 0.0, most);
                   })
      ->group(group);
  add_value_option(app, "--reference", "FOLDER",
                   "Path-traced frames to compare with; made if they are not there",
                   [&options](const std::string& text) { options.reference = text; })
      ->group(group);
  add_value_option(app, "--reference-spp", "N", "Samples a pixel of those that are made [256]",
                   [&options](const std::string& text) {
                     options.reference_samples =
                         int(parse_whole("--reference-spp", text, 1, max_picture_samples));
                   })
      ->group(group);
  add_value_option(app, "--terms", "LIST", "Parts of the light that are shown [all]",
                   [&options](const std::string& text) {
                     options.settings.terms = parse_terms("--terms", text);
                   })
      ->group(group);
  add_value_option(app, "--seed", "N", "Of the random numbers [0]",
                   [&options](const std::string& text) {
                     options.settings.seed =
                         parse_whole("--seed", text, 0, std::numeric_limits<std::uint64_t>::max());
                   })
      ->group(group);
  add_value_option(app, "--threads", "N", "Processors to use [0: all]",
                   [&options](const std::string& text) {
                     constexpr std::uint64_t most = 4096;
                     options.settings.threads = int(parse_whole("--threads", text, 0, most));
                   })
      ->group(group);
}

void add_output_group(CLI::App& app, WalkOptions& options) {
  const std::string group = "Output";
  add_value_option(app, "-o,--output", "FOLDER|MOVIE.mp4",
                   "Write the frames there, as displayed: PNG files, or a movie, which takes the "
                   "program ffmpeg",
                   [&options](const std::string& text) { options.output = text; })
      ->group(group);
  add_value_option(
      app, "--size", "WxH|N", "Pixels [height 512, width by the camera's aspect ratio]",
      [&options](const std::string& text) { options.size = parse_size("--size", text); })
      ->group(group);
  add_value_option(app, "--stats", "FILE.json", "Write every frame's figures as JSON",
                   [&options](const std::string& text) { options.statistics = text; })
      ->group(group);
  app.add_flag("-q,--quiet", options.quiet, "Print nothing but errors")->group(group);
}

}  // namespace

void add_walk_options(CLI::App& app, WalkOptions& options) {
  add_scene_options(app, options.scene_file, options.load);
  add_value_option(
      app, "--camera", "NAME|INDEX|VIEW",
      "Camera of the scene, or eye=X,Y,Z/target=X,Y,Z, with /up=X,Y,Z and /yfov=DEGREES "
      "if wanted [the first]",
      [&options](const std::string& text) { options.camera = text; })
      ->group("Scene");
  add_environment_options(app, options.environment, "Scene");
  add_walk_group(app, options);
  add_output_group(app, options);
  add_display_options(app, options.automatic_exposure, options.exposure, options.display);
}

void check_walk_options(const CLI::App& app, const WalkOptions& options) {
  if (options.scene_file.empty())
    throw UsageError("walk: no scene is given; write: lumivec walk SCENE --path orbit:30");
  if (!app.count("--path"))
    throw UsageError("walk: no path is given; add --path orbit:30, dolly:1 or a file's name");
  if (app.count("--reuse") && options.walk_mode().reuse == Reuse::nothing)
    throw UsageError("--reuse: mode " + options.mode + " keeps nothing; use --mode rc or rc+lv");
  if (app.count("--reference-spp") && options.reference.empty())
    throw UsageError("--reference-spp: there is no reference; add --reference FOLDER");
  const std::string extension = options.output.extension().string();
  if (extension == ".gif" || extension == ".png" || extension == ".exr")
    throw UsageError(options.output.string() +
                     ": frames are written to a folder or a movie; name one, or a .mp4 file");
}

}  // namespace lumivec
