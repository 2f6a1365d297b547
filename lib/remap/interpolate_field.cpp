// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/remap.h>

#include "base/parallel.h"
#include "base/require.h"
#include "remap/mean_sums.h"
#include "remap/room.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace calotte {
namespace remap_detail {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Sums over the values of a row that are not NaN.
struct Valid {
  double sum;           ///< of weight times value
  double weight, whole; ///< of the weights of these values, and of all
};

/// \param values of the source; that of the next cell is `stride` further.
Valid sum_valid(const Weights& weights, std::int64_t row, const double* values,
                std::int64_t stride) {
  Valid valid{0, 0, 0};
  for (Weights::InnerIterator entry(weights, row); entry; ++entry) {
    const double value = values[entry.col() * stride];
    valid.whole += entry.value();
    if (std::isnan(value))
      continue;
    valid.weight += entry.value();
    valid.sum += entry.value() * value;
  }
  return valid;
}

CategoryShares shares_of_row(const Weights& weights, std::int64_t row, const double* values,
                             std::int64_t stride) {
  CategoryShares shares;
  for (Weights::InnerIterator entry(weights, row); entry; ++entry)
    if (const double value = values[entry.col() * stride]; !std::isnan(value))
      shares[value] += entry.value();
  return shares;
}

} // namespace
} // namespace remap_detail

MeshField interpolate(const GridWeights& weights, const MeshField& field, double min_cover) {
  using namespace remap_detail;
  const Weights& matrix = weights.weights;
  const std::int64_t count = field.count();
  require(field.location == FieldLocation::cells,
          "the field {} is not at cells; give one at cells or of a raster", field.name);
  require(field.values.size() == matrix.cols() * count,
          "the field {} has {} values for {} cells of the source; give {} for each", field.name,
          field.values.size(), matrix.cols(), count);
  require_min_cover(min_cover);
  MeshField out = field;
  out.values.resize(matrix.rows() * count);
  for_each_block(matrix.rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      for (std::int64_t k = 0; k < count; ++k) {
        const double* const values = field.values.data() + k;
        const Valid valid = sum_valid(matrix, i, values, count);
        const double cover = weights.target_fraction[i] * valid.weight / valid.whole;
        double& value = out.values[i * count + k];
        if (!is_enough(valid.weight, cover, min_cover))
          value = missing;
        else if (field.integer)
          value = heaviest_category(shares_of_row(matrix, i, values, count));
        else // divided where some do not count, so that other weights act as they are
          value =
              valid.weight == valid.whole ? valid.sum : valid.sum * (valid.whole / valid.weight);
      }
  });
  return out;
}

} // namespace calotte
