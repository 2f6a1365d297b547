// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/text.h"
#include "io/shapes/room.h"

#include <calotte/mesh.h>

namespace calotte::io_detail {

void put_points(const Sink& sink, const Points3& points); ///< x y z a line

} // namespace calotte::io_detail
