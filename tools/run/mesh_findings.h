// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/check.h>
#include <calotte/mesh_file.h>

#include <optional>
#include <string>

/// Whether a mesh is the Delaunay triangulation of its points, or cells are cells.
namespace calotte::tools {

/// What is proven of a mesh, and counted where that is not all.
struct Findings {
  CheckReport check;               ///< of a mesh that is not Delaunay: as a surface
  bool delaunay = false;           ///< the mesh is the Delaunay triangulation of its points
  std::optional<EdgeCounts> edges; ///< of a mesh that is not
  std::string failure;             ///< why the check fails; empty if it passes
};

/// A mesh whose edges are all Delaunay passes: a foreign mesh may have the other diagonals of
/// cocircular sites, or a boundary that is not convex.
Findings findings_of(const Mesh& mesh, const ProgressCallback& progress);

/// Whether the triangles of a file are checked. Cells without triangles of their own are checked as
/// cells; a periodic plane has triangles.
bool has_own_triangles(const MeshFile& file);

/// Why the check of a file's mesh or cells fails; empty if it passes.
std::string failure_of(const MeshFile& file, const ProgressCallback& progress);

} // namespace calotte::tools
