// POV-Ray scenes from text, for tests of the language.
#pragma once

#include <string>

#include "loader/error.h"
#include "loader/pov/read_pov.h"

namespace lumivec::test {

inline pov::PovScene parse_text(const std::string& text, const LoadOptions& options = {}) {
  LoadReport report;
  return pov::parse_pov("scene.pov", text, options, report);
}

// What the scene's #debug says.
inline std::string debug_of(const std::string& text, const LoadOptions& options = {}) {
  return parse_text(text, options).debug_text;
}

// The line of the error; empty: there is none.
inline std::string error_of_text(const std::string& text, const LoadOptions& options = {}) {
  try {
    parse_text(text, options);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

}  // namespace lumivec::test
