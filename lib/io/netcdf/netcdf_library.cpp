// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_library.h"

#include <calotte/error.h>

#include <netcdf.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <system_error>

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

void require_system(const std::string& path, int code) {
  if (code == NC_ENOMEM || code == ENOMEM)
    throw std::bad_alloc();
  if (code > 0)
    throw Error(ErrorCode::file, "cannot read " + path + ": " +
                                     std::generic_category().message(code) + "; check the disk");
}

} // namespace calotte::io_detail
