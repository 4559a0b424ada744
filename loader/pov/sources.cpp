#include "loader/pov/sources.h"

#include <algorithm>
#include <stdexcept>

namespace lumivec::pov {
namespace {

namespace fs = std::filesystem;

// Where packages install the standard includes, and the fonts that links there lead to.
constexpr const char* installed_includes[] = {"/usr/share/povray-3.7/include",
                                              "/usr/local/share/povray-3.7/include",
                                              "/usr/share/fonts/truetype/povray"};

fs::path real_path(const fs::path& path) {
  std::error_code error;
  const fs::path result = fs::canonical(path, error);
  return error ? fs::path() : result;
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

// Scenes of DOS separate folders by backslashes.
std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

}  // namespace

Sources::Sources(const fs::path& scene, const LoadOptions& options) : options_(options) {
  scene_folder_ = real_path(scene.has_parent_path() ? scene.parent_path() : fs::path("."));
  roots_.push_back(scene_folder_);
  for (const fs::path& path : options.include_paths) roots_.push_back(real_path(path));
  for (const char* path : installed_includes) roots_.push_back(real_path(path));
  std::erase(roots_, fs::path());
}

std::uint32_t Sources::add(std::string name, const fs::path& file, std::string_view text,
                           Symbols& symbols, std::uint64_t most_bytes) {
  auto source = std::make_unique<Source>();
  source->name = std::move(name);
  source->file = file;
  source->folder = file.empty() ? scene_folder_ : file.parent_path();
  source->text = lex(text, symbols, most_bytes);
  bytes_ += source->text.tokens.size() * sizeof(Token) + text.size();
  sources_.push_back(std::move(source));
  return static_cast<std::uint32_t>(sources_.size() - 1);
}

// The scene's folder comes first, then that of the including file, then the include paths in order.
std::optional<fs::path> Sources::find(const std::string& name, std::uint32_t from,
                                      bool& outside) const {
  std::vector<fs::path> folders = {scene_folder_};
  if (from < sources_.size()) folders.push_back(sources_[from]->folder);
  folders.insert(folders.end(), roots_.begin(), roots_.end());
  for (const fs::path& folder : folders) {
    const fs::path file = real_path(folder / name);
    if (file.empty()) continue;
    const auto holds = [&](const fs::path& root) { return is_inside(file, root); };
    if (options_.allow_outside_files || std::any_of(roots_.begin(), roots_.end(), holds)) {
      return file;
    }
    outside = true;
  }
  return std::nullopt;
}

fs::path Sources::find_or_throw(const std::string& name, std::uint32_t from) const {
  bool outside = false;
  if (name.find('\0') == std::string::npos) {
    if (auto file = find(name, from, outside)) return *file;
    if (auto file = find(with_slashes(name), from, outside)) return *file;
  }
  if (outside) {
    throw FileProblem{"the file \"" + name + "\" lies outside the scene's folder",
                      "give its folder by --include-path, or allow it by --allow-outside-files"};
  }
  throw FileProblem{"the file \"" + name + "\" is not in the scene's folder or an include path",
                    "give its folder by --include-path"};
}

ByteSource Sources::open(const std::string& name, const fs::path& file) const {
  ByteSource bytes;
  try {
    bytes = ByteSource::open(file, false);
  } catch (const std::runtime_error& error) {
    throw FileProblem{"the file \"" + name + "\" cannot be opened: " + error.what(),
                      "check its permissions"};
  }
  opened_.insert(file);
  if (bytes.size() > options_.language.max_file_bytes) {
    throw FileProblem{"the file \"" + name + "\" has " + std::to_string(bytes.size()) +
                          " bytes, more than the limit of " +
                          std::to_string(options_.language.max_file_bytes),
                      "raise it by --max-file-size if the scene is trusted"};
  }
  return bytes;
}

std::uint32_t Sources::include(const std::string& name, std::uint32_t from, Symbols& symbols,
                               std::uint64_t most_bytes) {
  const fs::path file = find_or_throw(name, from);
  for (std::uint32_t i = 0; i < sources_.size(); ++i) {
    if (sources_[i]->file == file) return i;
  }
  const ByteSource bytes = open(name, file);
  std::string text(bytes.size(), '\0');
  bytes.read(0, text.data(), text.size());
  return add(name, file, text, symbols, most_bytes);
}

std::vector<std::uint8_t> Sources::read(const std::string& name, std::uint32_t from) const {
  const ByteSource bytes = open(name, find_or_throw(name, from));
  return bytes.read(0, bytes.size());
}

std::vector<fs::path> Sources::files() const {
  return {opened_.begin(), opened_.end()};
}

bool Sources::exists(const std::string& name, std::uint32_t from) const {
  bool outside = false;
  return find(name, from, outside).has_value();
}

}  // namespace lumivec::pov
