// The URIs of glTF: data inside the JSON, or files beside the scene file and nowhere else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "loader/gltf/context.h"

namespace lumivec::gltf {

bool is_data_uri(std::string_view uri);

// The bytes of a data URI, base64 or percent-encoded; none if it is malformed.
std::optional<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri);

// Does the URI name a resource that only a network or another program could provide?
bool is_remote_uri(std::string_view uri);

// The existing file that a relative (or file:) URI names, with every symbolic link resolved; none
// if there is no such file. Fails if the file lies outside the scene's folder and
// LoadOptions::allow_outside_files is not set, whether it exists or not.
std::optional<std::filesystem::path> find_file(const Context& context, std::string_view where,
                                               std::string_view uri);

}  // namespace lumivec::gltf
