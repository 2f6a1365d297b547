// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/gates.h>
#include <calotte/mesh_file.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

/// A grid beside the demands of the model that is to read it.
namespace calotte::tools {

/// Demands with the positions of what is worst.
struct ModelGates {
  std::string model;       ///< its name
  std::vector<Gate> gates; ///< see gates()
  Points2 positions;       ///< 2 x gates: longitude and latitude of Gate::cell, degrees
};

/// The mask of the cells of a limited area; empty if the file has none.
Ids cell_mask_of(const std::string& path, std::int64_t cells);

/// Whether a file of the sphere has the cells that demands are on: Voronoi cells of the whole
/// sphere or, with their corners, of a part.
bool has_demanded_cells(const MeshFile& file);

/// A clause on an MPAS file with another radius or order of vertices than the model's; empty for
/// those that suit it, and for other files.
std::string unsuited(const ModelNeeds& model, const MeshFile& file);

/// A clause on a file without them.
std::string no_demanded_cells(const ModelNeeds& model);

/// Compares a file's grid with the demands. \pre it has such cells, and its mesh is Delaunay.
ModelGates gates_of(const ModelNeeds& model, const std::string& path, const MeshFile& file);

/// A table: the grid's worst, the limit, the number beyond it, the position.
std::string table(const ModelGates& found);
nlohmann::ordered_json to_json(const ModelGates& found);

/// A clause on the demands that fail; empty if none does.
std::string failure_of(const ModelGates& found);

} // namespace calotte::tools
