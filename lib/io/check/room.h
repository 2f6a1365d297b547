// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// Compares the variables of a file that describe its mesh with those that would be written for the
/// mesh.
///
/// In: a file and its mesh. Out: a report of the variables that differ.
namespace calotte::io_detail {}
