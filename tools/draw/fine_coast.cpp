// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/fine_coast.h"

#include <calotte/error.h>
#include <calotte/read.h>
#include <calotte/widths.h>

#include <array>
#include <filesystem>
#include <system_error>

namespace calotte::tools {

namespace {

constexpr double coarse = 16;        ///< km of a pixel from which on these coasts suffice:
constexpr double coarse_detail = 50; ///< those of 1:110 million, whose details are so large

/// The files of GSHHG and the size of their details, km (Wessel and Smith, 1996).
struct Resolution {
  const char* name;
  double detail;
};
constexpr std::array<Resolution, 4> resolutions{{{"binned_GSHHS_l.nc", 5},
                                                 {"binned_GSHHS_i.nc", 1},
                                                 {"binned_GSHHS_h.nc", 0.2},
                                                 {"binned_GSHHS_f.nc", 0.04}}};

/// The path of the file that suits the pixels; "" if there is none.
std::string file_for(double pixel, const std::string& folder) {
  std::string found;
  double detail = coarse_detail;
  for (const Resolution& resolution : resolutions) {
    const std::filesystem::path path = std::filesystem::path(folder) / resolution.name;
    std::error_code error;
    if (detail > 1.5 * pixel && std::filesystem::is_regular_file(path, error)) {
      found = path;
      detail = resolution.detail;
    }
  }
  return found;
}

bool is_small(const Points3& ring, double size) {
  return ((ring.colwise() - ring.col(0)).colwise().squaredNorm().array() < size * size).all();
}

} // namespace

std::vector<Points3> fine_coast(double pixel, const std::string& folder) {
  const std::string path = pixel < coarse ? file_for(pixel, folder) : "";
  if (path.empty()) {
    return {};
  }
  try {
    std::vector<Points3> rings = read_coast(path).rings;
    std::erase_if(rings, [&](const Points3& ring) {
      return ring.cols() == 0 || is_small(ring, 3 * pixel / earth_radius_km);
    });
    return rings;
  } catch (const Error&) {
    return {}; // a damaged file of another package spoils no picture
  }
}

} // namespace calotte::tools
