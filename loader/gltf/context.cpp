#include "loader/gltf/context.h"

#include <limits>

#include "loader/error.h"

namespace lumivec::gltf {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& file) {
  const std::filesystem::path parent = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(parent, error);
  return error ? parent : folder;
}

}  // namespace

std::string pointer(std::initializer_list<std::variant<std::string_view, std::size_t>> parts) {
  std::string path;
  for (const auto& part : parts) {
    path += '/';
    if (const auto* name = std::get_if<std::string_view>(&part)) {
      path += *name;
    } else {
      path += std::to_string(std::get<std::size_t>(part));
    }
  }
  return path;
}

std::string printable(std::string_view text) {
  constexpr std::size_t readable = 200;  // characters of one quoted name
  std::string line(text.substr(0, readable));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  if (text.size() > readable) line += "...";
  return line;
}

Context::Context(const std::filesystem::path& file_name, const LoadOptions& load_options,
                 LoadReport& load_report)
    : file(file_name.string()),
      folder(folder_of(file_name)),
      options(load_options),
      report(load_report) {}

void Context::fail(std::string_view where, std::string_view problem,
                   std::string_view remedy) const {
  if (remedy.empty()) remedy = "export the file again, or repair it by what a glTF validator says";
  throw SceneError(file, std::string(where), std::string(problem), std::string(remedy));
}

void Context::warn(std::string_view where, std::string_view message) {
  if (report.warnings.size() >= max_warnings) {
    ++warnings_left_out_;
    return;
  }
  report.warnings.push_back({one_line(std::string(where)), one_line(std::string(message))});
}

void Context::finish_warnings() {
  if (warnings_left_out_ == 0) return;
  report.warnings.push_back({"", std::to_string(warnings_left_out_) + " more warnings"});
  warnings_left_out_ = 0;
}

void Context::claim(std::uint64_t bytes, std::string_view where) {
  const std::uint64_t before = claimed_.fetch_add(bytes);
  if (bytes <= options.max_bytes && before <= options.max_bytes - bytes) return;
  claimed_.fetch_sub(bytes);
  fail(where,
       "needs " + std::to_string(bytes) + " bytes, after " + std::to_string(before) +
           ", and would pass the limit of " + std::to_string(options.max_bytes),
       "raise the limit on decoded bytes if the file is trusted");
}

void Context::claim(std::uint64_t count, std::uint64_t size, std::string_view where) {
  std::uint64_t bytes = 0;
  if (__builtin_mul_overflow(count, size, &bytes))
    bytes = std::numeric_limits<std::uint64_t>::max();
  claim(bytes, where);
}

}  // namespace lumivec::gltf
