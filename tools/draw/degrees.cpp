// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/degrees.h"

#include "text/text.h"

#include <algorithm>
#include <array>
#include <optional>

namespace calotte::tools {

namespace {

constexpr int most_lines = 6;  ///< in each direction
constexpr int points_of = 128; ///< along a line or an edge

std::string magnitude(double value) { return formatted("%.6g\u00b0", std::abs(value)); }

/// Degrees on the earth that a window shows. Longitudes are continuous, about that of its middle.
struct Extent {
  double west = HUGE_VAL, east = -HUGE_VAL, south = HUGE_VAL, north = -HUGE_VAL;
  bool pole = false; ///< true if it shows one: all longitudes meet
};

/// The smallest round step with at most so many lines in a range.
double step_of(double range) {
  for (const double step :
       {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 20.0}) {
    if (range / step <= most_lines) {
      return step;
    }
  }
  return graticule_step;
}

template <class Map> class Finder {
public:
  Finder(const MapWindow& window, const Eigen::Matrix3d& frame)
      : window_(window), frame_(frame), width_(window.half_width<Map>()),
        height_(window.half_height<Map>()) {
    middle_ = lonlat(at(0, 0).value_or(Vector3d::UnitX()), 0);
    measure();
    longitudes_ = extent_.pole ? graticule_step : step_of(extent_.east - extent_.west);
    latitudes_ = step_of(extent_.north - extent_.south);
  }

  Degrees degrees() const {
    Degrees result;
    result.lines = lines();
    result.bent = Map::period == 0 && std::any_of(result.lines.begin(), result.lines.end(),
                                                  [this](const auto& line) { return bent(line); });
    using At = DegreeLabel::At;
    add_edge(At::bottom, false, result.labels);
    if (!extent_.pole) {
      add_edge(At::left, true, result.labels);
      return result;
    }
    for (const At edge : {At::left, At::right}) {
      add_edge(edge, false, result.labels);
    }
    add_inside(result.labels);
    return result;
  }

private:
  /// The point on the earth of a point of the window, each coordinate from -1 to 1.
  std::optional<Vector3d> at(double x, double y) const {
    Vector3d p;
    if (!Map::direction({x * width_, window_.middle + y * height_}, p)) {
      return std::nullopt;
    }
    return Vector3d(frame_.transpose() * p);
  }

  /// \param near a longitude less than half a turn away.
  static LonLat lonlat(const Vector3d& p, double near) {
    const LonLat point = lonlat_of(p);
    return {near + std::remainder(point.longitude - near, 360), point.latitude};
  }

  bool shows(const Vector3d& on_earth) const {
    const Vector3d p = frame_ * on_earth;
    const MapPoint point = Map::project(p);
    return Map::shows(p) && std::abs(point.u) < width_ &&
           std::abs(point.v - window_.middle) < height_;
  }

  void measure() {
    constexpr int samples = 24;
    for (int i = -samples; i <= samples; ++i) {
      for (int j = -samples; j <= samples; ++j) {
        if (const auto p = at(1.0 * i / samples, 1.0 * j / samples)) {
          const LonLat point = lonlat(*p, middle_.longitude);
          extent_.west = std::min(extent_.west, point.longitude);
          extent_.east = std::max(extent_.east, point.longitude);
          extent_.south = std::min(extent_.south, point.latitude);
          extent_.north = std::max(extent_.north, point.latitude);
        }
      }
    }
    const Vector3d pole = Vector3d::UnitZ();
    extent_.pole = Map::period == 0 && (shows(pole) || shows(-pole));
    if (extent_.pole) {
      (shows(pole) ? extent_.north : extent_.south) = shows(pole) ? 90 : -90;
      extent_.west = -180;
      extent_.east = 180 - 1e-6; // each meridian once
    }
  }

  /// Calls visit(value) for the multiples of a step in a range.
  template <class Visit>
  static void for_each_multiple(double low, double high, double step, Visit visit) {
    for (double k = std::ceil(low / step); k * step <= high; ++k) {
      visit(k * step);
    }
  }

  EarthLines lines() const {
    EarthLines result;
    const auto add = [&](const LonLat& from, const LonLat& to) {
      std::vector<Vector3d> line;
      for (int i = 0; i <= points_of; ++i) {
        const double t = 1.0 * i / points_of;
        line.push_back(direction_of(LonLat{std::lerp(from.longitude, to.longitude, t),
                                           std::lerp(from.latitude, to.latitude, t)}));
      }
      result.push_back(std::move(line));
    };
    const Extent& e = extent_;
    for_each_multiple(e.west, e.east, longitudes_, [&](double longitude) {
      add({longitude, e.south}, {longitude, e.north});
    });
    for_each_multiple(e.south, e.north, latitudes_, [&](double latitude) {
      add({e.west, latitude}, {e.east, latitude});
    });
    return result;
  }

  /// Whether the visible part of a line runs aside, neither along nor across the window.
  bool bent(const std::vector<Vector3d>& line) const {
    double left = HUGE_VAL, right = -HUGE_VAL, low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vector3d& on_earth : line) {
      if (shows(on_earth)) {
        const MapPoint point = Map::project(frame_ * on_earth);
        left = std::min(left, point.u);
        right = std::max(right, point.u);
        low = std::min(low, point.v);
        high = std::max(high, point.v);
      }
    }
    constexpr double part = 1.0 / 40;
    return std::min((right - left) / (2 * width_), (high - low) / (2 * height_)) > part;
  }

