#include "viewer/window/new_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "viewer/errors.h"

namespace fs = std::filesystem;

namespace lumivec {

NewFiles::NewFiles(const fs::path& folder, const std::string& stem,
                   const std::vector<std::string>& extensions) {
  constexpr int most = 9999;
  for (int i = 1; i <= most; ++i) {
    char number[16];
    std::snprintf(number, sizeof(number), "_%04d", i);
    for (const std::string& extension : extensions) {
      const fs::path file = folder / (stem + number + extension);
      const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor < 0) {
        const int reason = errno;
        remove();
        if (reason == EEXIST) break;
        throw CommandError(file.string() + ": cannot be written: " +
                           std::error_code(reason, std::generic_category()).message() +
                           "; choose another folder with -o");
      }
      close(descriptor);
      files_.push_back(file);
    }
    if (files_.size() == extensions.size()) return;
  }
  throw CommandError(folder.string() + ": holds 9999 pictures of this scene; move some away");
}

NewFiles::~NewFiles() {
  if (!kept_) remove();
}

void NewFiles::remove() noexcept {
  std::error_code error;
  for (const fs::path& file : files_) fs::remove(file, error);
  files_.clear();
}

}  // namespace lumivec
