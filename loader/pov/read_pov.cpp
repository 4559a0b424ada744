#include "loader/pov/read_pov.h"

#include <cctype>
#include <cstdio>

#include "loader/error.h"
#include "loader/pov/conversion.h"
#include "loader/pov/parser.h"
#include "loader/pov/scene_items.h"

namespace lumivec::pov {
namespace {

// What was mentioned, each with its first place and how often it was met.
void finish_mentions(Parser& parser, LoadReport& report) {
  for (const Mention& mention : parser.scene.mentions) {
    const std::uint32_t count = parser.mentioned.find(mention.what)->second;
    std::string text = mention.what;
    if (count > 1) text += " (here and in " + std::to_string(count - 1) + " more places)";
    report.warnings.push_back(
        {one_line(parser.place_text(mention.place)), one_line(std::move(text))});
  }
}

std::string format_name(double version) {
  char text[64];
  std::snprintf(text, sizeof text, "POV-Ray scene, language version %g", version);
  return text;
}

Scene convert(Parser& parser) {
  Scene out;
  Conversion conversion{parser, parser.scene, out, M44d(), 1e4, V3d(0.0), 1.0, {}, {}, {}};
  survey(conversion);
  convert_camera(conversion);
  convert_objects(conversion);
  convert_sky(conversion);
  return out;
}

}  // namespace

bool looks_like_pov(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".pov" || extension == ".inc";
}

PovScene parse_pov(const std::filesystem::path& file, std::string_view text,
                   const LoadOptions& options, LoadReport& report) {
  Parser parser(file, text, options, report);
  parse_scene_items(parser);
  return std::move(parser.scene);
}

Scene read_pov(const std::filesystem::path& file, const ByteSource& bytes,
               const LoadOptions& options, LoadReport& report) {
  if (bytes.size() > options.language.max_file_bytes) {
    throw SceneError(file.string(), "",
                     "has " + std::to_string(bytes.size()) + " bytes, more than the limit of " +
                         std::to_string(options.language.max_file_bytes),
                     "raise it by --max-file-size if the scene is trusted");
  }
  std::string text(bytes.size(), '\0');
  bytes.read(0, text.data(), text.size());
  Parser parser(file, text, options, report);
  parse_scene_items(parser);
  if (!parser.scene.camera) {
    parser.mention(parser.place(),
                   "the scene has no camera; the language's own looks along z from the origin");
    parser.scene.camera.emplace();
  }
  Scene scene = convert(parser);
  scene.name = file.stem().string();
  report.format = format_name(parser.scene.version);
  report.generator.clear();
  report.files = parser.sources.files();
  finish_mentions(parser, report);
  return scene;
}

}  // namespace lumivec::pov
