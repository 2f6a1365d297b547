// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/coastlines.h"
#include "draw/fine_coast.h"
#include "draw/projection.h"
#include "draw/vector.h"
#include "support/gshhg.h"
#include "support/pictures.h"

#include <cairo.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::tools;

namespace {

/// On land, by the parity of the coasts that the meridian crosses between a point and the north
/// pole, which is in the sea.
bool on_land(const LonLat& point) {
  int crossings = 0;
  for (const auto& line : coastlines()) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double from = std::remainder(line[i - 1].longitude - point.longitude, 360);
      const double to = from + line[i].longitude - line[i - 1].longitude;
      if ((from < 0) != (to < 0) && std::abs(from) < 90) {
        const double t = from / (from - to);
        crossings += std::lerp(line[i - 1].latitude, line[i].latitude, t) > point.latitude;
      }
    }
  }
  return crossings % 2 == 1;
}

/// The chord between a direction and the nearest coast.
double distance_to_coast(const Vector3d& p, const std::vector<std::array<Vector3d, 2>>& sides) {
  double least = 2;
  for (const auto& [a, b] : sides) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - t * (b - a)).norm());
  }
  return least;
}

std::vector<std::array<Vector3d, 2>> coast_sides(const Eigen::Matrix3d& frame) {
  std::vector<std::array<Vector3d, 2>> sides;
  for (const auto& line : coastlines()) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      sides.push_back({frame * direction_of(line[i - 1]), frame * direction_of(line[i])});
    }
  }
  return sides;
}

/// Coastlines on a yellow map, of this many pixels a radian.
class CoastMap {
public:
  CoastMap(Projection projection, const Eigen::Matrix3d& frame, int width)
      : width_(width), image_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, width)) {
    cairo_t* context = cairo_create(image_);
    cairo_set_source_rgb(context, 1, 1, 0);
    cairo_paint(context);
    cairo_translate(context, width / 2.0, width / 2.0);
    draw_coastlines(context, frame, projection, width, 1);
    cairo_destroy(context);
  }
  CoastMap(const CoastMap&) = delete;
  CoastMap& operator=(const CoastMap&) = delete;
  ~CoastMap() { cairo_surface_destroy(image_); }
  bool painted(int x, int y) const {
    const auto* row = cairo_image_surface_get_data(image_) +
                      static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(image_);
    return (reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff) != 0xffff00;
  }
  bool painted_near(double x, double y) const {
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const bool inside =
            column + i >= 0 && column + i < width_ && row + j >= 0 && row + j < width_;
        if (inside && painted(column + i, row + j)) {
          return true;
        }
      }
    }
    return false;
  }

private:
  int width_;
  cairo_surface_t* image_;
};

/// Each painted pixel is near a coast, and each coast before the limb is painted.
template <class Map> void check_map(Projection projection, const LonLat& view) {
  constexpr int width = 400;
  const Eigen::Matrix3d frame = frame_of(view);
  const CoastMap map(projection, frame, width);
  const auto sides = coast_sides(frame);
  const double scale = width / (2 * Map::half_width);
  const int height = static_cast<int>(2 * Map::half_height * scale), top = (width - height) / 2;
  const typename Map::Rays rays(width, height);
  int painted = 0, outside = 0, far = 0, missing = 0;
  for (int y = 0; y < width; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!map.painted(x, y)) {
        continue;
      }
      ++painted;
      Vector3d p;
      if (y < top || y >= top + height || !rays.at(y - top, x, p)) {
        outside += std::hypot(x + 0.5 - width / 2.0, y + 0.5 - width / 2.0) > width / 2.0 + 1;
      } else if (p.z() > 0.2 || projection == Projection::plate_carree) {
        // Three pixels; near the limb they are wide.
        const double pixel = projection == Projection::globe ? 1 / p.z() : 1;
        far += distance_to_coast(p, sides) > 3 * pixel / scale ? 1 : 0;
      }
    }
  }
  for (const auto& [a, b] : sides) {
    if (Map::shows(a) && std::abs(Map::project(a).u) < 0.98 * Map::half_width) {
      const MapPoint point = Map::project(a);
      missing +=
          map.painted_near(width / 2.0 + scale * point.u, width / 2.0 - scale * point.v) ? 0 : 1;
    }
  }
  CHECK(painted > 1000);
  CHECK(outside == 0);
  CHECK(far == 0);
  CHECK(missing == 0);
}

} // namespace

