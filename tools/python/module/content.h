// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "arrays.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace calotte::python {

/// What a file holds besides its mesh: polygons, fields, density and radius.
using Content = std::shared_ptr<MeshFile>;

/// The mesh of a file, or without one its polygons; and the content.
pybind11::tuple parts_of(MeshFile file);

/// A content with the mesh that it came with.
MeshFile whole(const MeshFile& content, const pybind11::object& grid);

/// The cells of a grid. \param content of the file that it is of, or None.
MeshFile file_of_cells(const pybind11::object& content, const pybind11::object& grid);

/// Names of dimensions, their sizes, and whether they are unlimited.
using Dimensions = std::vector<std::tuple<std::string, std::int64_t, bool>>;

/// The values of a field, cells x others, its other dimensions, how many of them are before the
/// cells, its unit, its long name and other attributes.
using FieldState = std::tuple<std::string, Doubles, Dimensions, int, std::string, std::string,
                              std::vector<std::array<std::string, 2>>>;
std::vector<MeshField> fields_from(const std::vector<FieldState>& states);

/// \param word curve or input. \throws Error invalid_argument for another.
Numbering numbering_named(const std::string& word);

} // namespace calotte::python
