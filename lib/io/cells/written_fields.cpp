// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/written_fields.h"

#include "io/bytes/utf8.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace calotte::io_detail {
namespace {

/// The library's own, for integers.
constexpr std::int32_t no_int = std::numeric_limits<std::int32_t>::min() + 1;

template <class T> T written_as(double value) {
  if constexpr (std::is_same_v<T, double>)
    return value;
  else
    return std::isnan(value) ? no_int : static_cast<T>(value);
}

/// In the order of a file, in which leading dimensions come before the location's.
template <class T> NetcdfWriter::Fill<T> contents_of(const MeshField& field) {
  const double* const values = field.values.data();
  std::int64_t before = 1;
  for (int d = 0; d < field.leading; ++d)
    before *= field.dimensions[static_cast<std::size_t>(d)].size;
  const std::int64_t after = field.count() / before, places = field.values.size() / field.count();
  const std::int64_t rows = field.leading > 0 ? field.dimensions[0].size : places;
  const std::int64_t width = field.values.size() / std::max<std::int64_t>(rows, 1);
  return [=](std::int64_t begin, std::int64_t end, T* out) {
    for (std::int64_t k = begin * width; k < end * width; k += after) {
      const std::int64_t place = k / after % places, leading = k / after / places;
      const double* const from = values + (place * before + leading) * after;
      out = std::transform(from, from + after, out, written_as<T>);
    }
  };
}

const FieldPlace& place_of(const FieldPlaces& places, Location location) {
  return location == Location::cells   ? places.cells
         : location == Location::edges ? places.edges
                                       : places.vertices;
}

bool is_name_of_mesh(const NetcdfMeshNames& names, const std::string& name) {
  return names.variables.contains(name) || names.lists.contains(name) ||
         names.derived.contains(name);
}

/// SCRIP and ESMF have a mask of their own, which takes that of either.
bool is_kept_as_mask(const NetcdfMeshNames& names, const MeshField& field) {
  return is_mask(field) &&
         (names.derived.contains("grid_imask") || names.derived.contains("elementMask"));
}

// ---- Names

bool is_letter_or_digit(unsigned char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9');
}

/// A name that NetCDF takes: no white space, no /, no control characters, and no sign at the start.
std::string netcdf_name(std::string_view name) {
  constexpr std::size_t longest = 200; // bytes; the library takes 256
  name = name.substr(0, longest);
  std::string out;
  while (!name.empty()) {
    const auto c = static_cast<unsigned char>(name[0]);
    const bool sign = std::string_view("_.+-@").find(name[0]) != std::string_view::npos;
    const std::size_t size = c >= 0x80
                                 ? bytes_of_character(name)
                                 : is_letter_or_digit(c) || (sign && !(out.empty() && c != '_'));
    out += size > 0 ? std::string(name.substr(0, size)) : "_";
    name.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return out.empty() ? "field" : out;
}

} // namespace

bool can_hold(const NetcdfMeshNames& names, const MeshField& field) {
  const bool has_place = field.location == Location::cells   ? !names.cells.empty()
                         : field.location == Location::edges ? !names.edges.empty()
                                                             : !names.vertices.empty();
  return has_place && (is_kept_as_mask(names, field) || !is_name_of_mesh(names, field.name));
}

void add_fields(NetcdfGridFile& file, const WriteOptions& options, const FieldPlaces& places,
                const NetcdfMeshNames& names) {
  for (const MeshField& field : options.fields) {
    const FieldPlace& place = place_of(places, field.location);
    if (place.dimension < 0 || is_name_of_mesh(names, field.name) || is_kept_as_mask(names, field))
      continue;
    NetcdfAttributes attributes = place.attributes;
    if (!field.units.empty())
      attributes.push_back({"units", field.units});
    if (!field.long_name.empty())
      attributes.push_back({"long_name", field.long_name});
    std::vector<int> dimensions;
    for (const FieldDimension& dimension : field.dimensions)
      dimensions.push_back(
          file.netcdf().field_dimension(netcdf_name(dimension.name), dimension.size));
    dimensions.insert(dimensions.begin() + field.leading, place.dimension);
    if (field.integer && field.values.hasNaN())
      attributes.push_back({"_FillValue", no_int});
    if (field.integer)
      file.ints(field.name, dimensions, attributes, contents_of<std::int32_t>(field));
    else
      file.doubles(field.name, dimensions, attributes, contents_of<double>(field));
  }
}

std::vector<std::array<std::string, 2>> replace_names(std::vector<MeshField>& fields) {
  std::vector<std::array<std::string, 2>> renamed;
  std::set<std::string> used;
  for (MeshField& field : fields) {
    std::string name = netcdf_name(field.name);
    const std::string stem = name;
    for (int k = 2; !used.insert(name).second; ++k)
      name = stem + "_" + std::to_string(k);
    if (name == field.name)
      continue;
    renamed.push_back({field.name, name});
    if (field.long_name.empty())
      field.long_name = field.name;
    field.name = std::move(name);
  }
  return renamed;
}

} // namespace calotte::io_detail
