// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/legend.h"
#include "draw/painting.h"

#include <cstdint>

/// What pictures of meshes of the sphere and of the plane have in common.
namespace calotte::tools {

/// Sets the painting's scale, for which areas are divided by their mean.
Legend make_legend(Painting& painting, const DrawOptions& options);

/// \throws Error bad_option where the field has not one value for each site.
void require_field(const DrawOptions& options, std::int64_t sites);

} // namespace calotte::tools
