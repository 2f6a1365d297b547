// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/legend.h"
#include "draw/painting.h"

#include <cstdint>

/// Common code of the pictures of meshes of the sphere and of the plane.
namespace calotte::tools {

/// Sets the scale of the painting; divides areas by their mean for it, and
/// multiplies spacings by a radius in km.
Legend make_legend(Painting& painting, const DrawOptions& options);

/// \throws Error bad_option unless the field has one value for each site.
void require_field(const DrawOptions& options, std::int64_t sites);

} // namespace calotte::tools
