// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/netcdf_fields.h"
#include "io/netcdf/cf_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
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

std::optional<FieldLocation> location_of(const NetcdfMeshNames& names,
                                         const std::string& dimension) {
  if (dimension == names.cells)
    return FieldLocation::cells;
  if (!names.edges.empty() && dimension == names.edges)
    return FieldLocation::edges;
  if (!names.vertices.empty() && dimension == names.vertices)
    return FieldLocation::vertices;
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
    const std::optional<FieldLocation> location = location_of(names, dimension);
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

/// By index over some dimensions, the slowest first: where its value stands among all.
std::vector<std::int64_t> offsets_of(const std::vector<std::int64_t>& shape,
                                     const std::vector<std::size_t>& dimensions) {
  std::vector<std::int64_t> offsets{0};
  for (const std::size_t d : dimensions) {
    const std::int64_t stride = std::accumulate(shape.begin() + static_cast<std::ptrdiff_t>(d) + 1,
                                                shape.end(), std::int64_t{1}, std::multiplies<>());
    std::vector<std::int64_t> finer;
    for (const std::int64_t offset : offsets)
      for (std::int64_t k = 0; k < shape[d]; ++k)
        finer.push_back(offset + k * stride);
    offsets = std::move(finer);
  }
  return offsets;
}

/// From the order of a file: place by place.
DoubleVector by_place(const std::vector<double>& values, const std::vector<std::int64_t>& shape,
                      const std::vector<std::size_t>& places) {
  std::vector<std::size_t> others;
  for (std::size_t d = 0; d < shape.size(); ++d)
    if (std::find(places.begin(), places.end(), d) == places.end())
      others.push_back(d);
  const std::vector<std::int64_t> at = offsets_of(shape, places), of = offsets_of(shape, others);
  DoubleVector out(std::ssize(values));
  double* next = out.data();
  for (const std::int64_t place : at)
    for (const std::int64_t other : of)
      *next++ = values[static_cast<std::size_t>(place + other)];
  return out;
}

/// The attributes that say what the numbers are, and neither where nor how they are stored.
std::vector<std::array<std::string, 2>> meaning_of(const NetcdfReader& file,
                                                   const std::string& name) {
  static const std::set<std::string> others{
      "long_name",     "units",     "coordinates",   "grid_mapping",        "bounds",
      "mesh",          "location",  "cell_measures", "ancillary_variables", "grid_type",
      "CDI_grid_type", "_Unsigned", "flag_meanings", "formula_terms",       "missing_value",
      "_FillValue"};
  std::vector<std::array<std::string, 2>> attributes;
  for (const NetcdfAttribute& attribute :
       file.variables()[static_cast<std::size_t>(file.find(name))].attributes)
    if (const auto* const text = std::get_if<std::string>(&attribute.value);
        text && !others.contains(attribute.name))
      attributes.push_back({attribute.name, *text});
  return attributes;
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

/// Reads a field's values, see cf_values(), and attributes.
/// \param places which of the variable's dimensions stand for places, the slowest first; the field
///        has a value for each of the others, in the order of the file, at each place.
/// \pre its name, location, dimensions and `leading` are set.
void read_values(const NetcdfReader& file, const std::vector<std::size_t>& places,
                 MeshField& field) {
  const std::vector<std::int64_t> shape = file.shape_of(field.name);
  field.long_name = file.text(field.name, "long_name");
  field.units = file.text(field.name, "units");
  field.values = by_place(cf_values(file, field.name, shape), shape, places);
  field.integer =
      file.is_integer(field.name) && !is_packed(file, field.name) && fit_int(field.values);
  field.single = file.is_float(field.name) && !is_packed(file, field.name);
  field.attributes = meaning_of(file, field.name);
  for (FieldDimension& dimension : field.dimensions)
    dimension.unlimited = file.is_unlimited(dimension.name);
  field.directed = field.location == FieldLocation::edges && is_directed(file, field.name);
}

/// Where dimensions stand among those of a variable; none unless it has each once.
std::optional<std::vector<std::size_t>> places_of(const std::vector<std::string>& all,
                                                  const std::vector<std::string>& wanted) {
  std::vector<std::size_t> places;
  for (const std::string& dimension : wanted) {
    if (std::count(all.begin(), all.end(), dimension) != 1)
      return std::nullopt;
    places.push_back(
        static_cast<std::size_t>(std::find(all.begin(), all.end(), dimension) - all.begin()));
  }
  return places;
}

/// A field on some dimensions without values, or nothing for one without a place for them.
std::optional<MeshField> field_on(const NetcdfReader& file, const std::string& name,
                                  const std::vector<std::size_t>& places) {
  MeshField field{.name = name};
  const std::vector<std::string> all = file.dimensions_of(name);
  for (std::size_t d = 0; d < all.size(); ++d)
    if (std::find(places.begin(), places.end(), d) == places.end()) {
      field.dimensions.push_back({all[d], file.dimension(all[d])});
      if (field.dimensions.back().size < 1)
        return std::nullopt;
    }
  bool together = true;
  for (std::size_t k = 1; k < places.size(); ++k)
    together = together && places[k] == places[k - 1] + 1;
  field.leading = static_cast<int>(together ? places.front() : field.dimensions.size());
  return field;
}

} // namespace

void read_fields_on(const NetcdfReader& file, const std::vector<std::string>& dimensions,
                    const std::set<std::string>& no_fields, FieldChoice choice,
                    std::vector<MeshField>& fields, std::vector<std::string>& ignored) {
  if (choice == FieldChoice::none)
    return;
  for (const std::string& name : file.variable_names()) {
    if (no_fields.contains(name))
      continue;
    const auto places =
        file.is_numeric(name) ? places_of(file.dimensions_of(name), dimensions) : std::nullopt;
    std::optional<MeshField> field = places ? field_on(file, name, *places) : std::nullopt;
    if (!field || (choice == FieldChoice::scalars && field->count() > 1)) {
      ignored.push_back(name);
      continue;
    }
    read_values(file, *places, *field);
    fields.push_back(*std::move(field));
  }
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
    read_values(file, {static_cast<std::size_t>(field->leading)}, *field);
    raw.fields.push_back(*std::move(field));
  }
}

} // namespace calotte::io_detail
