// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"

/// Grids as users ask for them: the choices of a recipe, the points to start from, and the run; the
/// parts of a mesh that are replaced; and the cells of a limited area with its rings.
///
/// In: a recipe, or a mesh with a demand. Out: the schedule of its descents; a mesh with a report.
/// In: cells and a region. Out: masks.
namespace calotte::grids_detail {
using namespace cvt_detail; // and the rooms below it
}
