// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// Cells of any origin: as a file holds them, as polygons, as the dual of their corners, as the
/// grid of a model, and the fields on them. Here, and only here, a file's contents become a mesh.
///
/// In: a RawMesh, or a mesh. Out: a MeshFile, or what a writer of cells asks for.
namespace calotte::io_detail {}
