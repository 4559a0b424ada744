#include "viewer/display_transform.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "viewer/errors.h"
#include "viewer/ocio_config.h"
#include "viewer/rows.h"
#include "viewer/suggestion.h"

namespace OCIO = OCIO_NAMESPACE;

namespace lumivec {
namespace {

bool same_but_for_case(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

// The known name that is wanted; kind says what it names, "display" or "view of display 'sRGB'".
std::string find_name(const std::string& option, const std::string& wanted,
                      const std::vector<std::string>& known, const std::string& kind) {
  for (const std::string& name : known) {
    if (same_but_for_case(name, wanted)) return name;
  }
  throw UsageError(option + ": '" + wanted + "' is no " + kind + "; " + suggestion(wanted, known));
}

}  // namespace

struct DisplayTransform::Processor {
  OCIO::ConstCPUProcessorRcPtr cpu;
};

DisplayOptions find_display(const DisplayOptions& options) {
  const OCIO::ConstConfigRcPtr config = load_ocio_config(options.config);
  DisplayOptions found = options;
  found.display = options.display.empty()
                      ? config->getDefaultDisplay()
                      : find_name("--display", options.display, display_names(config), "display");
  found.view = options.view.empty()
                   ? config->getDefaultView(found.display.c_str())
                   : find_name("--view", options.view, view_names(config, found.display),
                               "view of display '" + found.display + "'");
  if (!options.look.empty()) {
    const std::vector<std::string> looks = look_names(config);
    if (looks.empty()) throw UsageError("--look: the configuration has no looks; leave it out");
    found.look = find_name("--look", options.look, looks, "look");
  }
  return found;
}

DisplayTransform::DisplayTransform(const DisplayOptions& options) : names_(find_display(options)) {
  const OCIO::ConstConfigRcPtr config = load_ocio_config(options.config);
  processor_ = std::make_unique<Processor>();
  processor_->cpu =
      display_processor(config, names_.display, names_.view, names_.look)->getDefaultCPUProcessor();
}

DisplayTransform::~DisplayTransform() = default;
DisplayTransform::DisplayTransform(DisplayTransform&&) noexcept = default;
DisplayTransform& DisplayTransform::operator=(DisplayTransform&&) noexcept = default;

bool DisplayTransform::is_srgb() const {
  return same_but_for_case(names_.display.substr(0, 4), "sRGB");
}

void DisplayTransform::apply(Picture& picture, double exposure) const {
  const float scale = float(std::exp2(exposure));
  const auto clean = [scale](float v) {
    const float exposed = v * scale;
    return std::isfinite(exposed) ? std::clamp(exposed, -most_displayed, most_displayed) : 0.0f;
  };
  for_each_row(picture.height, [&](int y) {
    Color* row = picture.pixels.data() + std::size_t(y) * std::size_t(picture.width);
    std::for_each(row, row + picture.width,
                  [&](Color& c) { c = Color(clean(c.x), clean(c.y), clean(c.z)); });
    OCIO::PackedImageDesc description(row, picture.width, 1, 3);
    processor_->cpu->apply(description);
  });
}

}  // namespace lumivec
