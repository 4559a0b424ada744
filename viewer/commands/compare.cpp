#include "viewer/commands/compare.h"

#include <algorithm>
#include <iostream>

#include "viewer/atomic_file.h"
#include "viewer/errors.h"
#include "viewer/exposure.h"
#include "viewer/flip.h"
#include "viewer/heat_colors.h"
#include "viewer/image_error.h"
#include "viewer/json_text.h"
#include "viewer/layered_image.h"
#include "viewer/still_writer.h"
#include "viewer/suggestion.h"
#include "viewer/text_format.h"

namespace lumivec {
namespace {

using LayerPair = std::pair<std::string, std::string>;  // in the test, in the reference

struct LayerError {
  std::string name;  // in the test
  ImageError error;
  double flip = 0.0;  // mean
  NonFinite non_finite_test;
  NonFinite non_finite_reference;
};

std::vector<std::string> layer_names(const LayeredImage& image) {
  std::vector<std::string> names;
  for (const auto& [name, picture] : image.layers) names.push_back(name);
  return names;
}

void check_layer(const LayeredImage& image, const std::string& layer,
                 const std::filesystem::path& file) {
  if (image.layers.contains(layer)) return;
  throw UsageError("--map: " + file.string() + " has no layer '" + layer + "'; " +
                   suggestion(layer, layer_names(image)));
}

// The beauty first, then the terms in their order, then the rest by name.
std::size_t rank(const std::string& layer) {
  if (layer == beauty_layer) return 0;
  const auto* term = std::find(term_names.begin(), term_names.end(), layer);
  return std::size_t(1 + (term - term_names.begin()));
}

std::vector<LayerPair> pair_layers(const CompareOptions& options, const LayeredImage& test,
                                   const LayeredImage& reference) {
  std::vector<LayerPair> pairs = options.layer_names;
  for (const auto& [in_test, in_reference] : pairs) {
    check_layer(test, in_test, options.test);
    check_layer(reference, in_reference, options.reference);
  }
  for (const auto& [name, picture] : test.layers) {
    const bool mapped =
        std::any_of(pairs.begin(), pairs.end(),
                    [&layer = name](const LayerPair& p) { return p.first == layer; });
    if (!mapped && reference.layers.contains(name)) pairs.emplace_back(name, name);
  }
  if (pairs.empty()) {
    throw CommandError(options.test.string() + ", " + options.reference.string() +
                       ": have no layer in common; name them with --map X=Y");
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const LayerPair& a, const LayerPair& b) {
    return rank(a.first) < rank(b.first);
  });
  return pairs;
}

std::string non_finite_text(const std::string& file, const std::string& layer,
                            const NonFinite& found) {
  if (found.count == 0) return {};
  return file + ": " + layer + ": " + format_count(found.count) +
         " pixels are not finite and are left out, the first at (" + std::to_string(found.first_x) +
         ", " + std::to_string(found.first_y) + ")\n";
}

std::string table(const std::vector<LayerError>& errors) {
  std::size_t width = 5;
  for (const LayerError& layer : errors) width = std::max(width, layer.name.size());
  const auto cell = [](const std::string& text) {
    constexpr std::size_t cell_width = 12;
    return std::string(text.size() < cell_width ? cell_width - text.size() : 1, ' ') + text;
  };
  const auto name_cell = [&](const std::string& name) {
    return name + std::string(width - name.size(), ' ');
  };
  std::string text = name_cell("layer") + cell("RMSE") + cell("relMSE") + cell("mean |a-b|") +
                     cell("mean FLIP") + "\n";
  for (const LayerError& layer : errors) {
    text += name_cell(layer.name) + cell(format_number(layer.error.rmse)) +
            cell(format_number(layer.error.relmse)) +
            cell(format_number(layer.error.mean_absolute)) + cell(format_number(layer.flip)) + "\n";
  }
  return text;
}

nlohmann::json non_finite_json(const NonFinite& found) {
  if (found.count == 0) return {{"pixels", 0}};
  return {{"pixels", found.count}, {"first", {found.first_x, found.first_y}}};
}

nlohmann::json layers_json(const std::vector<LayerError>& errors) {
  nlohmann::json layers;
  for (const LayerError& layer : errors) {
    layers[layer.name] = {{"rmse", layer.error.rmse},
                          {"relmse", layer.error.relmse},
                          {"mean_absolute", layer.error.mean_absolute},
                          {"flip", layer.flip},
                          {"pixels", layer.error.pixels},
                          {"non_finite_a", non_finite_json(layer.non_finite_test)},
                          {"non_finite_b", non_finite_json(layer.non_finite_reference)}};
  }
  return layers;
}

}  // namespace

int run_compare(const CompareOptions& options) {
  if (!options.heatmap.empty()) check_writable(options.heatmap);
  const DisplayTransform display(options.display);
  const LayeredImage test = read_layered_image(options.test);
  const LayeredImage reference = read_layered_image(options.reference);
  if (test.width != reference.width || test.height != reference.height) {
    throw CommandError(options.test.string() + ": is " + std::to_string(test.width) + "x" +
                       std::to_string(test.height) + " and " + options.reference.string() + " is " +
                       std::to_string(reference.width) + "x" + std::to_string(reference.height) +
                       "; render both at one size");
  }
  const std::vector<LayerPair> pairs = pair_layers(options, test, reference);
  double exposure = options.exposure;
  if (options.automatic_exposure) {
    exposure = automatic_exposure(reference.layers.at(pairs.front().second).pixels);
  }

  std::vector<LayerError> errors;
  std::vector<float> heat;
  for (const auto& [in_test, in_reference] : pairs) {
    Picture a = test.layers.at(in_test);
    Picture b = reference.layers.at(in_reference);
    LayerError layer;
    layer.name = in_test;
    layer.error = image_error(a, b);
    layer.non_finite_test = find_non_finite(a);
    layer.non_finite_reference = find_non_finite(b);
    display.apply(a, exposure);
    display.apply(b, exposure);
    std::vector<float> flip = flip_map(b, a);
    layer.flip = mean(flip);
    errors.push_back(layer);
    if (heat.empty()) heat = std::move(flip);
  }
  if (!options.heatmap.empty()) {
    StillHeader header;
    header.settings = "compare " + options.test.string() + " " + options.reference.string();
    write_displayed(options.heatmap, heat_picture(heat, test.width, test.height), {}, header);
  }

  if (options.json) {
    std::cout << json_text({{"a", options.test.string()},
                            {"b", options.reference.string()},
                            {"width", test.width},
                            {"height", test.height},
                            {"exposure", exposure},
                            {"display", display.display()},
                            {"view", display.view()},
                            {"layers", layers_json(errors)}});
    return exit_success;
  }
  std::cout << table(errors);
  for (const LayerError& layer : errors) {
    std::cerr << non_finite_text(options.test.string(), layer.name, layer.non_finite_test)
              << non_finite_text(options.reference.string(), layer.name,
                                 layer.non_finite_reference);
  }
  return exit_success;
}

}  // namespace lumivec
