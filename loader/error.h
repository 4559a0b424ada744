// The one exception of the loader: a file that cannot be loaded, said in a line that its author can
// act on.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace lumivec {

// With a space for each control character: what a file says of itself may hold line breaks.
inline std::string one_line(std::string text) {
  for (char& c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) c = ' ';
  }
  return text;
}

// what() reads "FILE: WHERE: PROBLEM; REMEDY", without the parts that are empty.
class SceneError : public std::runtime_error {
 public:
  // file: as the user named it. where: line and column, a glTF path such as /meshes/3/primitives/0,
  // or empty. problem: what is wrong, with the numbers. remedy: what to do about it.
  SceneError(std::string file, std::string where, std::string problem, std::string remedy)
      : std::runtime_error(join(file, where, problem, remedy)),
        file_(std::move(file)),
        where_(std::move(where)) {}

  const std::string& file() const { return file_; }
  const std::string& where() const { return where_; }

 private:
  static std::string join(const std::string& file, const std::string& where,
                          const std::string& problem, const std::string& remedy) {
    std::string line = file;
    if (!where.empty()) line += ": " + where;
    line += ": " + problem;
    if (!remedy.empty()) line += "; " + remedy;
    return one_line(std::move(line));
  }

  std::string file_;
  std::string where_;
};

}  // namespace lumivec
