// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/read.h>

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

/// The coasts of GSHHG (Wessel and Smith, J. Geophys. Res. 101, 1996), of Debian's package
/// gmt-gshhg-low.
namespace calotte::test {

/// \param resolution c, l or i: crude, low or intermediate.
inline std::string gshhg_file(char resolution) {
  std::string path = CALOTTE_GSHHG "/binned_GSHHS_x.nc";
  path[path.size() - 4] = resolution; // of a sum g++ 12 warns at -O1
  REQUIRE_MESSAGE(std::filesystem::exists(path), path,
                  " is absent; install it: tools/setup --tests");
  return path;
}

inline Coast gshhg(char resolution) { return read_coast(gshhg_file(resolution)); }

} // namespace calotte::test
