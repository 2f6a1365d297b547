// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <string>
#include <vector>

/// The boundary of a mesh of triangles as models of the coastal ocean name its parts.
namespace calotte::io_detail {

/// What lies beyond a piece of the boundary.
enum class BoundaryKind {
  open,  ///< other water
  land,  ///< the mainland, or between open pieces
  island ///< land that the mesh surrounds
};

/// A chain of outer edges with the mesh to the left, seen from outside the sphere.
struct BoundaryPiece {
  BoundaryKind kind = BoundaryKind::land;
  bool closed = false;                  ///< an edge leads from its last site to its first
  std::vector<std::int32_t> sites = {}; ///< two or more, in order
};

/// The pieces of the boundary of a mesh: open ones first, then land, then islands, each in the
/// order of boundary_loops(). Pieces that meet share a site. In each connected part of the mesh the
/// loop with the largest area beyond it is the mainland, and all others are islands; a loop with an
/// open piece has no islands. \param open_sites see WriteOptions.
std::vector<BoundaryPiece> boundary_pieces(const Mesh& mesh, const Ids& open_sites);

/// The same pieces, where each closed one of these kinds is two that meet at both ends.
std::vector<BoundaryPiece> halved(std::vector<BoundaryPiece> pieces,
                                  const std::vector<BoundaryKind>& kinds);

/// Requires a boundary that passes each site once at most, and a triangle at each site, as SCHISM
/// and ADCIRC do.
/// \param model for the message. \throws Error invalid_argument, naming the site.
void require_simple_boundary(const std::string& path, const Mesh& mesh, const char* model);

} // namespace calotte::io_detail
