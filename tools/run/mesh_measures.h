// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/units_option.h"
#include "run/model_gates.h"

#include <calotte/check.h>
#include <calotte/mesh_file.h>
#include <calotte/quality.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The tables and reports of calotte info.
namespace calotte::tools {

/// The quality of a mesh, and the area of its domain.
struct Measured {
  Quality quality;
  std::optional<double> domain_area; ///< of a plane
  std::optional<double> radius_km;   ///< of the sphere, if known
  Unit unit;                         ///< of distances on it
  std::string density = "uniform";   ///< its name
  bool cells = true; ///< false for a mesh without Voronoi cells: its triangles alone are measured
  std::optional<OperatorErrors> operators; ///< if they are asked for
  std::optional<EdgeCounts> open;   ///< of an open mesh; its whole cells are measured if `cells`
  std::optional<ValueRange> areas;  ///< of all cells of an open mesh, if the file has them
  double cells_area = 0;            ///< their sum / 4 pi
  std::optional<ModelGates> gates;  ///< of the model that is named
  std::vector<std::int64_t> masks;  ///< cells by bdyMaskCell, if the file has it
  std::vector<std::string> changes; ///< what the reader changed in the mesh, one line each
  std::vector<std::string> remarks; ///< about the mesh, one line each
};

std::string table(const Measured& measured);
std::string to_json(const Measured& measured);

/// Polygons that are not Voronoi cells: their number of sides and their areas.
std::string table(const Polygons& polygons, const std::optional<Mesh>& mesh, const Unit& unit);
std::string to_json(const Polygons& polygons, const std::optional<Mesh>& mesh,
                    const Measured& measured);

} // namespace calotte::tools
