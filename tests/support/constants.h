// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace calotte::test {

inline constexpr double pi = std::numbers::pi, degree = pi / 180; // radians

} // namespace calotte::test
