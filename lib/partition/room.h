// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/first_fault.h"
#include "base/message.h"
#include "base/parallel.h"
#include "base/require.h"

/// Partitions of cells for the processes of a model, by METIS, which only this room uses. Its files
/// belong to the target calotte::io, since the core does not need METIS.
///
/// In: the neighbours of each cell, their weights, numbers of parts. Out: the part of each cell.
namespace calotte::partition_detail {
using base_detail::FirstFault;
using base_detail::for_each_block, base_detail::for_each_task;
using base_detail::message, base_detail::refuse, base_detail::refuse_at;
using base_detail::require, base_detail::require_count;
} // namespace calotte::partition_detail