  static std::array<double, 2> on_edge(DegreeLabel::At edge, double t) {
    switch (edge) {
    case DegreeLabel::At::left:
      return {-1, t};
    case DegreeLabel::At::right:
      return {1, t};
    default:
      return {t, -1};
    }
  }

  /// The labels where meridians, or parallels, meet an edge.
  void add_edge(DegreeLabel::At edge, bool parallels, std::vector<DegreeLabel>& labels) const {
    double before = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i <= points_of; ++i) {
      const double t = 2.0 * i / points_of - 1;
      const auto [x, y] = on_edge(edge, t);
      const auto p = at(x, y);
      if (!p) {
        before = std::numeric_limits<double>::quiet_NaN();
        continue;
      }
      const bool first = std::isnan(before);
      const LonLat point = lonlat(*p, first || parallels ? middle_.longitude : before);
      const double value = parallels ? point.latitude : point.longitude;
      if (!first) {
        add_crossings(edge, parallels, {before, value}, t, labels);
      }
      before = value;
    }
  }

  /// \param values of the degrees at the last step of an edge, which ends at t.
  void add_crossings(DegreeLabel::At edge, bool parallels, const std::array<double, 2>& values,
                     double t, std::vector<DegreeLabel>& labels) const {
    const double low = std::min(values[0], values[1]), high = std::max(values[0], values[1]);
    for_each_multiple(low, high, parallels ? latitudes_ : longitudes_, [&](double value) {
      if (value == low && low != high) {
        return; // the end of the step before
      }
      const double part = high > low ? (value - values[0]) / (values[1] - values[0]) : 0;
      const auto [x, y] = on_edge(edge, t - 2.0 / points_of * (1 - part));
      labels.push_back({edge,
                        {x * width_, window_.middle + y * height_},
                        parallels ? latitude_label(value) : longitude_label(value)});
    });
  }

  /// Latitudes around a pole, between two meridians.
  void add_inside(std::vector<DegreeLabel>& labels) const {
    const double longitude = middle_.longitude + 1.5 * graticule_step;
    for_each_multiple(extent_.south, extent_.north, latitudes_, [&](double latitude) {
      const Vector3d p = direction_of(LonLat{longitude, latitude});
      if (std::abs(latitude) < 90 && shows(p)) {
        labels.push_back(
            {DegreeLabel::At::inside, Map::project(frame_ * p), latitude_label(latitude)});
      }
    });
  }

  MapWindow window_;
  Eigen::Matrix3d frame_;
  double width_, height_; ///< half of the window's
  LonLat middle_;
  Extent extent_;
  double longitudes_ = 0, latitudes_ = 0; ///< steps, degrees
};

} // namespace

std::string longitude_label(double longitude) {
  const double east = std::remainder(longitude, 360);
  const bool neither = std::abs(east) < 1e-9 || std::abs(std::abs(east) - 180) < 1e-9;
  return magnitude(neither ? std::round(east) : east) + (neither ? "" : east > 0 ? "E" : "W");
}

std::string latitude_label(double latitude) {
  const bool equator = std::abs(latitude) < 1e-9;
  return magnitude(equator ? 0 : latitude) + (equator ? "" : latitude > 0 ? "N" : "S");
}

Degrees degrees_of(const MapWindow& window, const Eigen::Matrix3d& frame) {
  return with_map(window.projection,
                  [&]<class Map>() { return Finder<Map>(window, frame).degrees(); });
}

} // namespace calotte::tools
