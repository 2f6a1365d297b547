// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_names.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace calotte::io_detail {

std::string suffix_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

std::optional<std::string> sibling(const std::string& path, std::string_view stem,
                                   std::string_view other) {
  const std::filesystem::path file(path);
  const std::string name = file.filename();
  if (!name.starts_with(stem))
    return std::nullopt;
  return (file.parent_path() / (std::string(other) + name.substr(stem.size()))).string();
}

} // namespace calotte::io_detail
