// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>

#include <nlohmann/json.hpp>

#include <string>

/// The actions of a run in words and in reports.
namespace calotte::tools {

/// "642 cells, up to 4 times; l2-scaled 0.001, at most 75 iterations".
std::string described(const CvtAction& action);

nlohmann::ordered_json to_json(const CvtAction& action);

} // namespace calotte::tools
