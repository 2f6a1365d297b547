// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/mpas_part.h"
#include "io/mpas/room.h"

#include <calotte/cut.h>

#include <functional>
#include <string>

namespace calotte::io_detail {

/// Where the nominal spacing comes from.
enum class Nominal {
  of_source, ///< the file that is cut, if it has one: a grid made for its density
  of_cells   ///< the cells that are kept: others of the file are not those of a grid
};

/// As calotte::cut(), from a file that is open.
CutReport cut(const MpasSource& source, const std::string& target,
              const std::function<bool(const Eigen::Vector3d&)>& inside, const CutOptions& options,
              Nominal nominal = Nominal::of_source);

} // namespace calotte::io_detail
