// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// Fields from one grid to another: meshes and rasters that carry fields, and files of weights.
///
/// In: paths of grids. Out: weights, fields, and files of them.
namespace calotte::io_detail {}
