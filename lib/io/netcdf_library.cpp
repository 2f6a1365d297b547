// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf_library.h"

#include <algorithm>

namespace calotte::io_detail {

std::mutex& netcdf_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::string netcdf_path(const std::string& path) {
  std::string plain = path.starts_with('/') ? path : "./" + path;
  const auto doubled = [](char a, char b) { return a == '/' && b == '/'; };
  plain.erase(std::unique(plain.begin(), plain.end(), doubled), plain.end());
  return plain;
}

} // namespace calotte::io_detail
