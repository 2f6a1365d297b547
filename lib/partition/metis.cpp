// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/metis.h"

#include "base/message.h"
#include "base/require.h"

#include <calotte/error.h>

#include <metis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <new>

namespace calotte::partition_detail {
namespace {

/// METIS sums weights in its integers; half of their range leaves room for rounding.
constexpr double greatest_sum = 0.5 * std::numeric_limits<std::int32_t>::max();

/// Whole numbers in proportion to the weights: the weights themselves, if they are whole and not
/// too large. Otherwise about 1000 on average, because METIS balances worse with larger numbers.
/// Positive weights remain positive.
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

/// The imbalance that METIS is asked for, in thousandths: 30, its default; for fewer than 50 cells
/// in each part, up to one more cell. If whole numbers of cells cannot meet a bound, METIS degrades
/// the cut without meeting it: 5273 instead of 2977 edges for 192 parts of 4628 cells.
idx_t imbalance_for(idx_t parts, idx_t cells) {
  const double usual = 30, cell = 1000 * static_cast<double>(parts) / static_cast<double>(cells);
  return static_cast<idx_t>(std::min(usual + cell, std::max(usual, 1.5 * cell)));
}

/// Restores the state of the process that METIS changes, for one thread at a time: the numbers of
/// rand(), which glibc takes from the state of random(), and the signal handlers for errors, which
/// METIS restores without their flags and masks.
class ProcessState {
public:
  ProcessState() : lock_(one_at_a_time) {
    ::sigaction(SIGABRT, nullptr, &on_abort_);
    ::sigaction(SIGTERM, nullptr, &on_term_);
    before_ = ::initstate(1, numbers_.data(), numbers_.size());
  }
  ProcessState(const ProcessState&) = delete;
  ProcessState& operator=(const ProcessState&) = delete;
  ~ProcessState() {
    ::setstate(before_);
    ::sigaction(SIGABRT, &on_abort_, nullptr);
    ::sigaction(SIGTERM, &on_term_, nullptr);
  }

private:
  inline static std::mutex one_at_a_time;
  const std::scoped_lock<std::mutex> lock_;
  struct sigaction on_abort_ = {}, on_term_ = {};
  alignas(long) std::array<char, 128> numbers_{}; ///< the default size in a process
  char* before_;
};

} // namespace

struct Metis::Arrays {
  std::vector<idx_t> begin, neighbours, weights;

  /// Calls METIS. \returns its code.
  /// \param out the part of each cell.
  int partition(idx_t parts, int attempt, idx_t* out) {
    idx_t cells = static_cast<idx_t>(begin.size()) - 1, constraints = 1, cut = 0;
    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    // Another seed has no effect on small graphs, which METIS does not coarsen.
    options[METIS_OPTION_CONTIG] = attempt % 2 == 0;
    options[METIS_OPTION_UFACTOR] = imbalance_for(parts, cells) * (4 - attempt / 2) / 4;
    return METIS_PartGraphKway(&cells, &constraints, begin.data(), neighbours.data(),
                               weights.empty() ? nullptr : weights.data(), nullptr, nullptr, &parts,
                               nullptr, nullptr, options.data(), &cut, out);
  }
};

Metis::Metis(const Graph& graph, const DoubleVector& weights)
    : arrays_(std::make_unique<Arrays>()) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  require(std::ssize(graph.items) <= most,
          "the cells have {} neighbours in all, but METIS counts to {}; partition a smaller mesh",
          graph.items.size(), most);
  arrays_->begin.assign(graph.begin.begin(), graph.begin.end());
  arrays_->neighbours.assign(graph.items.begin(), graph.items.end());
  if (weights.size() > 0)
    arrays_->weights = whole_weights(weights);
}

Metis::~Metis() = default;

std::vector<std::int32_t> Metis::partition(std::int64_t parts, int attempt) const {
  const std::size_t cells = arrays_->begin.size() - 1;
  std::vector<idx_t> part(cells);
  const int code = [&] {
    const ProcessState state;
    return arrays_->partition(static_cast<idx_t>(parts), attempt, part.data());
  }();
  if (code == METIS_ERROR_MEMORY)
    throw std::bad_alloc();
  if (code != METIS_OK)
    throw Error(ErrorCode::internal,
                message("METIS made no {} parts: its code is {}; give another number of parts",
                        parts, code));
  return {part.begin(), part.end()};
}

} // namespace calotte::partition_detail
