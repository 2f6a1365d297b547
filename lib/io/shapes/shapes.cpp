// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_names.h"
#include "io/command.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <string>
#include <vector>

namespace calotte {

std::vector<Points3> read_shapes(const std::string& path) {
  if (io_detail::suffix_of(path) == ".txt") {
    const Points3 points = read_points(path, Columns::lonlat);
    std::vector<Points3> shapes;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      shapes.emplace_back(points.col(i));
    return shapes;
  }
  if (is_netcdf_file(path))
    return shores(read_coast(path));
  try {
    return read_lines(path);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::parse)
      throw;
    return shores(read_coast(path)); // of polygons
  }
}

} // namespace calotte
