// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/written_fields.h"

#include "base/message.h"
#include "io/bytes/big_endian.h"
#include "io/bytes/utf8.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace calotte::io_detail {
namespace {

/// The default fill values of the C library.
template <class T> constexpr T fill_value = static_cast<T>(9.9692099683868690e+36);
template <>
constexpr std::int32_t fill_value<std::int32_t> = std::numeric_limits<std::int32_t>::min() + 1;

/// The values of a field in the order of a file, where leading dimensions precede those of the
/// location.
/// \param filled whether NaN becomes the fill value.
template <class T> NetcdfWriter::FillBytes make_contents(const MeshField& field, bool filled) {
  const double* const values = field.values.data();
  std::int64_t before = 1;
  for (int d = 0; d < field.leading; ++d)
    before *= field.dimensions[static_cast<std::size_t>(d)].size;
  const std::int64_t after = field.count() / before, items = field.values.size() / field.count();
  return [=](std::int64_t begin, std::int64_t end, char* out) {
    char* to = out;
    for (std::int64_t k = begin; k < end;) {
      const std::int64_t row = k / after, item = row % items, leading = row / items,
                         last = std::min(end, (row + 1) * after);
      const std::int64_t shift = (item * before + leading - row) * after;
      for (; k < last; ++k, to += sizeof(T)) {
        const double from = values[k + shift];
        const T value = filled && std::isnan(from) ? fill_value<T> : static_cast<T>(from);
        std::memcpy(to, &value, sizeof value);
      }
    }
    swap_big_endian(out, end - begin, sizeof(T), out);
  };
}

NetcdfAttribute fill_attribute(NetcdfType type) {
  if (type == NetcdfType::int32)
    return {"_FillValue", fill_value<std::int32_t>};
  if (type == NetcdfType::float64)
    return {"_FillValue", fill_value<double>};
  const float value = fill_value<float>;
  return {"_FillValue", NetcdfValues{type, {reinterpret_cast<const char*>(&value), sizeof value}}};
}

const FileLocation& find_location(const FileLocations& locations, FieldLocation location) {
  return location == FieldLocation::cells   ? locations.cells
         : location == FieldLocation::edges ? locations.edges
                                            : locations.vertices;
}

bool is_name_of_mesh(const NetcdfMeshNames& names, const std::string& name) {
  return names.variables.contains(name) || names.lists.contains(name) ||
         names.derived.contains(name);
}

/// Whether a field becomes the mask of SCRIP or ESMF. Each accepts the mask of the other.
bool is_kept_as_mask(const NetcdfMeshNames& names, const MeshField& field) {
  return is_mask(field) &&
         (names.derived.contains("grid_imask") || names.derived.contains("elementMask"));
}

// ---- Names

bool is_letter_or_digit(unsigned char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9');
}

} // namespace

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

void add_field(NetcdfGridFile& file, const MeshField& field, const std::vector<int>& of_location,
               const std::vector<int>& others, NetcdfAttributes attributes, Missing missing) {
  if (!field.units.empty())
    attributes.push_back({"units", field.units});
  if (!field.long_name.empty())
    attributes.push_back({"long_name", field.long_name});
  for (const auto& [word, text] : field.attributes)
    attributes.push_back({word, text});
  const NetcdfType type = field.integer  ? NetcdfType::int32
                          : field.single ? NetcdfType::float32
                                         : NetcdfType::float64;
  const bool filled = missing == Missing::filled || field.values.hasNaN();
  if (filled)
    attributes.push_back(fill_attribute(type));
  std::vector<int> dimensions = others;
  dimensions.insert(dimensions.begin() + field.leading, of_location.begin(), of_location.end());
  file.bytes(field.name, type, dimensions, attributes,
             field.integer  ? make_contents<std::int32_t>(field, filled)
             : field.single ? make_contents<float>(field, filled)
                            : make_contents<double>(field, filled));
}

FieldFault find_fault(const NetcdfMeshNames& names, const MeshField& field) {
  const bool has_dimension = field.location == FieldLocation::cells   ? !names.cells.empty()
                             : field.location == FieldLocation::edges ? !names.edges.empty()
                                                                      : !names.vertices.empty();
  if (!has_dimension)
    return FieldFault::location;
  return is_kept_as_mask(names, field) || !is_name_of_mesh(names, field.name) ? FieldFault::none
                                                                              : FieldFault::name;
}

void add_fields(NetcdfGridFile& file, const WriteOptions& options, const FileLocations& locations,
                const NetcdfMeshNames& names) {
  for (const MeshField& field : options.fields) {
    const FileLocation& location = find_location(locations, field.location);
    if (location.dimension < 0 || is_name_of_mesh(names, field.name) ||
        is_kept_as_mask(names, field))
      continue;
    std::vector<int> others;
    for (const FieldDimension& dimension : field.dimensions)
      others.push_back(file.netcdf().field_dimension(netcdf_name(dimension.name), dimension.size));
    add_field(file, field, {location.dimension}, others, location.attributes,
              Missing::where_needed);
  }
}

std::vector<std::array<std::string, 2>> replace_names(std::vector<MeshField>& fields) {
  std::vector<std::array<std::string, 2>> renamed;
  std::set<std::string> used;
  for (MeshField& field : fields) {
    std::string name = netcdf_name(field.name);
    const std::string stem = name;
    for (int k = 2; !used.insert(name).second; ++k)
      name = message("{}_{}", stem, k);
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
