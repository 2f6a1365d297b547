// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/temporary_file.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace calotte::io_detail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view suffix = ".part";

/// Whether a text is PID-K.
bool is_number_pair(std::string_view text) {
  const std::size_t dash = text.find('-');
  return dash != 0 && dash != std::string_view::npos && dash + 1 < text.size() &&
         text.find_first_not_of("0123456789") == dash &&
         text.find_first_not_of("0123456789", dash + 1) == std::string_view::npos;
}

/// Whether this is the file that the path names, still.
bool is_named(int descriptor, const std::string& path) {
  struct stat file = {}, named = {};
  return ::fstat(descriptor, &file) == 0 && ::stat(path.c_str(), &named) == 0 &&
         file.st_ino == named.st_ino && file.st_dev == named.st_dev;
}

bool lock(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0; }

/// The temporary files of a place, of any process.
std::vector<std::string> temporaries_of(const fs::path& place) {
  const std::string start = place.filename().string().append(suffix);
  std::vector<std::string> found;
  const fs::path folder = place.parent_path();
  // The directory iterator of libstdc++ ends the program where memory is short.
  const auto close = [](DIR* opened) { ::closedir(opened); };
  const std::unique_ptr<DIR, decltype(close)> listed(
      ::opendir(folder.empty() ? "." : folder.c_str()), close);
  while (const dirent* const file = listed ? ::readdir(listed.get()) : nullptr) {
    const std::string_view name = file->d_name;
    if (name.starts_with(start) && is_number_pair(name.substr(start.size())))
      found.push_back(folder / name);
  }
  return found;
}

void remove_unless_locked(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0)
    return;
  if (lock(descriptor) && is_named(descriptor, path))
    ::unlink(path.c_str());
  ::close(descriptor);
}

} // namespace

TemporaryFile open_temporary(const std::string& place) {
  for (const std::string& path : temporaries_of(place))
    remove_unless_locked(path);
  TemporaryFile file;
  // Another process may write a file of the same name: never write into it.
  for (int attempt = 0; attempt < 100; ++attempt) {
    file.path =
        place + std::string(suffix) + std::to_string(::getpid()) + "-" + std::to_string(attempt);
    file.descriptor = ::open(file.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file.descriptor < 0 && errno != EEXIST)
      return file;
    if (file.descriptor < 0)
      continue;
    // Not every file system has locks. Before it is locked, another process may take the file for a
    // leftover and remove it.
    lock(file.descriptor);
    if (is_named(file.descriptor, file.path)) {
      file.lock = ::fcntl(file.descriptor, F_DUPFD_CLOEXEC, 0);
      return file;
    }
    ::close(file.descriptor);
    file.descriptor = -1;
  }
  errno = EEXIST;
  return file;
}

} // namespace calotte::io_detail
