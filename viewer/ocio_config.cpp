#include "viewer/ocio_config.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "viewer/builtin_config.h"

namespace OCIO = OCIO_NAMESPACE;

namespace lumivec {
namespace {

constexpr const char* builtin_name = "builtin";

OCIO::ConstConfigRcPtr load_builtin_config() {
  std::istringstream text{std::string(builtin_config())};
  return OCIO::Config::CreateFromStream(text);
}

// OpenColorIO's messages run over several lines.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

// The name under which a configuration holds linear Rec. 709, or an empty one: ours and Blender's,
// those of the ACES configurations of OpenColorIO 2 and 1.
std::string linear_rec709_name(const OCIO::ConstConfigRcPtr& config) {
  for (const char* name :
       {"lin_rec709", "lin_rec709_scene", "Linear Rec.709 (sRGB)", "lin_srgb", "Linear Rec.709",
        "Utility - Linear - sRGB", "Utility - Linear - Rec.709"}) {
    if (config->getColorSpace(name)) return name;
  }
  return {};
}

}  // namespace

OCIO::ConstConfigRcPtr load_ocio_config(const std::string& file) {
  const char* variable = std::getenv("OCIO");
  const bool from_environment = file.empty() && variable && *variable;
  const std::string name = from_environment ? variable : file;
  const std::string source = from_environment ? "environment variable OCIO: " + name : name;
  try {
    if (name.empty() || name == builtin_name) return load_builtin_config();
    const bool is_library_name = name.starts_with("ocio://");
    if (!is_library_name && !std::filesystem::is_regular_file(name)) {
      throw DisplayError(source +
                         ": no such file; give an OpenColorIO configuration, or --ocio builtin");
    }
    const OCIO::ConstConfigRcPtr config = OCIO::Config::CreateFromFile(name.c_str());
    if (config->getNumDisplays() == 0) {
      throw DisplayError(source +
                         ": holds no display; give another configuration, or --ocio builtin");
    }
    return config;
  } catch (const OCIO::Exception& error) {
    throw DisplayError(source + ": is not a usable OpenColorIO configuration: " +
                       one_line(error.what()) + "; correct it, or give --ocio builtin");
  } catch (const std::filesystem::filesystem_error& error) {
    throw DisplayError(source + ": cannot be read: " + error.code().message());
  }
}

std::vector<std::string> display_names(const OCIO::ConstConfigRcPtr& config) {
  std::vector<std::string> names;
  for (int i = 0; i < config->getNumDisplays(); ++i) names.emplace_back(config->getDisplay(i));
  return names;
}

std::vector<std::string> view_names(const OCIO::ConstConfigRcPtr& config,
                                    const std::string& display) {
  std::vector<std::string> names;
  for (int i = 0; i < config->getNumViews(display.c_str()); ++i) {
    names.emplace_back(config->getView(display.c_str(), i));
  }
  return names;
}

std::vector<std::string> look_names(const OCIO::ConstConfigRcPtr& config) {
  std::vector<std::string> names;
  for (int i = 0; i < config->getNumLooks(); ++i) names.emplace_back(config->getLookNameByIndex(i));
  return names;
}

OCIO::ConstProcessorRcPtr display_processor(const OCIO::ConstConfigRcPtr& config,
                                            const std::string& display, const std::string& view,
                                            const std::string& look) {
  try {
    const std::string named = linear_rec709_name(config);
    const std::string source = named.empty() ? OCIO::ROLE_SCENE_LINEAR : named;
    const bool bridged = named.empty() && config->hasRole(OCIO::ROLE_INTERCHANGE_SCENE);
    const OCIO::GroupTransformRcPtr all =
        bridged ? OCIO::Config::GetProcessorFromConfigs(load_builtin_config(), "lin_rec709", config,
                                                        OCIO::ROLE_SCENE_LINEAR)
                      ->createGroupTransform()
                : OCIO::GroupTransform::Create();
    if (!look.empty()) {
      const OCIO::LookTransformRcPtr looked = OCIO::LookTransform::Create();
      looked->setSrc(source.c_str());
      looked->setDst(source.c_str());
      looked->setLooks(look.c_str());
      all->appendTransform(looked);
    }
    const OCIO::DisplayViewTransformRcPtr to_display = OCIO::DisplayViewTransform::Create();
    to_display->setSrc(source.c_str());
    to_display->setDisplay(display.c_str());
    to_display->setView(view.c_str());
    to_display->setLooksBypass(!look.empty());
    all->appendTransform(to_display);
    return config->getProcessor(all);
  } catch (const OCIO::Exception& error) {
    throw DisplayError("display '" + display + "', view '" + view + "'" +
                       (look.empty() ? "" : ", look '" + look + "'") + ": cannot be computed: " +
                       one_line(error.what()) + "; choose another --view or --display");
  }
}

}  // namespace lumivec
