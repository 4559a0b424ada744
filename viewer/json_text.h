// JSON as the commands print it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lumivec {

// Indented and ended by a line break. Names in files need not be UTF-8: what is not becomes U+FFFD.
inline std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace lumivec
