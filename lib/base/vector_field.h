// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/types.h>

namespace calotte::base_detail {

/// Vectors at n places, 3 x n. Sums over the places are computed block by block in a fixed order:
/// the same bits for any number of threads.

double inner(const Points3& a, const Points3& b);

/// y + a x.
void add(Points3& y, double a, const Points3& x);

/// Sets y to y + a x; returns its inner product with b.
double inner_of_sum(Points3& y, double a, const Points3& x, const Points3& b);

void multiply(Points3& y, double a);

/// Subtracts from each vector its component along x, unit columns.
void make_tangential(Points3& vectors, const Points3& x);

/// x + step d, normalised.
Points3 retract(const Points3& x, double step, const Points3& d);

/// a - b.
Points3 difference(const Points3& a, const Points3& b);

} // namespace calotte::base_detail
