// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "scratch_file.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <cmath>
#include <string>

using namespace calotte;

/// Lines in GeoJSON: their places are on the sphere.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string path = fuzz::scratch_file("lines.geojson", data, size);
    for (const Points3& line : read_lines(path)) {
      fuzz::require(line.cols() > 0);
      for (Eigen::Index k = 0; k < line.cols(); ++k)
        fuzz::require(std::abs(line.col(k).norm() - 1) < 1e-15);
    }
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
  return 0;
}
