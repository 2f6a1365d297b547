// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// MPAS: the variables of its files, written, read, cut, culled and numbered anew.
///
/// In: a mesh or a tessellation, or a file of MPAS. Out: the other of both.
namespace calotte::io_detail {}
