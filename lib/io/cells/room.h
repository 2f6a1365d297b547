// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// Cells of any origin: in the contents of a file, as polygons, as the dual of their corners, as
/// the grid of a model; and the fields on them. Only this folder makes a mesh of the contents of a
/// file.
///
/// In: a RawMesh, or a mesh. Out: a MeshFile, or the input of a writer of cells.
namespace calotte::io_detail {}
