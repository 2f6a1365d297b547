// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/temporary_file.h"

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

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

/// Finds the temporary files of a target, of any process.
std::vector<std::string> find_temporaries(const fs::path& target) {
  const std::string start = target.filename().string().append(suffix);
  std::vector<std::string> found;
  const fs::path folder = target.parent_path();
  for_each_name(folder, [&](std::string_view name) {
    if (name.starts_with(start) && is_number_pair(name.substr(start.size())))
      found.push_back(folder / name);
  });
  return found;
}

void remove_unless_locked(const std::string& path) {
  const Descriptor file = Descriptor::to_lock(path);
  if (file && file.lock() && file.is_named(path))
    remove_file(path);
}

} // namespace

TemporaryFile open_temporary(const std::string& target) {
  for (const std::string& path : find_temporaries(target))
    remove_unless_locked(path);
  // Another process may write a file of the same name: never write into it.
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string path =
        target + std::string(suffix) + std::to_string(process_id()) + "-" + std::to_string(attempt);
    Descriptor file = Descriptor::to_write_new(path);
    if (!file && errno != EEXIST)
      return {.error = errno};
    if (!file)
      continue;
    // Not every file system has locks. Before it is locked, another process may take the file for a
    // leftover and remove it.
    file.lock();
    if (file.is_named(path)) {
      Descriptor lock = file.duplicate();
      return {.path = std::move(path), .file = std::move(file), .lock = std::move(lock)};
    }
  }
  return {.error = EEXIST};
}

} // namespace calotte::io_detail
