// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/room.h"

/// Files: one source file for each format of points, meshes, densities, domains and checkpoints,
/// and the procedure by which every file is written: under a temporary name, synchronised, and
/// renamed when complete.
///
/// In: a path. Out: values of the public types, or one line that names the file and the line in it.
namespace calotte::io_detail {
using namespace quality_detail; // and the rooms below it
}
