// SPDX-License-Identifier: GPL-3.0-or-later
/// The compiled part of the Python package. It converts no units and guesses no shapes: the modules
/// of Python around it check what users pass. Arrays of points are n x 3 or n x 2.
#pragma once

#include <pybind11/pybind11.h>

namespace calotte::python {

void add_errors(pybind11::module_& module);
void add_meshes(pybind11::module_& module);
void add_cells(pybind11::module_& module);
void add_operators(pybind11::module_& module);
void add_corners(pybind11::module_& module);
void add_densities(pybind11::module_& module);
void add_widths(pybind11::module_& module);
void add_surfaces(pybind11::module_& module);
void add_tessellations(pybind11::module_& module);
void add_points(pybind11::module_& module);
void add_positions(pybind11::module_& module);
void add_multimeshes(pybind11::module_& module);
void add_contents(pybind11::module_& module);
void add_files(pybind11::module_& module);
void add_oceans(pybind11::module_& module);
void add_changes(pybind11::module_& module);
void add_field_grids(pybind11::module_& module);

} // namespace calotte::python
