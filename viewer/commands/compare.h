// `lumivec compare`: how far a picture is from a reference, for the beauty and every layer that
// both hold.
//
// RMSE, relMSE = mean((a − b)² / (b² + 0.01)) and the mean absolute error are of the radiance; ꟻLIP
// is of the picture as it is displayed, with the same exposure and view for both.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "viewer/display_transform.h"

namespace CLI {
class App;
}

namespace lumivec {

struct CompareOptions {
  std::filesystem::path test;
  std::filesystem::path reference;
  std::vector<std::pair<std::string, std::string>> layer_names;  // in test, in reference
  std::filesystem::path heatmap;                                 // empty: none
  bool automatic_exposure = false;                               // of the reference's beauty
  double exposure = 0.0;                                         // stops
  DisplayOptions display;
  bool json = false;
};

void add_compare_options(CLI::App& app, CompareOptions& options);
void check_compare_options(const CompareOptions& options);  // throws UsageError
int run_compare(const CompareOptions& options);             // returns the exit status

}  // namespace lumivec
