#include <CLI/CLI.hpp>

#include "viewer/commands/common_options.h"
#include "viewer/commands/compare.h"
#include "viewer/errors.h"
#include "viewer/option_values.h"
#include "viewer/still_writer.h"

namespace lumivec {

void add_compare_options(CLI::App& app, CompareOptions& options) {
  add_value_option(app, "A", "", "Picture to judge (OpenEXR)",
                   [&options](const std::string& text) { options.test = text; });
  add_value_option(app, "B", "", "Reference (OpenEXR)",
                   [&options](const std::string& text) { options.reference = text; });
  app.add_option_function<std::vector<std::string>>(
         "--map",
         [&options](const std::vector<std::string>& pairs) {
           for (const std::string& pair : pairs) {
             options.layer_names.push_back(parse_pair("--map", pair));
           }
         },
         "Compare layer X of A with layer Y of B ('beauty': R, G, B); may be repeated")
      ->type_name("X=Y")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->group("Layers");
  app.add_flag("--json", options.json, "Print JSON")->group("Output");
  add_value_option(app, "--heatmap", "OUT.png", "Write a picture of the beauty's FLIP",
                   [&options](const std::string& text) { options.heatmap = text; })
      ->group("Output");
  add_display_options(app, options.automatic_exposure, options.exposure, options.display);
}

void check_compare_options(const CompareOptions& options) {
  if (options.test.empty() || options.reference.empty()) {
    throw UsageError("compare: two pictures are needed; write: lumivec compare A.exr B.exr");
  }
  if (!options.heatmap.empty() && still_format(options.heatmap) == StillFormat::exr) {
    throw UsageError("--heatmap: " + options.heatmap.string() + " is not displayed; use .png");
  }
}

}  // namespace lumivec
