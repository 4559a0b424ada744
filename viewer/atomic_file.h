// Files that are there in full or not at all: written beside their place under another name, then
// renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace lumivec {

// Calls write with the path of a new file in file's folder; when it returns, that file is flushed
// to the disk and takes file's place. If it throws, or the disk refuses, the new file is removed
// and whatever was at file is untouched. A symbolic link at file is followed. Throws CommandError,
// and what write throws.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write);

void write_text_atomically(const std::filesystem::path& file, const std::string& text);

// Throws CommandError unless a file can be made at this place: its folder exists and takes new
// files, and the place is free or holds a regular file. Makes and removes a file to know.
void check_writable(const std::filesystem::path& file);

}  // namespace lumivec
