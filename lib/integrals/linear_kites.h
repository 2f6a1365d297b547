// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "integrals/room.h"
#include "integrals/rows.h"
#include "integrals/terms.h"

namespace calotte::integrals_detail {

/// Sets the terms of triangles with a density that is linear on each half kite, interpolated
/// between its values at the two ends of the half edge and at the circumcentre. The density at the
/// circumcentre is that of linear interpolation on the triangle, clamped to the range of the
/// corners.
///
/// On the sphere the terms are those of the flat triangle: they differ from the sphere's by its
/// circumradius squared, as the density does from a smooth one.
/// \param batch with the density at the corners.
template <class Triangles>
void linear_terms(const Triangles& space, const Batch& batch, const TriangleRows& rows,
                  TriangleTerms& terms);

extern template void linear_terms(const SphericalTriangles&, const Batch&, const TriangleRows&,
                                  TriangleTerms&);
extern template void linear_terms(const FlatTriangles&, const Batch&, const TriangleRows&,
                                  TriangleTerms&);

} // namespace calotte::integrals_detail
