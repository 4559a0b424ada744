#include "loader/pov/data_files.h"

#include <cctype>
#include <charconv>
#include <optional>

#include "loader/pov/string_escapes.h"
#include "loader/pov/strings.h"

namespace lumivec::pov {
namespace {

void skip_separators(DataFile& file) {
  while (file.position < file.text.size()) {
    const auto c = static_cast<unsigned char>(file.text[file.position]);
    if (!std::isspace(c) && c != ',') return;
    ++file.position;
  }
}

std::optional<double> read_float(DataFile& file) {
  skip_separators(file);
  const char* end = file.text.data() + file.text.size();
  const char* begin = file.text.data() + file.position;
  double sign = 1.0;
  while (begin < end && (*begin == '-' || *begin == '+')) {
    if (*begin++ == '-') sign = -sign;
  }
  double value = 0.0;
  const auto [after, error] = std::from_chars(begin, end, value);
  if (error != std::errc()) return std::nullopt;
  file.position = static_cast<std::size_t>(after - file.text.data());
  return sign * value;
}

[[noreturn]] void fail_in(Parser& parser, const DataFile& file, const std::string& wanted) {
  parser.fail("the file \"" + file.name + "\" holds no " + wanted + " at byte " +
              std::to_string(file.position));
}

Value read_value(Parser& parser, DataFile& file) {
  const char first = file.text[file.position];
  if (first == '"') {
    const std::size_t end = file.text.find('"', file.position + 1);
    if (end == std::string::npos) fail_in(parser, file, "end of the string that begins");
    const std::string text = file.text.substr(file.position + 1, end - file.position - 1);
    file.position = end + 1;
    parser.claim(text.size());
    return string_value(replace_escapes(text));
  }
  Number number;
  if (first != '<') {
    const auto value = read_float(file);
    if (!value) fail_in(parser, file, "number");
    number = Number(*value);
  } else {
    ++file.position;
    number.size = 0;
    for (;;) {
      skip_separators(file);
      if (file.position < file.text.size() && file.text[file.position] == '>') break;
      const auto value = read_float(file);
      if (!value || number.size == number.n.size()) fail_in(parser, file, "vector");
      number.n[number.size++] = *value;
    }
    ++file.position;
    if (number.size < 2) fail_in(parser, file, "vector");
  }
  return number;
}

std::shared_ptr<DataFile> file_of(Parser& parser, const Token& name) {
  const Slot* slot = name.is_identifier() ? parser.symbols.find(name.word) : nullptr;
  if (!slot || (*slot)->kind != ValueKind::file)
    parser.fail("the name of an open file is expected, but " + parser.describe(name) + " is found");
  return std::const_pointer_cast<DataFile>((*slot)->share<DataFile>());  // made as DataFile
}

}  // namespace

void open_data_file(Parser& parser) {
  const Token name = parser.raw_take();
  const Place place = parser.place();
  if (!name.is_identifier()) parser.fail("#fopen needs a name for the open file");
  const std::string file_name = parse_file_name(parser, "#fopen");
  if (parser.accept(K::write_) || parser.accept(K::append_)) {
    parser.fail_at(place, "#fopen for writing is refused: scenes are not allowed to write files",
                   "write the file by POV-Ray, and include it");
  }
  if (!parser.accept(K::read_)) parser.fail_expected("read, write or append");
  auto file = std::make_shared<DataFile>();
  file->name = file_name;
  try {
    const auto bytes = parser.sources.read(file_name, place.file);
    parser.claim(bytes.size());
    file->text.assign(bytes.begin(), bytes.end());
  } catch (const FileProblem& problem) {
    parser.fail_at(place, problem.problem, problem.remedy);
  }
  parser.symbols.declare(name.word, {ValueKind::file, file});
}

void read_data_file(Parser& parser) {
  if (!parser.raw_take().is('(')) parser.fail("'(' is expected after #read");
  const Token name = parser.raw_take();
  // #read may give the file's own name another meaning.
  const std::shared_ptr<DataFile> held = file_of(parser, name);
  DataFile& file = *held;
  for (;;) {
    Token token = parser.raw_take();
    if (token.is(')')) break;
    if (token.is(',')) token = parser.raw_take();
    if (!token.is_identifier())
      parser.fail("the name of a variable to read is expected, but " + parser.describe(token) +
                  " is found");
    skip_separators(file);
    if (file.position >= file.text.size()) {
      // What is asked for beyond the end keeps its value.
      if (!parser.symbols.find(token.word)) parser.symbols.declare(token.word, Number(0.0));
      continue;
    }
    parser.symbols.declare(token.word, read_value(parser, file));
  }
  skip_separators(file);
  const Slot* slot = parser.symbols.find(name.word);
  const bool still_named = slot && (*slot)->kind == ValueKind::file && (*slot)->thing == held;
  if (file.position >= file.text.size() && still_named) parser.symbols.undefine(name.word);
}

void close_data_file(Parser& parser) {
  const Token name = parser.raw_take();
  const Slot* slot = name.is_identifier() ? parser.symbols.find(name.word) : nullptr;
  if (slot && (*slot)->kind == ValueKind::file) parser.symbols.undefine(name.word);
}

}  // namespace lumivec::pov
