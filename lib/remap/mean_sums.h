// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "remap/room.h"

#include <calotte/mesh.h>
#include <calotte/remap.h>

#include <cstdint>
#include <map>
#include <vector>

namespace calotte::remap_detail {

/// \throws Error invalid_argument unless it is a fraction.
void require_min_cover(double min_cover);

/// Whether values that cover a fraction of a cell, and have a weight, give it a value.
inline bool is_enough(double weight, double cover, double min_cover) {
  return weight > 0 && !(cover < min_cover * (1 - 1e-9));
}

/// Areas, by category.
using CategoryShares = std::map<double, double>;

/// The category of the greatest share, the lowest of equal ones; NaN if there is none.
double heaviest_category(const CategoryShares& shares);

/// Conservative means over cells, of a source that comes in parts: their sums over the parts. Only
/// cells that the source meets take memory for sums: a source may cover little of a large target.
class MeanSums {
public:
  /// \param fields without values; those of integers are categories.
  MeanSums(std::int64_t cells, const std::vector<MeshField>& fields);

  /// \param weights conservative, from a part to the cells.
  /// \param fields as above, with the values of the part.
  void add(const GridWeights& weights, const std::vector<MeshField>& fields);

  /// What interpolate() would give with the weights of all parts together.
  std::vector<MeshField> means(double min_cover) const;
  /// Of each cell's area, what the parts cover.
  DoubleVector target_fraction() const;

private:
  /// The sums of a field, by met cell; those of a cell's numbers follow each other.
  struct Sums {
    MeshField field;                    ///< without values
    std::vector<double> area;           ///< with values
    std::vector<double> sum;            ///< of area times value; not of categories
    std::vector<CategoryShares> shares; ///< of categories
  };

  void meet_cells(const Weights& weights);
  void add_row(const Weights& weights, std::int64_t cell, double shared, const DoubleVector& values,
               Sums& sums) const;
  double mean(const Sums& sums, std::int64_t met, std::int64_t k, double min_cover) const;

  std::vector<std::int32_t> met_; ///< the number of each cell among those met; -1 if it is not
  std::vector<double> area_;      ///< of each met cell
  std::vector<double> covered_;   ///< by all parts
  std::vector<Sums> sums_;
};

} // namespace calotte::remap_detail
