// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "io/shapes/coast_file.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

// GSHHG (Wessel and Smith, J. Geophys. Res. 101, 1996) in the NetCDF files of GMT: coasts are cut
// into segments by square bins of longitude and latitude. A segment ends on the border of its bin
// where the next one of the polygon begins, with the same coordinates; or it is a closed polygon.

namespace calotte::io_detail {
namespace {

/// A point in units of 1/65535 of a bin, east of 0 degrees and north of the south pole.
using GridPoint = std::pair<std::int64_t, std::int64_t>;
using Line = std::vector<GridPoint>;

constexpr std::int64_t bin_units = 65535;

class Binned {
public:
  explicit Binned(const NetcdfReader& file)
      : file_(file), bins_(scalar("N_bins_in_360_longitude_range")),
        rows_(scalar("N_bins_in_180_degree_latitude_range")),
        first_segment_(all("Id_of_first_segment_in_a_bin")), segments_(all("N_segments_in_a_bin")),
        facts_(all("Embedded_npts_levels_exit_entry_for_a_segment")),
        first_point_(all("Id_of_first_point_in_a_segment")), polygon_(all("Id_of_GSHHS_ID")),
        x_(all("Relative_longitude_from_SW_corner_of_bin")),
        y_(all("Relative_latitude_from_SW_corner_of_bin")) {}

  Coast read() {
    for (std::size_t bin = 0; bin < first_segment_.size(); ++bin)
      for (std::int32_t s = 0; s < segments_.at(bin); ++s)
        add_segment(static_cast<std::int64_t>(bin),
                    static_cast<std::size_t>(first_segment_[bin] + s));
    while (!open_.empty())
      join_segments(open_.begin()->first.first);
    return std::move(coast_);
  }

private:
  std::int64_t scalar(const std::string& name) const {
    const std::int32_t value = file_.ints(name, {1}).front();
    if (value <= 0)
      file_.fail("{} is not positive; give a binned file of GSHHG", name);
    return value;
  }
  std::vector<std::int32_t> all(const std::string& name) const { return file_.ints(name, {-1}); }

  void add_segment(std::int64_t bin, std::size_t segment) {
    constexpr std::int32_t land = 1, closed = 4;
    const std::int32_t facts = facts_.at(segment), points = facts >> 9, level = facts >> 6 & 7,
                       entry = facts >> 3 & 7;
    if (level != land || points == 0)
      return;
    const std::int64_t west = bin % bins_ * bin_units,
                       south = (rows_ - 1 - bin / bins_) * bin_units;
    Line line;
    for (std::int32_t k = 0; k < points; ++k) {
      const auto point = static_cast<std::size_t>(first_point_.at(segment) + k);
      line.emplace_back((west + (x_.at(point) & 0xffff)) % (bins_ * bin_units),
                        south + (y_.at(point) & 0xffff));
    }
    if (entry == closed)
      add(line);
    else
      open_.emplace(std::pair(polygon_.at(segment), line.front()), std::move(line));
  }

  /// Joins the segments of a polygon to a ring, and adds it.
  void join_segments(std::int32_t polygon) {
    auto next = open_.lower_bound({polygon, {INT64_MIN, INT64_MIN}});
    const GridPoint start = next->first.second;
    Line ring;
    while (next != open_.end()) {
      ring.insert(ring.end(), next->second.begin(), next->second.end() - 1);
      const GridPoint end = next->second.back();
      open_.erase(next);
      if (end == start)
        return add(ring);
      next = open_.find({polygon, end});
    }
    file_.fail("the coast of polygon {} is not closed; give a binned file of GSHHG", polygon);
  }

  void add(const Line& line) {
    WrittenRing ring;
    for (const auto& [x, y] : line)
      ring.corners.push_back(from_lonlat(
          360.0 * static_cast<double>(x) / static_cast<double>(bins_ * bin_units),
          180.0 * static_cast<double>(y) / static_cast<double>(rows_ * bin_units) - 90));
    drop_repeated(ring.corners);
    enclose(ring);
    add_land({ring}, coast_);
  }

  const NetcdfReader& file_;
  std::int64_t bins_, rows_; ///< numbers of bins around the sphere, and from pole to pole
  std::vector<std::int32_t> first_segment_, segments_, facts_, first_point_, polygon_, x_, y_;
  /// Open segments by polygon and first point. Two may begin at the same point, where the coast
  /// touches the border of a bin.
  std::multimap<std::pair<std::int32_t, GridPoint>, Line> open_;
  Coast coast_;
};

} // namespace

Coast read_gshhg(const NetcdfReader& file) {
  try {
    return Binned(file).read();
  } catch (const std::out_of_range&) {
    file.fail("a segment or a point is out of range; give a binned file of GSHHG");
  }
}

} // namespace calotte::io_detail
