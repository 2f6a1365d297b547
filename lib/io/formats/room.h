// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// The formats of mesh files. Each is a row of a table (formats.h), with a source file for its
/// reader and one for its writer.
///
/// In: a mesh and a path. Out: a file; and the reverse.
namespace calotte::io_detail {}
