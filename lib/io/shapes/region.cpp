// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/shapes/region_file.h"

#include <calotte/error.h>
#include <calotte/read.h>

namespace calotte {
namespace {

using namespace io_detail;

bool is_geojson(const std::string& name) {
  const std::string suffix = suffix_of(name);
  return suffix == ".geojson" || suffix == ".json";
}

void require_format(const std::string& name) {
  refuse_foreign(name);
  if (!is_geojson(name) && suffix_of(name) != ".pts")
    throw Error(ErrorCode::invalid_argument,
                name + ": the name determines no format of regions; name it .geojson, .json or "
                       ".pts");
}

} // namespace

Surface read_region(std::istream& in, const std::string& name) {
  require_format(name);
  return is_geojson(name) ? read_region_geojson(in, name) : read_region_pts(in, name);
}

Surface read_region(const std::string& path) {
  require_format(path);
  std::ifstream in = open_input(path);
  return read_region(in, path);
}

} // namespace calotte
