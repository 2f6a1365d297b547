// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"

#include <calotte/error.h>
#include <calotte/field_grid.h>
#include <calotte/read.h>

#include <sstream>
#include <string>
#include <vector>

using namespace calotte;

namespace {

/// Positions and values: a value of each field for each position, which are finite.
void read_values(const std::string& text, const ColumnChoice& choice) {
  try {
    std::istringstream in(text);
    const FieldGrid read = read_positions(in, "values", choice);
    fuzz::require(read.positions->points.allFinite() &&
                  read.positions->coordinates.cols() == read.size());
    for (const MeshField& field : read.fields)
      fuzz::require(field.values.size() == read.size() && !field.values.array().isInf().any());
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
}

} // namespace

/// Points in text: as many as lines that count, all finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const Columns columns : {Columns::xyz, Columns::lonlat, Columns::xy})
    try {
      std::istringstream in(text);
      const PointLines read = read_point_lines(in, "points", columns);
      fuzz::require(read.points.cols() == std::ssize(read.lines) && read.points.allFinite());
    } catch (const Error& error) {
      fuzz::require(error.code() != ErrorCode::internal);
    }
  read_values(text, {});
  read_values(text, {.plane = true, .position = {"2", "1"}, .fields = {{"b", "3"}}});
  return 0;
}
