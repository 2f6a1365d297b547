// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "integrals/integrand.h"
#include "integrals/room.h"
#include "integrals/rows.h"

namespace calotte::integrals_detail {

/// Terms for any density: the integral over half kites by the integrand's nodes.
/// \param with_mass otherwise the masses are not set.
void kite_terms(const Batch& batch, const TriangleRows& rows, const Integrand& integrand,
                bool with_mass, TriangleTerms& terms);

} // namespace calotte::integrals_detail
