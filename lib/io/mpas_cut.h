// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas_part.h"
#include "io/room.h"

#include <calotte/cut.h>

#include <functional>
#include <string>

namespace calotte::io_detail {

/// As calotte::cut(), from a file that is open.
CutReport cut(const MpasSource& source, const std::string& target,
              const std::function<bool(const Eigen::Vector3d&)>& inside, const CutOptions& options);

} // namespace calotte::io_detail
