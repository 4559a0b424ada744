#include "viewer/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "viewer/errors.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

std::string error_text(int error_number) {
  return std::error_code(error_number, std::generic_category()).message();
}

// Where the bytes go in the end: renaming onto a link would replace the link.
fs::path final_place(const fs::path& file) {
  std::error_code error;
  if (!fs::is_symlink(file, error)) return file;
  const fs::path target = fs::weakly_canonical(file, error);
  return error ? file : target;
}

// In the same folder, since a rename is atomic only within a file system; hidden, and unlike any
// other process's.
fs::path temporary_place(const fs::path& file) {
  return file.parent_path() /
         ("." + file.filename().string() + "." + std::to_string(getpid()) + ".tmp");
}

void flush_to_disk(const fs::path& file, const fs::path& shown) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    throw CommandError(shown.string() + ": cannot be written: " + error_text(errno));
  }
  const int result = fsync(descriptor);
  const int reason = errno;
  close(descriptor);
  // Some file systems have no way to flush and say so.
  if (result != 0 && reason != EINVAL && reason != ENOTSUP) {
    throw CommandError(shown.string() + ": cannot be written: " + error_text(reason));
  }
}

}  // namespace

void write_atomically(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  const fs::path place = final_place(file);
  const fs::path temporary = temporary_place(place);
  std::error_code error;
  try {
    write(temporary);
    flush_to_disk(temporary, file);
    fs::rename(temporary, place, error);
    if (error) throw CommandError(file.string() + ": cannot be replaced: " + error.message());
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

void write_text_atomically(const fs::path& file, const std::string& text) {
  write_atomically(file, [&](const fs::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw CommandError(file.string() + ": cannot be written: " + error_text(errno));
  });
}

void check_writable(const fs::path& file) {
  const fs::path place = final_place(file);
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw CommandError(file.string() + ": the folder " + folder.string() +
                       " does not exist; make it first, or choose another place");
  }
  if (fs::exists(place, error) && !fs::is_regular_file(place, error)) {
    throw CommandError(file.string() + ": is not a file and cannot be replaced by one; " +
                       "choose another name");
  }
  const fs::path probe = temporary_place(place);
  const int descriptor = open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    throw CommandError(file.string() + ": the folder " + folder.string() +
                       " takes no new files: " + error_text(errno) + "; choose another place");
  }
  close(descriptor);
  fs::remove(probe, error);
}

}  // namespace lumivec
