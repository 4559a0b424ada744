#include "tools/kept_reference.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/timed_render.h"
#include "viewer/atomic_file.h"
#include "viewer/errors.h"
#include "viewer/json_text.h"
#include "viewer/layered_image.h"
#include "viewer/still_writer.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

// FNV-1a of 64 bits: tells files apart that differ by accident.
constexpr std::uint64_t fnv_start = 0xcbf29ce484222325;
std::uint64_t hashed(std::uint64_t hash, const std::string& bytes) {
  constexpr std::uint64_t fnv_prime = 0x100000001b3;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * fnv_prime;
  return hash;
}

std::optional<std::string> content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

fs::path description_file(const ReferenceRequest& request) {
  return reference_file(request).replace_extension(".json");
}

// What must agree if a reference is to be used again.
nlohmann::json identity(const ReferenceRequest& request) {
  return {{"scene_hash", scene_hash(request.scene_file)},
          {"width", request.width},
          {"height", request.height},
          {"samples", request.samples},
          {"seeds", reference_seeds}};
}

std::optional<Reference> read_reference(const ReferenceRequest& request) {
  const std::optional<std::string> description = content(description_file(request));
  if (!description) return std::nullopt;
  try {
    const nlohmann::json json = nlohmann::json::parse(*description);
    if (json.at("identity") != identity(request)) return std::nullopt;
    Reference reference;
    reference.noise = term_noise_from_json(json.at("noise"));
    reference.core_seconds = json.at("core_seconds").get<double>();
    const LayeredImage image = read_layered_image(reference_file(request));
    if (image.width != request.width || image.height != request.height) return std::nullopt;
    Framebuffer framebuffer;
    framebuffer.width = image.width;
    framebuffer.height = image.height;
    for (std::size_t term = 0; term < term_count; ++term) {
      framebuffer.terms[term] = image.layers.at(std::string(term_names[term])).pixels;
    }
    reference.pictures = term_pictures(framebuffer);
    reference.was_kept = true;
    return reference;
  } catch (const nlohmann::json::exception&) {  // cut short, or of another version
    return std::nullopt;
  } catch (const std::out_of_range&) {  // a term is missing
    return std::nullopt;
  } catch (const CommandError&) {  // the picture is missing or broken
    return std::nullopt;
  }
}

// The picture first: where its description is, the picture is there in full.
void keep(const ReferenceRequest& request, const Framebuffer& mean, const Reference& reference) {
  std::error_code error;
  fs::create_directories(request.folder, error);
  if (error) {
    throw CommandError(request.folder.string() + ": cannot be made: " + error.message() +
                       "; choose another folder for the references");
  }
  StillHeader header;
  header.scene = request.scene_file.filename().string();
  header.settings = "reference by path tracing";
  header.samples = request.samples;
  header.seconds = reference.core_seconds;
  ExrOptions options;
  options.precision = ExrPrecision::single;
  write_exr(reference_file(request), mean, options, header);
  write_text_atomically(description_file(request),
                        json_text({{"scene", header.scene},
                                   {"identity", identity(request)},
                                   {"core_seconds", reference.core_seconds},
                                   {"noise", term_noise_json(reference.noise)}}));
}

}  // namespace

std::string scene_hash(const fs::path& scene_file) {
  const std::optional<std::string> text = content(scene_file);
  if (!text) throw CommandError(scene_file.string() + ": cannot be read");
  std::uint64_t hash = hashed(fnv_start, *text);
  // Binary glTF holds its buffers itself, and does not parse.
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  for (const char* kind : {"buffers", "images"}) {
    if (!json.is_object() || !json.contains(kind) || !json[kind].is_array()) continue;
    for (const nlohmann::json& item : json[kind]) {
      if (!item.is_object() || !item.contains("uri") || !item["uri"].is_string()) continue;
      const std::string uri = item["uri"].get<std::string>();
      if (uri.starts_with("data:")) continue;  // is part of the text
      hash = hashed(hash, content(scene_file.parent_path() / uri).value_or(""));
    }
  }
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

fs::path reference_file(const ReferenceRequest& request) {
  return request.folder /
         (request.scene_file.stem().string() + "_" + std::to_string(request.width) + "x" +
          std::to_string(request.height) + "_" + std::to_string(request.samples) + "_" +
          scene_hash(request.scene_file) + ".exr");
}

Reference kept_reference(const Scene& scene, const ReferenceRequest& request,
                         const std::function<void()>& before_rendering) {
  if (request.samples < 2 || request.samples % 2 != 0) {
    throw UsageError("a reference needs an even number of samples, at least 2; not " +
                     std::to_string(request.samples));
  }
  if (std::optional<Reference> kept = read_reference(request)) return std::move(*kept);
  if (before_rendering) before_rendering();
  RenderSettings settings;
  settings.width = request.width;
  settings.height = request.height;
  settings.samples = request.samples / 2;
  settings.threads = request.threads;
  settings.seed = reference_seeds[0];
  const TimedRender first = timed_render(scene, settings);
  settings.seed = reference_seeds[1];
  const TimedRender second = timed_render(scene, settings);

  Framebuffer mean = first.picture;
  for (std::size_t term = 0; term < term_count; ++term) {
    for (std::size_t i = 0; i < mean.pixel_count(); ++i) {
      mean.terms[term][i] = (mean.terms[term][i] + second.picture.terms[term][i]) * 0.5f;
    }
  }
  Reference reference;
  reference.pictures = term_pictures(mean);
  reference.noise = noise_of_halves(term_pictures(first.picture), reference.pictures);
  reference.core_seconds = first.core_seconds + second.core_seconds;
  keep(request, mean, reference);
  return reference;
}

}  // namespace lumivec
