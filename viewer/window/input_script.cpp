#include "viewer/window/input_script.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cctype>
#include <fstream>
#include <map>
#include <sstream>

#include "viewer/errors.h"
#include "viewer/suggestion.h"

namespace lumivec {
namespace {

// Commands with the least and the largest number of words after them.
const std::map<std::string, std::pair<std::size_t, std::size_t>>& commands() {
  static const std::map<std::string, std::pair<std::size_t, std::size_t>> known = {
      {"key", {1, 1}},    {"hold", {1, 1}},     {"let", {1, 1}},          {"move", {2, 2}},
      {"wheel", {1, 1}},  {"press", {1, 1}},    {"release", {1, 1}},      {"click", {2, 2}},
      {"double", {2, 2}}, {"drag", {5, 6}},     {"text", {1, 100}},       {"drop", {1, 1}},
      {"resize", {1, 1}}, {"minimise", {0, 0}}, {"restore", {0, 0}},      {"wait", {1, 1}},
      {"frames", {1, 1}}, {"until", {1, 2}},    {"shot", {1, 1}},         {"state", {1, 1}},
      {"copy", {2, 2}},   {"quit", {0, 0}},     {"check-display", {0, 0}}};
  return known;
}

}  // namespace

std::vector<ScriptLine> read_script(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw CommandError(file.string() + ": cannot be read");
  std::vector<ScriptLine> lines;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    ScriptLine line;
    line.number = number;
    std::istringstream words(text);
    for (std::string word; words >> word;) line.words.push_back(word);
    if (line.words.empty() || line.words[0][0] == '#') continue;
    const std::string where = file.string() + ":" + std::to_string(number);
    const auto found = commands().find(line.words[0]);
    if (found == commands().end()) {
      std::vector<std::string> names;
      for (const auto& entry : commands()) names.push_back(entry.first);
      throw CommandError(where + ": there is no '" + line.words[0] + "'; " +
                         suggestion(line.words[0], names));
    }
    const std::size_t arguments = line.words.size() - 1;
    if (arguments < found->second.first || arguments > found->second.second)
      throw CommandError(where + ": '" + line.words[0] + "' has too few or too many words");
    lines.push_back(std::move(line));
  }
  return lines;
}

ScriptKey parse_script_key(const std::string& text, const std::string& where) {
  static const std::map<std::string, int> names = {
      {"Space", GLFW_KEY_SPACE}, {"Tab", GLFW_KEY_TAB},        {"Esc", GLFW_KEY_ESCAPE},
      {"Home", GLFW_KEY_HOME},   {"Enter", GLFW_KEY_ENTER},    {"+", GLFW_KEY_EQUAL},
      {"-", GLFW_KEY_MINUS},     {"[", GLFW_KEY_LEFT_BRACKET}, {"]", GLFW_KEY_RIGHT_BRACKET}};
  static const std::map<std::string, int> modifiers = {
      {"Shift", GLFW_MOD_SHIFT}, {"Ctrl", GLFW_MOD_CONTROL}, {"Alt", GLFW_MOD_ALT}};
  ScriptKey key;
  std::string rest = text;
  for (std::size_t plus = rest.find('+'); plus != std::string::npos && plus > 0;
       plus = rest.find('+')) {
    const auto found = modifiers.find(rest.substr(0, plus));
    if (found == modifiers.end()) break;
    key.modifiers |= found->second;
    rest = rest.substr(plus + 1);
  }
  if (const auto found = names.find(rest); found != names.end()) {
    key.code = found->second;
  } else if (rest.size() == 1 && std::isalnum(static_cast<unsigned char>(rest[0]))) {
    key.code = std::toupper(static_cast<unsigned char>(rest[0]));  // GLFW's codes are ASCII's
  } else if (rest.size() > 1 && rest[0] == 'F' &&
             rest.find_first_not_of("0123456789", 1) == std::string::npos && rest.size() < 4) {
    key.code = GLFW_KEY_F1 + std::stoi(rest.substr(1)) - 1;
  } else {
    throw CommandError(where + ": there is no key '" + text + "'");
  }
  return key;
}

}  // namespace lumivec