TEST_CASE("coastlines: closed, in short steps, none along the date line") {
  const auto lines = coastlines();
  CHECK(lines.size() > 100);
  std::size_t open = 0;
  for (const auto& line : lines) {
    open += std::abs(std::remainder(line.back().longitude - line.front().longitude, 360)) > 1e-9 ||
                    line.back().latitude != line.front().latitude
                ? 1
                : 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double across = line[i].longitude - line[i - 1].longitude;
      const double up = line[i].latitude - line[i - 1].latitude;
      CHECK(std::abs(across) < 10);
      CHECK(std::abs(up) < 10);
      const bool on_date_line = std::abs(std::remainder(line[i].longitude, 360)) > 179.999;
      CHECK(!(on_date_line && std::abs(across) < 1e-9));
      CHECK(line[i].latitude > -86);
      CHECK(line[i].latitude < 84);
    }
  }
  CHECK(open == 2); // an island that the date line cuts in two
}

TEST_CASE("coastlines divide land from sea") {
  for (const LonLat& land : {LonLat{2.3, 48.8}, LonLat{-98, 39}, LonLat{149, -35}, LonLat{100, 65},
                             LonLat{25, 0}, LonLat{-60, -10}, LonLat{114, 0}, LonLat{-42, 75},
                             LonLat{10, -89}, LonLat{-178, 67}, LonLat{178, 67}}) {
    CAPTURE(land.longitude);
    CHECK(on_land(land));
  }
  for (const LonLat& sea : {LonLat{-30, 0}, LonLat{-150, 20}, LonLat{80, -30}, LonLat{0, 85},
                            LonLat{18, 35}, LonLat{51, 42}, LonLat{-179, 0}, LonLat{179, 0},
                            LonLat{-87, 25}, LonLat{179, 71.8}, LonLat{-120, -60}}) {
    CAPTURE(sea.longitude);
    CHECK(!on_land(sea));
  }
}

TEST_CASE("enlarged maps have the coasts of GSHHG, if these are installed") {
  gshhg_file('l');
  gshhg_file('i');
  CHECK(fine_coast(20, CALOTTE_GSHHG).empty()); // the usual ones suffice
  CHECK(fine_coast(1, "nowhere").empty());
  const Eigen::Vector3d tarifa = tools::direction_of(LonLat{-5.609, 36.001});
  std::size_t corners = 0;
  for (const double pixel : {7., 3., 0.5}) {
    CAPTURE(pixel);
    const std::vector<Points3> rings = fine_coast(pixel, CALOTTE_GSHHG);
    std::size_t count = 0;
    double nearest = 2;
    for (const Points3& ring : rings) {
      count += static_cast<std::size_t>(ring.cols());
      nearest = std::min(nearest, (ring.colwise() - tarifa).colwise().norm().minCoeff());
      CHECK((ring.colwise() - ring.col(0)).colwise().norm().maxCoeff() > 3 * pixel / 6371.1);
    }
    CHECK(nearest * 6371 < std::max(10.0, 2 * pixel));
    CHECK(static_cast<double>(count) > 1.3 * static_cast<double>(corners));
    corners = count;
  }
  const Folder folder;
  std::ofstream(folder.file("binned_GSHHS_l.nc")) << "CDF\x01 and no more";
  CHECK(fine_coast(3, folder.path).empty());
}

TEST_CASE("maps show the coasts on the visible side, and nothing else") {
  for (const LonLat& view : {LonLat{115, -3}, LonLat{180, 60}, LonLat{0, -90}}) {
    check_map<Orthographic>(Projection::globe, view);
  }
  for (const double longitude : {0., 180., -77.}) {
    check_map<PlateCarree>(Projection::plate_carree, {longitude, 0});
  }
}
