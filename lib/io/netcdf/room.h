// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// NetCDF: a reader of headers and values, a writer that computes while it writes, and rows that go
/// from file to file.
///
/// In: a path, or variables with a function that fills them. Out: arrays, or a file.
namespace calotte::io_detail {}
