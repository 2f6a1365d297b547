// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas_check.h"

namespace calotte::io_detail {

void check_open_mpas(const Mesh& /*mesh*/, Deviations& /*deviations*/) {}

} // namespace calotte::io_detail
