// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace calotte::python {

/// What a file holds besides its mesh: polygons, fields, density and radius.
using Content = std::shared_ptr<MeshFile>;

/// The mesh of a file, or without one its polygons; and the content.
pybind11::tuple parts_of(MeshFile file);

/// A content with the mesh that it came with.
MeshFile whole(const MeshFile& content, const pybind11::object& grid);

/// \param word curve or input. \throws Error invalid_argument for another.
Numbering numbering_named(const std::string& word);

} // namespace calotte::python
