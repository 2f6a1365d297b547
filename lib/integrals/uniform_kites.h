// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "integrals/room.h"
#include "integrals/rows.h"
#include "integrals/slivers.h"
#include "integrals/terms.h"

#include <vector>

namespace calotte::integrals_detail {

/// The terms of uniform density in closed form, see kites.h.
/// \param slivers of the batch: their sides and halves replace the rows.
/// \param with_mass whether to set the masses.
void uniform_terms(const SphericalTriangles&, const Batch& batch, const TriangleRows& rows,
                   const std::vector<Sliver>& slivers, bool with_mass, TriangleTerms& terms);
/// The same in a plane, where the first moment includes the mass.
void uniform_terms(const FlatTriangles& plane, const Batch& batch, const TriangleRows& rows,
                   const std::vector<Sliver>&, bool, TriangleTerms& terms);

} // namespace calotte::integrals_detail
