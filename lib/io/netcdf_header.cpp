// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf_header.h"

#include <netcdf.h>

#include <algorithm>
#include <cstring>
#include <fstream>

namespace calotte::io_detail {
namespace {

std::int64_t padded(std::int64_t bytes) { return (bytes + 3) / 4 * 4; }

/// Reads a header sequentially by the lengths of its entries.
struct HeaderWalk {
  int id;
  std::int64_t count_size = 4;  ///< of a count, a length or a dimension's id
  std::int64_t offset_size = 8; ///< of an offset

  std::int64_t name(const char* text) const {
    return count_size + padded(static_cast<std::int64_t>(std::strlen(text)));
  }

  /// A list of the attributes of a variable or of the file: tag, number, then each.
  std::int64_t attributes(int variable) const {
    int count = 0;
    if (variable == NC_GLOBAL)
      nc_inq_natts(id, &count);
    else
      nc_inq_varnatts(id, variable, &count);
    std::int64_t bytes = 4 + count_size;
    for (int a = 0; a < count; ++a) {
      char text[NC_MAX_NAME + 1] = "";
      nc_type type = NC_CHAR;
      std::size_t values = 0, size = 1;
      nc_inq_attname(id, variable, a, text);
      nc_inq_att(id, variable, text, &type, &values);
      nc_inq_type(id, type, nullptr, &size);
      bytes += name(text) + 4 + count_size + padded(static_cast<std::int64_t>(values * size));
    }
    return bytes;
  }

  /// From the file's first byte to the end of the global attributes.
  std::int64_t before_variables() const {
    int dimensions = 0;
    nc_inq_ndims(id, &dimensions);
    std::int64_t bytes = 4 + count_size + 4 + count_size;
    for (int d = 0; d < dimensions; ++d) {
      char text[NC_MAX_NAME + 1] = "";
      nc_inq_dimname(id, d, text);
      bytes += name(text) + count_size;
    }
    return bytes + attributes(NC_GLOBAL);
  }

  /// Of one variable, up to its offset.
  std::int64_t variable(int v) const {
    char text[NC_MAX_NAME + 1] = "";
    int dimensions = 0;
    nc_inq_var(id, v, text, nullptr, &dimensions, nullptr, nullptr);
    return name(text) + count_size * (1 + dimensions) + attributes(v) + 4 + count_size;
  }
};

HeaderWalk walk_of(int id) {
  int format = NC_FORMAT_CLASSIC;
  nc_inq_format(id, &format);
  return {id, format == NC_FORMAT_64BIT_DATA ? 8 : 4, format == NC_FORMAT_CLASSIC ? 4 : 8};
}

std::int64_t big_endian(const unsigned char* bytes, std::int64_t size) {
  std::uint64_t value = 0;
  for (std::int64_t i = 0; i < size; ++i)
    value = value << 8 | bytes[i];
  return static_cast<std::int64_t>(value);
}

/// A variable's bytes in one record, or in all where it has none; -1 past 64 bits.
struct Shape {
  std::int64_t bytes = 0;
  bool of_records = false;
};

Shape shape_of(int id, int variable) {
  nc_type type = NC_CHAR;
  int dimensions = 0, unlimited = -1, ids[NC_MAX_VAR_DIMS];
  std::size_t size = 1;
  nc_inq_var(id, variable, nullptr, &type, &dimensions, ids, nullptr);
  nc_inq_type(id, type, nullptr, &size);
  nc_inq_unlimdim(id, &unlimited);
  Shape shape{static_cast<std::int64_t>(size), dimensions > 0 && ids[0] == unlimited};
  for (int d = shape.of_records ? 1 : 0; d < dimensions; ++d) {
    std::size_t length = 0;
    nc_inq_dimlen(id, ids[d], &length);
    if (__builtin_mul_overflow(shape.bytes, static_cast<std::int64_t>(length), &shape.bytes))
      return {-1, shape.of_records};
  }
  return shape;
}

std::int64_t record_count(int id) {
  int unlimited = -1;
  std::size_t records = 0;
  nc_inq_unlimdim(id, &unlimited);
  if (unlimited >= 0)
    nc_inq_dimlen(id, unlimited, &records);
  return static_cast<std::int64_t>(records);
}

/// Ends are limited to the range of 64 bits, which no file exceeds.
void add_ends(int id, std::vector<NetcdfExtent>& extents) {
  std::vector<Shape> shapes;
  std::int64_t record = 0, record_variables = 0;
  bool overflow = false;
  for (int v = 0; v < std::ssize(extents); ++v) {
    shapes.push_back(shape_of(id, v));
    if (!shapes.back().of_records)
      continue;
    overflow |= __builtin_add_overflow(record, padded(shapes.back().bytes), &record);
    ++record_variables;
  }
  const std::int64_t records = record_count(id);
  for (std::size_t v = 0; v < extents.size(); ++v) {
    const Shape& shape = shapes[v];
    NetcdfExtent& extent = extents[v];
    std::int64_t before_last = 0;
    if (shape.of_records)
      extent.stride = record_variables == 1 ? shape.bytes : record;
    if (shape.of_records && records > 0)
      overflow |= __builtin_mul_overflow(extent.stride, records - 1, &before_last);
    overflow |= shape.bytes < 0 ||
                __builtin_add_overflow(before_last, extent.begin, &before_last) ||
                __builtin_add_overflow(before_last, shape.bytes, &extent.end);
    if (shape.of_records && records == 0)
      extent.end = extent.begin;
    if (overflow)
      extent.end = INT64_MAX;
  }
}

} // namespace

NetcdfLayout classic_layout(int id, const std::string& path) {
  const HeaderWalk walk = walk_of(id);
  int variables = 0;
  nc_inq_nvars(id, &variables);
  std::ifstream in(path, std::ios::binary);
  NetcdfLayout layout{walk.before_variables() + 4 + walk.count_size, {}};
  for (int v = 0; v < variables; ++v) {
    unsigned char bytes[8] = {};
    in.seekg(layout.header + walk.variable(v));
    in.read(reinterpret_cast<char*>(bytes), walk.offset_size);
    layout.header += walk.variable(v) + walk.offset_size;
    layout.variables.push_back({.begin = big_endian(bytes, walk.offset_size)});
  }
  add_ends(id, layout.variables);
  return layout;
}

bool needs_cdf5(const std::vector<std::int64_t>& variable_bytes) {
  // The header holds a variable's size in 32 bits, rounded up to 4 bytes.
  constexpr std::int64_t most = (std::int64_t{1} << 32) - 4;
  return std::any_of(variable_bytes.begin(), variable_bytes.end(),
                     [](std::int64_t bytes) { return bytes >= most; });
}

} // namespace calotte::io_detail
