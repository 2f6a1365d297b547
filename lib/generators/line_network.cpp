// SPDX-License-Identifier: GPL-3.0-or-later
#include "generators/line_network.h"

#include "domain/lines.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace calotte::generators_detail {
namespace {

class Builder {
public:
  void add(const std::vector<Vec3>& line) {
    std::int32_t before = -1;
    for (const Vec3& at : line) {
      const std::int32_t here = id_of(at);
      const Vec3 apart = before >= 0 ? at - point(before) : Vec3{};
      if (dot(apart, apart) > 0)
        join(before, here);
      before = here;
    }
  }

  LineNetwork network() {
    trace();
    LineNetwork out;
    for (const auto& near : near_)
      out.neighbours.push_back(static_cast<int>(near.size()));
    out.points = std::move(points_);
    out.chains = std::move(chains_);
    return out;
  }

private:
  const Vec3& point(std::int32_t id) const { return points_[static_cast<std::size_t>(id)]; }
  std::vector<std::int32_t>& near(std::int32_t id) { return near_[static_cast<std::size_t>(id)]; }

  std::int32_t id_of(const Vec3& at) {
    const auto [found, is_new] = ids_.try_emplace({at.x + 0.0, at.y + 0.0, at.z + 0.0}, // no -0
                                                  static_cast<std::int32_t>(points_.size()));
    if (is_new) {
      points_.push_back(at);
      near_.emplace_back();
    }
    return found->second;
  }

  void join(std::int32_t a, std::int32_t b) {
    if (std::find(near(a).begin(), near(a).end(), b) != near(a).end())
      return;
    near(a).push_back(b);
    near(b).push_back(a);
  }

  /// Follows a chain from a point by way of a neighbour to an end or a confluence, or back to the
  /// point.
  void follow(std::int32_t from, std::int32_t to) {
    std::vector<std::int32_t>& chain = chains_.emplace_back();
    chain.push_back(from);
    while (true) {
      passed_.insert(std::minmax(from, to));
      chain.push_back(to);
      if (near(to).size() != 2 || to == chain.front())
        return;
      const std::int32_t next = near(to)[near(to)[0] == from ? 1 : 0];
      from = to;
      to = next;
    }
  }

  void follow_all(std::int32_t from) {
    for (const std::int32_t to : near(from))
      if (!passed_.contains(std::minmax(from, to)))
        follow(from, to);
  }

  /// Traces all chains. Where the lines leave a choice, the order depends on the points alone.
  void trace() {
    const auto count = static_cast<std::int32_t>(points_.size());
    const auto before = [&](std::int32_t a, std::int32_t b) {
      const Vec3 &p = point(a), &q = point(b);
      return std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z};
    };
    for (auto& near : near_)
      std::sort(near.begin(), near.end(), before);
    for (std::int32_t id = 0; id < count; ++id)
      if (near(id).empty())
        chains_.push_back({id});
      else if (near(id).size() != 2)
        follow_all(id);
    std::vector<std::int32_t> ordered(static_cast<std::size_t>(count));
    std::iota(ordered.begin(), ordered.end(), 0);
    std::sort(ordered.begin(), ordered.end(), before);
    for (const std::int32_t id : ordered) // loops
      if (near(id).size() == 2)
        follow_all(id);
  }

  std::map<std::array<double, 3>, std::int32_t> ids_;
  std::vector<Vec3> points_;
  std::vector<std::vector<std::int32_t>> near_; ///< neighbours of each point
  std::set<std::pair<std::int32_t, std::int32_t>> passed_;
  std::vector<std::vector<std::int32_t>> chains_;
};

} // namespace

LineNetwork make_network(const std::vector<Points3>& lines, bool sphere) {
  Builder builder;
  for (std::size_t k = 0; k < lines.size(); ++k)
    builder.add(domain_detail::checked_line(lines[k], static_cast<std::int64_t>(k), sphere));
  return builder.network();
}

} // namespace calotte::generators_detail
