// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "density/room.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

/// The largest function below a given one whose gradient is bounded: f(x) = min over y of h(y) +
/// g d(x, y), with the shortest way d within the domain.
namespace calotte::density_detail {

/// \throws Error invalid_argument unless a limit is positive and finite.
void require_gradient(double gradient);

/// The requirements of limit_gradient() on the nodes of a raster.
///
///     std::int32_t size() const;
///     double distance(std::int32_t a, std::int32_t b) const;  // straight, > 0 for two points
///     bool sees(std::int32_t a, std::int32_t b) const;  // the straight way is in the domain
///     void for_each_neighbour(std::int32_t a, body) const;  // nodes that a sees, in order
///     double step() const;  // a typical distance of neighbours
template <class T>
concept RasterNodes = requires(const T& nodes, std::int32_t a) {
  { nodes.size() } -> std::convertible_to<std::int32_t>;
  { nodes.distance(a, a) } -> std::convertible_to<double>;
  { nodes.sees(a, a) } -> std::convertible_to<bool>;
  { nodes.step() } -> std::convertible_to<double>;
};

/// Limits the values at nodes. A node takes its value from a source, which its neighbours hand on:
/// the distance is that from the source itself, so that it does not depend on the directions of the
/// raster (any-angle paths: Nash, Daniel, Koenig and Felner, AAAI 2007). Where the source is out of
/// sight, the neighbour becomes one. Values are finalised in the order of their size, all of about
/// one size at once (Delta-stepping: Meyer and Sanders, J. Algorithms 49, 2003). A round reads what
/// the round before it wrote, and a node takes the least of what is handed to it: the result has
/// the same bits for any number of threads.
template <RasterNodes Nodes> class GradientLimit {
public:
  /// \param values by node, > 0; infinite where a node has none of its own.
  GradientLimit(const Nodes& nodes, std::vector<double> values, double gradient)
      : nodes_(nodes), values_(std::move(values)), gradient_(gradient),
        least_(*std::min_element(values_.begin(), values_.end())), states_(values_.size()),
        finalised_(values_.size(), nothing) {
    double most = least_;
    for (const double value : values_)
      most = std::isfinite(value) ? std::max(most, value) : most;
    constexpr double most_levels = 1 << 16;
    level_ = std::max(gradient_ * nodes_.step(), (most - least_) / most_levels);
    if (!(level_ > 0))
      level_ = 1;
    levels_.resize(static_cast<std::size_t>((most - least_) / level_) + 2);
  }

  std::vector<double> result() {
    begin();
    for (std::size_t level = 0; level < levels_.size(); ++level)
      while (!levels_[level].empty())
        finalise(level);
    std::vector<double> limited(values_.size());
    base_detail::for_each_block(
        nodes_.size(), [&](std::int64_t, std::int64_t from, std::int64_t to) {
          for (std::int64_t x = from; x != to; ++x) {
            const auto node = static_cast<std::int32_t>(x);
            limited[at(node)] = std::min(own_[at(node)], value_of(node, states_[at(node)]));
          }
        });
    return limited;
  }

private:
  /// A node's value and source in one word. The high bits are the value over the least one, a float
  /// whose bits are in the order of the values. The low bits are 0 if the node is its own source,
  /// else the source's number plus 1.
  using State = std::uint64_t;
  static constexpr State nothing = std::numeric_limits<State>::max();

  static std::size_t at(std::int32_t node) { return static_cast<std::size_t>(node); }
  State state_of(double value, std::uint32_t source) const {
    return State{std::bit_cast<std::uint32_t>(static_cast<float>(value / least_))} << 32 | source;
  }
  static float size_of(State state) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(state >> 32));
  }
  static std::int32_t source_of(std::int32_t node, State state) {
    const auto source = static_cast<std::uint32_t>(state);
    return source == 0 ? node : static_cast<std::int32_t>(source - 1);
  }
  std::size_t level_of(State state) const {
    const double level = (static_cast<double>(size_of(state)) - 1) * least_ / level_;
    const auto last = levels_.size() - 1;
    return level < static_cast<double>(last) ? static_cast<std::size_t>(std::max(level, 0.0))
                                             : last;
  }
  /// \pre the source is a node's own, or was finalised.
  double value_of(std::int32_t node, State state) const {
    const std::int32_t source = source_of(node, state);
    return source == node ? values_[at(node)]
                          : values_[at(source)] + gradient_ * nodes_.distance(source, node);
  }

  struct Finalised {
    std::int32_t node, source;
    double value;
  };

  /// Adds each node that lowers a neighbour to its level.
  void begin() {
    own_ = values_;
    std::vector<std::vector<std::int32_t>> of_block(
        static_cast<std::size_t>(base_detail::block_count(nodes_.size())));
    base_detail::for_each_block(
        nodes_.size(), [&](std::int64_t block, std::int64_t from, std::int64_t to) {
          for (std::int64_t x = from; x != to; ++x) {
            const auto node = static_cast<std::int32_t>(x);
            const double value = values_[at(node)];
            states_[at(node)] = state_of(value, 0);
            bool lowers = false;
            nodes_.for_each_neighbour(node, [&](std::int32_t other) {
              lowers =
                  lowers || (value < values_[at(other)] &&
                             value + gradient_ * nodes_.distance(node, other) < values_[at(other)]);
            });
            if (lowers)
              of_block[static_cast<std::size_t>(block)].push_back(node);
          }
        });
    add(of_block, 0);
  }

  /// \param least the level that is being finalised.
  void add(const std::vector<std::vector<std::int32_t>>& of_block, std::size_t least) {
    for (const std::vector<std::int32_t>& some : of_block)
      for (const std::int32_t node : some)
        levels_[std::max(least, level_of(states_[at(node)]))].push_back(node);
  }

  /// Finalises the nodes of a level: each hands its value on once.
  void finalise(std::size_t level) {
    const std::vector<std::int32_t> waiting = std::exchange(levels_[level], {});
    const std::int64_t count = std::ssize(waiting);
    const auto blocks = static_cast<std::size_t>(base_detail::block_count(count));
    std::vector<std::vector<Finalised>> finalised(blocks);
    base_detail::for_each_block(count, [&](std::int64_t block, std::int64_t from, std::int64_t to) {
      for (std::int64_t k = from; k != to; ++k) {
        const std::int32_t node = waiting[static_cast<std::size_t>(k)];
        const State state = states_[at(node)];
        // A node may be in the level several times.
        if (level_of(state) <= level &&
            std::atomic_ref(finalised_[at(node)]).exchange(state, std::memory_order_relaxed) !=
                state)
          finalised[static_cast<std::size_t>(block)].push_back(
              {node, source_of(node, state), value_of(node, state)});
      }
    });
    for (const std::vector<Finalised>& some : finalised)
      for (const Finalised& node : some)
        values_[at(node.node)] = std::min(values_[at(node.node)], node.value);
    std::vector<std::vector<std::int32_t>> lowered(blocks);
    base_detail::for_each_task(static_cast<std::int64_t>(blocks), [&](std::int64_t block) {
      for (const Finalised& node : finalised[static_cast<std::size_t>(block)])
        hand_on(node, lowered[static_cast<std::size_t>(block)]);
    });
    add(lowered, level);
  }

  State offer(std::int32_t source, std::int32_t to) const {
    return state_of(values_[at(source)] + gradient_ * nodes_.distance(source, to),
                    static_cast<std::uint32_t>(source) + 1);
  }

  /// The neighbour's current state depends on the threads. So it only decides whether to skip an
  /// offer: up to rounding, the offer along the straight path is the smaller of the two.
  void hand_on(const Finalised& from, std::vector<std::int32_t>& lowered) {
    constexpr float rounding = 1e-6F;
    nodes_.for_each_neighbour(from.node, [&](std::int32_t to) {
      std::atomic_ref state(states_[at(to)]);
      State known = state.load(std::memory_order_relaxed), offered = offer(from.source, to);
      if (size_of(known) < size_of(offered) * (1 - rounding))
        return;
      if (from.source != from.node && !nodes_.sees(from.source, to))
        offered = offer(from.node, to);
      while (offered < known)
        if (state.compare_exchange_weak(known, offered, std::memory_order_relaxed)) {
          lowered.push_back(to);
          return;
        }
    });
  }

  const Nodes& nodes_;
  std::vector<double> values_; ///< by node: the value of its source; at first its own
  std::vector<double> own_;    ///< the given ones
  double gradient_, least_, level_ = 1;
  std::vector<State> states_, finalised_;
  std::vector<std::vector<std::int32_t>> levels_; ///< nodes that wait, by value
};

} // namespace calotte::density_detail
