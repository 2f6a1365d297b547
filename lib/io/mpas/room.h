// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// MPAS: the variables of its files, and how they are written, read, cut, culled, rotated and
/// renumbered.
///
/// In: a mesh or a tessellation, or an MPAS file. Out: the other of the two.
namespace calotte::io_detail {}
