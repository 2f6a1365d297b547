// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// What a file says of its own mesh, compared with what would be written for that mesh.
///
/// In: a file and its mesh. Out: a report of the variables that differ.
namespace calotte::io_detail {}
