// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/room.h"

/// The exact predicates: the signs on which every topological decision rests, on the sphere, in the
/// plane and in a doubly periodic box. This room uses CGAL's kernels.
///
/// In: coordinates as the caller gave them. Out: the sign of a determinant, without rounding, and
/// the symbolic rule that resolves a sign of 0.
namespace calotte::exact_detail {
using namespace base_detail; // and the rooms below it
}
