// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/types.h>

namespace calotte::base_detail {

/// Vectors at n places, 3 x n. Sums over the places are computed block by block in a fixed order:
/// the same bits for any number of threads.

double inner(const Points3& a, const Points3& b);

/// Vectors in single precision, times a factor that keeps them in its range. For vectors that a
/// method reads often and that need not be exact: half of the memory to read.
struct CompactField {
  Eigen::Matrix<float, 3, Eigen::Dynamic> values; ///< of a root mean square of about 1
  double scale = 0;
};

/// \param square inner(vectors, vectors).
CompactField compacted(const Points3& vectors, double square);
Points3 expanded(const CompactField& field);

double inner(const CompactField& a, const Points3& b);

/// y + a x.
void add(Points3& y, double a, const CompactField& x);

/// Sets y to y + a x; returns its inner product with b.
double inner_of_sum(Points3& y, double a, const CompactField& x, const CompactField& b);

void multiply(Points3& y, double a);

/// Subtracts from each vector its component along x, unit columns.
void make_tangential(Points3& vectors, const Points3& x);

/// x + step d, normalised.
Points3 retract(const Points3& x, double step, const Points3& d);

/// a - b.
Points3 difference(const Points3& a, const Points3& b);

} // namespace calotte::base_detail
