// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"

#include <array>

namespace calotte::test {

inline constexpr std::array all_projections = {tools::Projection::globe,
                                               tools::Projection::plate_carree};

} // namespace calotte::test
