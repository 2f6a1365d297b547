// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "io/region_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

namespace calotte::io_detail {
namespace {

/// The arcs of rings, for the removal of those that occur in both directions.
class Joiner {
public:
  explicit Joiner(std::vector<RegionRing> rings) : rings_(std::move(rings)) {}

  std::vector<RegionRing> join() {
    mark_pairs();
    std::vector<RegionRing> result;
    for (std::size_t r = 0; r < rings_.size(); ++r)
      if (std::find(paired_[r].begin(), paired_[r].end(), true) == paired_[r].end())
        result.push_back(rings_[r]);
      else
        list(r);
    while (!starts_.empty())
      result.push_back(next_ring());
    return result;
  }

private:
  using Place = std::array<double, 3>;
  struct Arc {
    std::size_t ring, corner; ///< the corner where it starts
  };

  Place start_of(const Arc& arc) const {
    const Vec3& p = rings_[arc.ring].corners[arc.corner];
    return {p.x, p.y, p.z};
  }
  Place end_of(const Arc& arc) const {
    return start_of({arc.ring, (arc.corner + 1) % rings_[arc.ring].corners.size()});
  }

  void mark(const Arc& arc) { paired_[arc.ring][arc.corner] = true; }

  void mark_pairs() {
    std::map<std::pair<Place, Place>, std::vector<Arc>> unpaired;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      paired_.emplace_back(rings_[r].corners.size(), false);
      for (std::size_t c = 0; c < rings_[r].corners.size(); ++c) {
        const Arc arc{r, c};
        const auto opposite = unpaired.find({end_of(arc), start_of(arc)});
        if (opposite == unpaired.end() || opposite->second.empty()) {
          unpaired[{start_of(arc), end_of(arc)}].push_back(arc);
          continue;
        }
        mark(arc);
        mark(opposite->second.back());
        opposite->second.pop_back();
      }
    }
  }

  /// Lists the remaining arcs of a ring by their starts.
  void list(std::size_t r) {
    for (std::size_t c = 0; c < rings_[r].corners.size(); ++c)
      if (!paired_[r][c])
        starts_[start_of({r, c})].push_back({r, c});
  }

  /// As many arcs start at a place as end there: a path ends where it began.
  RegionRing next_ring() {
    const auto first = starts_.begin();
    const Place begin = first->first;
    RegionRing ring{
        {}, rings_[first->second.back().ring].origin + " without edges in common with others"};
    Place at = begin;
    do {
      const auto here = starts_.find(at);
      const Arc arc = here->second.back();
      here->second.pop_back();
      if (here->second.empty())
        starts_.erase(here);
      ring.corners.push_back(rings_[arc.ring].corners[arc.corner]);
      at = end_of(arc);
    } while (at != begin);
    return ring;
  }

  std::vector<RegionRing> rings_;
  std::vector<std::vector<bool>> paired_; ///< by ring and corner: the arc that starts there
  std::map<Place, std::vector<Arc>> starts_;
};

} // namespace

std::optional<std::vector<double>> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  constexpr std::string_view blanks = " \t";
  const char *at = text.data(), *const end = text.data() + text.size();
  const auto skip = [&](std::string_view characters, int most) {
    for (; at != end && most > 0 && characters.find(*at) != std::string_view::npos; --most)
      ++at;
  };
  constexpr int any = 1 << 30;
  for (skip(blanks, any); at != end; skip(blanks, any)) {
    if (!numbers.empty()) {
      skip(",;|", 1);
      skip(blanks, any);
    }
    skip("+", 1);
    double number = 0;
    const auto [stop, problem] = std::from_chars(at, end, number);
    if (problem != std::errc() || !std::isfinite(number))
      return std::nullopt;
    at = stop;
    if (at != end && (blanks.find(*at) == std::string_view::npos) && *at != ',' && *at != ';' &&
        *at != '|')
      return std::nullopt;
    numbers.push_back(number);
  }
  return numbers.empty() ? std::nullopt : std::optional(numbers);
}

void drop_repeated(SphericalRing& ring) {
  const auto same = [](const Vec3& a, const Vec3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  };
  ring.erase(std::unique(ring.begin(), ring.end(), same), ring.end());
  while (ring.size() > 1 && same(ring.front(), ring.back()))
    ring.pop_back();
}

std::vector<RegionRing> joined(std::vector<RegionRing> rings) {
  return Joiner(std::move(rings)).join();
}

std::vector<Points3> corners_of(const std::vector<RegionRing>& rings) {
  std::vector<Points3> all;
  for (const RegionRing& ring : rings) {
    Points3 corners(3, std::ssize(ring.corners));
    for (std::size_t i = 0; i < ring.corners.size(); ++i)
      set_column(corners, static_cast<std::int64_t>(i), ring.corners[i]);
    all.push_back(std::move(corners));
  }
  return all;
}

std::string explained(const std::string& name, const std::vector<RegionRing>& rings,
                      const Error& error) {
  constexpr std::string_view word = "ring ";
  const std::string_view what = error.what();
  std::string message = name + ": ";
  std::size_t done = 0;
  for (std::size_t found = what.find(word); found != std::string_view::npos;
       found = what.find(word, found + 1)) {
    std::size_t ring = rings.size();
    const char* const number = what.data() + found + word.size();
    const auto [stop, problem] = std::from_chars(number, what.data() + what.size(), ring);
    const bool begins = found == 0 || what[found - 1] == ' ';
    if (!begins || problem != std::errc() || ring >= rings.size())
      continue;
    message += std::string(what.substr(done, found - done)) + rings[ring].origin;
    done = static_cast<std::size_t>(stop - what.data());
  }
  return message + std::string(what.substr(done));
}

} // namespace calotte::io_detail
