// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/vec3.h"
#include "integrals/integrand.h"
#include "integrals/room.h"
#include "integrals/rows.h"
#include "integrals/terms.h"

namespace calotte::integrals_detail {

/// The terms of any density: the integral over half kites by the integrand's nodes, see kites.h.
/// \param space SphericalTriangles or FlatTriangles; \param x positions by local number.
template <class Triangles>
void density_terms(const Triangles& space, const Batch& batch, const TriangleRows& rows,
                   const Integrand& integrand, const Array<Vec3>& x, TriangleTerms& terms);

} // namespace calotte::integrals_detail
