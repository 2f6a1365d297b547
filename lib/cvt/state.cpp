// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/state.h"

#include "base/parallel.h"
#include "cvt/shape.h"

#include <utility>

namespace calotte {
namespace cvt_detail {

CvtState State::wrapped(State&& state) {
  CvtState whole;
  *whole.state_ = std::move(state);
  return whole;
}

std::vector<std::uint8_t> fixed_generators(const State& state) {
  std::vector<std::uint8_t> fixed(state.fixed > 0 ? state.id.size() : 0);
  for (std::size_t r = 0; r < fixed.size(); ++r)
    if (const std::int32_t id = state.id[r]; id < state.fixed)
      fixed[r] = id < state.on_lines.first   ? pinned
                 : id < state.on_lines.inner ? pinned_at_end
                 : id < state.on_lines.end   ? pinned_on_line
                                             : sliding;
  return fixed;
}

std::vector<std::int32_t> boundary_order(const State& state,
                                         const std::vector<std::int32_t>& next) {
  if (next.empty())
    return {};
  std::vector<std::int32_t> rank(next.size()), along(state.id.size(), -1);
  for (std::size_t r = 0; r < state.id.size(); ++r)
    if (const std::int32_t id = state.id[r]; id < state.fixed)
      rank[static_cast<std::size_t>(id)] = static_cast<std::int32_t>(r);
  for (std::size_t id = 0; id < next.size(); ++id)
    if (next[id] >= 0)
      along[static_cast<std::size_t>(rank[id])] = rank[static_cast<std::size_t>(next[id])];
  return along;
}

Points3 in_order(const State& state) {
  Points3 points(3, state.points.cols());
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t r = begin; r != end; ++r)
      points.col(state.id[static_cast<std::size_t>(r)]) = state.points.col(r);
  });
  return points;
}

} // namespace cvt_detail

CvtState::CvtState() : state_(std::make_unique<cvt_detail::State>()) {}
CvtState::CvtState(const CvtState& other)
    : state_(std::make_unique<cvt_detail::State>(*other.state_)) {}
CvtState::CvtState(CvtState&& other) noexcept = default;
CvtState& CvtState::operator=(CvtState other) noexcept {
  state_.swap(other.state_);
  return *this;
}
CvtState::~CvtState() = default;

Points3 CvtState::points() const { return cvt_detail::in_order(*state_); }
const CvtReport& CvtState::report() const { return state_->report; }

} // namespace calotte
