// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/netcdf_fields.h"
#include "io/netcdf/cf_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace calotte::io_detail {
namespace {

/// All dimensions of the variables that describe the mesh.
std::set<std::string> mesh_dimensions(const NetcdfReader& file, const NetcdfMeshNames& names) {
  std::set<std::string> dimensions{names.cells, names.edges, names.vertices};
  for (const std::string& name : names.variables)
    if (file.has_variable(name))
      for (std::string& dimension : file.dimensions_of(name))
        dimensions.insert(std::move(dimension));
  return dimensions;
}

std::optional<Location> location_of(const NetcdfMeshNames& names, const std::string& dimension) {
  if (dimension == names.cells)
    return Location::cells;
  if (!names.edges.empty() && dimension == names.edges)
    return Location::edges;
  if (!names.vertices.empty() && dimension == names.vertices)
    return Location::vertices;
  return std::nullopt;
}

/// A field without values, or nothing for a variable that is none.
std::optional<MeshField> field_of(const NetcdfReader& file, const NetcdfMeshNames& names,
                                  const std::set<std::string>& of_mesh, const std::string& name) {
  if (!file.is_numeric(name) || names.lists.contains(name))
    return std::nullopt;
  MeshField field{.name = name};
  bool located = false;
  for (const std::string& dimension : file.dimensions_of(name)) {
    const std::optional<Location> location = location_of(names, dimension);
    const std::int64_t size = file.dimension(dimension);
    if (location && !located) {
      field.location = *location;
      field.leading = static_cast<int>(field.dimensions.size());
      located = true;
    } else if (of_mesh.contains(dimension) || size < 1) {
      return std::nullopt;
    } else {
      field.dimensions.push_back({dimension, size});
    }
  }
  return located ? std::optional(std::move(field)) : std::nullopt;
}

/// From the order of a file, in which leading dimensions come before the location's.
DoubleVector by_place(const MeshField& field, DoubleVector values) {
  std::int64_t before = 1;
  for (int d = 0; d < field.leading; ++d)
    before *= field.dimensions[static_cast<std::size_t>(d)].size;
  const std::int64_t after = field.count() / before, places = values.size() / field.count();
  if (before == 1)
    return values;
  DoubleVector out(values.size());
  for (std::int64_t b = 0; b < before; ++b)
    for (std::int64_t i = 0; i < places; ++i)
      out.segment((i * before + b) * after, after) =
          values.segment((b * places + i) * after, after);
  return out;
}

/// Whether all are numbers that NetCDF's int can hold, besides its own _FillValue.
bool fit_int(const DoubleVector& values) {
  using Limits = std::numeric_limits<std::int32_t>;
  return std::all_of(values.begin(), values.end(), [](double value) {
    return std::isnan(value) || (value >= Limits::min() + 2.0 && value <= Limits::max());
  });
}

/// Whether a variable at edges is said to be a component along them.
bool is_directed(const NetcdfReader& file, const std::string& name) {
  constexpr std::array<std::string_view, 3> velocities{"u", "v", "ru"}; // of MPAS-Atmosphere
  if (std::find(velocities.begin(), velocities.end(), name) != velocities.end())
    return true;
  std::string words =
      name + " " + file.text(name, "long_name") + " " + file.text(name, "standard_name");
  std::transform(words.begin(), words.end(), words.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return words.find("normal") != std::string::npos || words.find("tangent") != std::string::npos;
}

} // namespace

void read_values(const NetcdfReader& file, MeshField& field) {
  field.long_name = file.text(field.name, "long_name");
  field.units = file.text(field.name, "units");
  field.values = by_place(field, values_with_fill(file, field.name));
  field.integer =
      file.is_integer(field.name) && !is_packed(file, field.name) && fit_int(field.values);
  field.directed = field.location == Location::edges && is_directed(file, field.name);
}

DoubleVector values_with_fill(const NetcdfReader& file, const std::string& name) {
  const std::vector<double> values = cf_values(file, name, file.shape_of(name));
  return Eigen::Map<const DoubleVector>(values.data(), std::ssize(values));
}

void read_fields(const NetcdfReader& file, const NetcdfMeshNames& names, FieldChoice choice,
                 RawMesh& raw) {
  if (choice == FieldChoice::none)
    return;
  const std::set<std::string> of_mesh = mesh_dimensions(file, names);
  for (const std::string& name : file.variable_names()) {
    if (names.variables.contains(name))
      continue;
    std::optional<MeshField> field = field_of(file, names, of_mesh, name);
    if (!field || (choice == FieldChoice::scalars && field->count() > 1)) {
      raw.ignored.push_back(name);
      continue;
    }
    read_values(file, *field);
    raw.fields.push_back(*std::move(field));
  }
}

} // namespace calotte::io_detail
