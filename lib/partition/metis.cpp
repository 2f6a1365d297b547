// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/metis.h"

#include "base/require.h"
#include "partition/child_process.h"

#include <calotte/error.h>

#include <metis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <string>

namespace calotte::partition_detail {
namespace {

/// METIS sums weights in its integers; half of their range leaves room for rounding.
constexpr double greatest_sum = 0.5 * std::numeric_limits<std::int32_t>::max();

/// Whole numbers in proportion to the weights: these themselves if they are whole and not too
/// large, else some 1000 on average, as with larger ones METIS balances worse. Positive ones stay
/// positive.
std::vector<idx_t> whole_weights(const DoubleVector& weights) {
  const double sum = weights.sum();
  const bool whole = sum <= greatest_sum && (weights.array() == weights.array().floor()).all();
  const auto cells = static_cast<double>(weights.size());
  const double factor = whole ? 1 : std::min(1000 * cells, greatest_sum - cells) / sum;
  std::vector<idx_t> out(static_cast<std::size_t>(weights.size()));
  std::transform(weights.begin(), weights.end(), out.begin(),
                 [&](double weight) { return static_cast<idx_t>(std::ceil(factor * weight)); });
  return out;
}

} // namespace

struct Metis::Arrays {
  std::vector<idx_t> begin, neighbours, weights;

  /// METIS's code. \param out the part of each cell.
  int partition(idx_t parts, int seed, idx_t* out) {
    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_CONTIG] = 1;
    options[METIS_OPTION_SEED] = seed;
    idx_t cells = static_cast<idx_t>(begin.size()) - 1, constraints = 1, cut = 0;
    return METIS_PartGraphKway(&cells, &constraints, begin.data(), neighbours.data(),
                               weights.empty() ? nullptr : weights.data(), nullptr, nullptr, &parts,
                               nullptr, nullptr, options.data(), &cut, out);
  }
};

Metis::Metis(const Graph& graph, const DoubleVector& weights)
    : arrays_(std::make_unique<Arrays>()) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  require(std::ssize(graph.items) <= most, "the cells have " + std::to_string(graph.items.size()) +
                                               " neighbours in all, but METIS counts to " +
                                               std::to_string(most) + "; partition a smaller mesh");
  arrays_->begin.assign(graph.begin.begin(), graph.begin.end());
  arrays_->neighbours.assign(graph.items.begin(), graph.items.end());
  if (weights.size() > 0)
    arrays_->weights = whole_weights(weights);
}

Metis::~Metis() = default;

std::vector<std::int32_t> Metis::partition(std::int64_t parts, int seed) const {
  const std::size_t cells = arrays_->begin.size() - 1;
  const SharedIds shared(cells);
  // Its rand() would meet other threads' here, and its handlers of SIGABRT and SIGTERM would stay.
  const std::optional<int> code = result_of_child([&] {
    std::vector<idx_t> part(cells);
    const int result = arrays_->partition(static_cast<idx_t>(parts), seed, part.data());
    std::copy(part.begin(), part.end(), shared.ids().begin());
    return result;
  });
  if (code == METIS_ERROR_MEMORY)
    throw std::bad_alloc();
  if (code != METIS_OK)
    throw Error(ErrorCode::internal, "METIS made no " + std::to_string(parts) + " parts: " +
                                         (code ? "its code is " + std::to_string(*code)
                                               : "its process was killed, perhaps for memory"));
  return {shared.ids().begin(), shared.ids().end()};
}

} // namespace calotte::partition_detail
