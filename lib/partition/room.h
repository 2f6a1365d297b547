// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/room.h"

/// Partitions of cells for the processes of a model, by METIS, which no other room uses. Its files
/// belong to calotte::io, as the core does without METIS.
///
/// In: the neighbours of each cell, their weights, numbers of parts. Out: the part of each cell.
namespace calotte::partition_detail {
using namespace base_detail;
}
