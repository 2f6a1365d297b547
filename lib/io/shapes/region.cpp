// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/shapes/region_file.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <filesystem>
#include <optional>
#include <system_error>

namespace calotte {
namespace {

using namespace io_detail;

/// The name of the counts of a file of loops; none for the name of another file.
std::optional<std::string> counts_beside(const std::string& path) {
  return sibling(path, boundaries_name, loop_counts_name);
}

bool is_geojson(const std::string& name) {
  const std::string suffix = suffix_of(name);
  return suffix == ".geojson" || suffix == ".json";
}

void require_format(const std::string& name) {
  refuse_foreign(name);
  if (!counts_beside(name) && !is_geojson(name) && suffix_of(name) != ".pts")
    throw Error(ErrorCode::invalid_argument,
                name + ": the name determines no format of regions; name it .geojson, .json or "
                       ".pts, or SaveBoundaries");
}

} // namespace

Surface read_region(std::istream& in, const std::string& name) {
  require_format(name);
  if (counts_beside(name))
    return read_region_loops(in, name, nullptr, "");
  return is_geojson(name) ? read_region_geojson(in, name) : read_region_pts(in, name);
}

Surface read_region(const std::string& path) {
  require_format(path);
  std::ifstream in = open_input(path);
  const std::optional<std::string> counts = counts_beside(path);
  if (std::error_code error; !counts || !std::filesystem::is_regular_file(*counts, error))
    return read_region(in, path);
  std::ifstream loops = open_input(*counts);
  return read_region_loops(in, path, &loops, *counts);
}

} // namespace calotte
