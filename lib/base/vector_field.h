// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/parallel.h"

#include <calotte/mesh.h>

#include <span>
#include <vector>

namespace calotte::base_detail {

/// Vectors at n points, 3 x n. Sums over the points are computed block by block in a fixed order:
/// the same bits for any number of threads. Functions with a `part` compute for its points only: a
/// loop over blocks that calls several of them reads each block from memory once.

double inner(const Points3& a, const Points3& b);
double inner(const Points3& a, const Points3& b, Part part);

/// Vectors in single precision, times a factor that keeps them in its range. They halve the memory
/// traffic of vectors that a method reads often and that need not be exact.
struct CompactField {
  Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::DontAlign>
      values; ///< of a root mean square of about 1
  double scale = 0;
};

/// \param square inner(vectors, vectors).
CompactField compacted(const Points3& vectors, double square);
Points3 expanded(const CompactField& field);

/// Gives `field` room for n vectors, in its memory if that suffices, and a scale: about the root
/// mean square of the vectors to store.
void prepare(CompactField& field, double scale, std::int64_t n);
/// Sets a prepared field to a - b.
void set_difference(const Points3& a, const Points3& b, CompactField& field, Part part);

double inner(const CompactField& a, const CompactField& b, Part part);

/// The inner products of several fields with b, which is read once.
std::vector<double> inner_of_each(std::span<const CompactField> fields, const Points3& b);
/// Sets `products` to the inner products over a part.
void inner_of_each(std::span<const CompactField> fields, const Points3& b, Part part,
                   std::span<double> products);
void inner_of_each(std::span<const CompactField> fields, const CompactField& b, Part part,
                   std::span<double> products);

/// Sets y to `factor` x plus the sum of shares times fields. y may be x.
/// \param y of x's size.
void set_sum(Points3& y, double factor, const Points3& x, std::span<const double> shares,
             std::span<const CompactField> fields, Part part);

/// The sum of |a_i|^2/|weight_i|.
double square_over(const CompactField& a, const Array<double>& weights);

void multiply(Points3& y, double a);

/// Subtracts from each vector its component along x, unit columns.
void make_tangential(Points3& vectors, const Points3& x, Part part);

/// The columns of x + step d, normalised.
Points3 retract(const Points3& x, double step, const Points3& d);
void retract(const Points3& x, double step, const Points3& d, Points3& to); ///< sets `to`

} // namespace calotte::base_detail
