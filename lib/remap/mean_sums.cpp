// SPDX-License-Identifier: GPL-3.0-or-later
#include "remap/mean_sums.h"

#include "base/parallel.h"
#include "base/require.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace calotte::remap_detail {

void require_min_cover(double min_cover) {
  require(min_cover >= 0 && min_cover <= 1, "the least cover is {}; give a fraction from 0 to 1",
          min_cover);
}

double heaviest_category(const CategoryShares& shares) {
  double best = std::numeric_limits<double>::quiet_NaN(), most = 0;
  for (const auto& [value, share] : shares)
    if (share > most) {
      best = value;
      most = share;
    }
  return best;
}

MeanSums::MeanSums(std::int64_t cells, const std::vector<MeshField>& fields)
    : met_(static_cast<std::size_t>(cells), -1) {
  for (const MeshField& field : fields)
    sums_.emplace_back(Sums{field, {}, {}, {}}).field.values.resize(0);
}

void MeanSums::add(const GridWeights& weights, const std::vector<MeshField>& fields) {
  meet_cells(weights.weights);
  for_each_block(std::ssize(met_), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      if (const std::int32_t met = met_[static_cast<std::size_t>(i)]; met >= 0) {
        const double area = weights.target_area[i], shared = weights.target_fraction[i] * area;
        area_[static_cast<std::size_t>(met)] = area;
        covered_[static_cast<std::size_t>(met)] += shared;
        for (std::size_t f = 0; f < sums_.size(); ++f)
          add_row(weights.weights, i, shared, fields[f].values, sums_[f]);
      }
  });
}

/// Makes room for the cells that have weights.
void MeanSums::meet_cells(const Weights& weights) {
  auto count = static_cast<std::int32_t>(area_.size());
  for (std::size_t i = 0; i < met_.size(); ++i)
    if (met_[i] < 0 && weights.outerIndexPtr()[i + 1] > weights.outerIndexPtr()[i])
      met_[i] = count++;
  const auto cells = static_cast<std::size_t>(count);
  area_.resize(cells);
  covered_.resize(cells);
  for (Sums& sums : sums_) {
    const std::size_t numbers = cells * static_cast<std::size_t>(sums.field.count());
    sums.area.resize(numbers);
    if (sums.field.integer)
      sums.shares.resize(numbers);
    else
      sums.sum.resize(numbers);
  }
}

void MeanSums::add_row(const Weights& weights, std::int64_t cell, double shared,
                       const DoubleVector& values, Sums& sums) const {
  const std::int64_t count = sums.field.count();
  for (Weights::InnerIterator entry(weights, cell); entry; ++entry)
    for (std::int64_t k = 0; k < count; ++k) {
      const double value = values[entry.col() * count + k], area = entry.value() * shared;
      if (std::isnan(value))
        continue;
      const auto number =
          static_cast<std::size_t>(met_[static_cast<std::size_t>(cell)] * count + k);
      sums.area[number] += area;
      if (sums.field.integer)
        sums.shares[number][value] += area;
      else
        sums.sum[number] += area * value;
    }
}

std::vector<MeshField> MeanSums::means(double min_cover) const {
  std::vector<MeshField> fields;
  for (const Sums& sums : sums_) {
    MeshField& field = fields.emplace_back(sums.field);
    const std::int64_t count = field.count();
    field.values.resize(std::ssize(met_) * count);
    for (std::int64_t i = 0; i < std::ssize(met_); ++i)
      for (std::int64_t k = 0; k < count; ++k)
        field.values[i * count + k] = mean(sums, met_[static_cast<std::size_t>(i)], k, min_cover);
  }
  return fields;
}

/// \param met number of a met cell, or -1.
double MeanSums::mean(const Sums& sums, std::int64_t met, std::int64_t k, double min_cover) const {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  if (met < 0)
    return missing;
  const auto number = static_cast<std::size_t>(met * sums.field.count() + k);
  const double area = sums.area[number];
  if (!is_enough(area, area / area_[static_cast<std::size_t>(met)], min_cover))
    return missing;
  return sums.field.integer ? heaviest_category(sums.shares[number]) : sums.sum[number] / area;
}

DoubleVector MeanSums::target_fraction() const {
  DoubleVector fractions = DoubleVector::Zero(std::ssize(met_));
  for (std::int64_t i = 0; i < fractions.size(); ++i)
    if (const std::int32_t met = met_[static_cast<std::size_t>(i)]; met >= 0)
      fractions[i] = covered_[static_cast<std::size_t>(met)] / area_[static_cast<std::size_t>(met)];
  return fractions;
}

} // namespace calotte::remap_detail
