// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/projection.h"

#include "base/message.h"
#include "io/bytes/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace calotte::io_detail {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using LonLat = std::array<double, 2>;

// ---- Parameters

class Parameters {
public:
  Parameters(const NetcdfReader& file, const std::string& mapping)
      : file_(file), mapping_(mapping) {}

  std::optional<double> find(const char* name, std::size_t index = 0) const {
    const std::vector<double> values = file_.numbers(mapping_, name);
    if (index >= values.size())
      return std::nullopt;
    if (!std::isfinite(values[index]))
      fail("its {} is not finite; correct it", name);
    return values[index];
  }
  double require(const char* name) const {
    const std::optional<double> value = find(name);
    if (!value)
      fail("it has no {}; add it", name);
    return *value;
  }
  double latitude(const char* name) const {
    const double value = require(name);
    if (std::abs(value) > 90)
      fail("its {} is {}; give -90 to 90 degrees", name, value);
    return value * degree;
  }

  template <class... Values>
  [[noreturn]] void fail(std::type_identity_t<Pattern<Values...>> pattern,
                         const Values&... values) const {
    file_.fail("the grid mapping {}: {}", mapping_, message(pattern, values...));
  }

private:
  const NetcdfReader& file_;
  const std::string& mapping_;
};

/// The figure of the Earth: WGS 84 where a mapping names none.
struct Ellipsoid {
  double radius = 6378137;         ///< semi-major axis, metres
  double square = 0.0066943799901; ///< of the eccentricity

  explicit Ellipsoid(const Parameters& of) {
    if (const std::optional<double> earth = of.find("earth_radius"))
      radius = *earth, square = 0;
    if (const std::optional<double> major = of.find("semi_major_axis")) {
      radius = *major;
      const std::optional<double> minor = of.find("semi_minor_axis"),
                                  inverse = of.find("inverse_flattening");
      const double flattening = minor                     ? 1 - *minor / radius
                                : inverse && *inverse > 0 ? 1 / *inverse
                                                          : 0;
      square = flattening * (2 - flattening);
    }
    if (!(radius > 0 && square >= 0 && square < 0.5))
      of.fail("its axes of the Earth are no ellipsoid near a sphere; correct them");
  }

  double eccentricity() const { return std::sqrt(square); }
  double m(double latitude) const { // Eq. 14-15
    const double sine = std::sin(latitude);
    return std::cos(latitude) / std::sqrt(1 - square * sine * sine);
  }
  double t(double latitude) const { // Eq. 15-9
    const double e = eccentricity(), sine = e * std::sin(latitude);
    return std::tan(pi / 4 - latitude / 2) / std::pow((1 - sine) / (1 + sine), e / 2);
  }
  /// The latitude of t, Eq. 7-9.
  double latitude_of_t(double t) const {
    const double e = eccentricity();
    double latitude = pi / 2 - 2 * std::atan(t);
    for (int pass = 0; pass < 20; ++pass) {
      const double sine = e * std::sin(latitude),
                   next = pi / 2 - 2 * std::atan(t * std::pow((1 - sine) / (1 + sine), e / 2));
      if (next == std::exchange(latitude, next))
        break;
    }
    return latitude;
  }
  double q(double latitude) const { // Eq. 3-12
    const double e = eccentricity(), sine = std::sin(latitude);
    return e == 0 ? 2 * sine
                  : (1 - square) * (sine / (1 - square * sine * sine) + std::atanh(e * sine) / e);
  }
  /// The latitude of q, Eq. 3-16.
  double latitude_of_q(double value) const {
    const double e = eccentricity(), s = std::clamp(value / q(pi / 2), -1.0, 1.0);
    if (e == 0)
      return std::asin(s);
    double latitude = std::asin(s);
    for (int pass = 0; pass < 20; ++pass) {
      const double sine = std::sin(latitude), cosine = std::cos(latitude),
                   rest = 1 - square * sine * sine;
      if (cosine < 1e-9)
        break;
      const double step = rest * rest / (2 * cosine) *
                          (value / (1 - square) - sine / rest - std::atanh(e * sine) / e);
      latitude = std::clamp(latitude + step, -pi / 2, pi / 2);
      if (std::abs(step) < 1e-16)
        break;
    }
    return latitude;
  }
};

double wrapped(double longitude) { return longitude - 360 * std::floor((longitude + 180) / 360); }

LonLat in_degrees(double longitude, double latitude) {
  return {wrapped(longitude / degree), latitude / degree};
}

// ---- Projections

/// Eqs. 20-16, 21-39 and 21-40.
struct PolarStereographic : Projection::Inverse {
  explicit PolarStereographic(const Parameters& of) : earth(of) {
    const double origin = of.latitude("latitude_of_projection_origin");
    if (std::abs(std::abs(origin) - pi / 2) > 1e-9)
      of.fail("its latitude_of_projection_origin is {}; give 90 or -90", origin / degree);
    sign = origin > 0 ? 1 : -1;
    meridian = (of.find("straight_vertical_longitude_from_pole")
                    ? of.require("straight_vertical_longitude_from_pole")
                    : of.require("longitude_of_projection_origin")) *
               degree;
    const double e = earth.eccentricity();
    const double at_pole = 2 / std::sqrt(std::pow(1 + e, 1 + e) * std::pow(1 - e, 1 - e));
    // Some files of the south give it without its sign; PROJ takes both for the same.
    const double parallel =
        of.find("standard_parallel") ? std::abs(of.latitude("standard_parallel")) : pi / 2;
    scale = parallel > pi / 2 - 1e-9
                ? at_pole * of.find("scale_factor_at_projection_origin").value_or(1)
                : earth.m(parallel) / earth.t(parallel);
    if (!(scale > 0))
      of.fail("its standard_parallel or its scale factor is out of range; correct it");
  }
  LonLat lonlat(double x, double y) const override {
    const double t = std::hypot(x, y) / (earth.radius * scale);
    return in_degrees(meridian + std::atan2(x, -sign * y), sign * earth.latitude_of_t(t));
  }

  Ellipsoid earth;
  double sign, meridian, scale;
};

/// Eqs. 14-9 to 14-11, 15-1 to 15-11.
struct LambertConformal : Projection::Inverse {
  explicit LambertConformal(const Parameters& of) : earth(of) {
    meridian = of.require("longitude_of_central_meridian") * degree;
    const double first = of.latitude("standard_parallel"),
                 second = of.find("standard_parallel", 1).value_or(first / degree) * degree;
    if (std::abs(first) > pi / 2 - 1e-9 || std::abs(second) > pi / 2 - 1e-9 ||
        std::abs(first + second) < 1e-9)
      of.fail("its standard_parallel is that of no cone; give one or two on the same hemisphere");
    n = first == second ? std::sin(first)
                        : std::log(earth.m(first) / earth.m(second)) /
                              std::log(earth.t(first) / earth.t(second));
    scale = earth.radius * earth.m(first) / (n * std::pow(earth.t(first), n));
    origin = scale * std::pow(earth.t(of.latitude("latitude_of_projection_origin")), n);
  }
  LonLat lonlat(double x, double y) const override {
    const double sign = n > 0 ? 1 : -1, rho = sign * std::hypot(x, origin - y),
                 theta = std::atan2(sign * x, sign * (origin - y));
    if (std::abs(theta) > std::abs(n) * pi) // in the gap between the sides of the cone
      return {nan, nan};
    return in_degrees(meridian + theta / n, earth.latitude_of_t(std::pow(rho / scale, 1 / n)));
  }

  Ellipsoid earth;
  double meridian, n, scale, origin;
};

/// Eqs. 24-17 to 24-27.
struct LambertEqualArea : Projection::Inverse {
  explicit LambertEqualArea(const Parameters& of) : earth(of) {
    meridian = of.require("longitude_of_projection_origin") * degree;
    const double latitude = of.latitude("latitude_of_projection_origin");
    of_pole = earth.q(pi / 2);
    pole = std::abs(latitude) < pi / 2 - 1e-9 ? 0 : latitude > 0 ? 1 : -1;
    radius = earth.radius * std::sqrt(of_pole / 2);
    const double beta = std::asin(earth.q(latitude) / of_pole);
    sine = std::sin(beta), cosine = std::cos(beta);
    stretch = pole == 0 ? earth.radius * earth.m(latitude) / (radius * cosine) : 1;
  }
  LonLat lonlat(double x, double y) const override {
    const double rho = std::hypot(x / stretch, stretch * y);
    if (rho > 2 * radius)
      return {nan, nan};
    if (pole != 0) {
      const double part = rho / earth.radius;
      return in_degrees(meridian + std::atan2(x, -pole * y),
                        earth.latitude_of_q(pole * (of_pole - part * part)));
    }
    if (rho == 0)
      return in_degrees(meridian, earth.latitude_of_q(of_pole * sine));
    const double angle = 2 * std::asin(rho / (2 * radius)), s = std::sin(angle),
                 c = std::cos(angle);
    const double q = of_pole * (c * sine + stretch * y * s * cosine / rho);
    return in_degrees(
        meridian + std::atan2(x * s, stretch * rho * cosine * c - stretch * stretch * y * sine * s),
        earth.latitude_of_q(q));
  }

  Ellipsoid earth;
  int pole;
  double meridian, of_pole, radius, sine, cosine, stretch;
};

/// Degrees of a sphere with another pole.
struct RotatedPole : Projection::Inverse {
  explicit RotatedPole(const Parameters& of)
      : latitude(of.latitude("grid_north_pole_latitude")),
        longitude(of.require("grid_north_pole_longitude") * degree),
        offset(of.find("north_pole_grid_longitude").value_or(0) * degree) {}
  LonLat lonlat(double x, double y) const override {
    if (!(std::abs(y) <= 90))
      return {nan, nan};
    const double lon = x * degree - offset, lat = y * degree;
    const double a = std::cos(lat) * std::cos(lon), b = std::cos(lat) * std::sin(lon),
                 c = std::sin(lat);
    const double s = std::sin(latitude), k = std::cos(latitude);
    // The new pole in the plane of the meridian of 0; then it is turned to its longitude.
    const double u = -(s * a - k * c), v = -b, w = k * a + s * c;
    return in_degrees(longitude + std::atan2(v, u), std::atan2(w, std::hypot(u, v)));
  }

  double latitude, longitude, offset;
};

/// A projection with a false easting and northing.
struct Shifted : Projection::Inverse {
  Shifted(std::shared_ptr<const Inverse> inner, double x, double y)
      : of(std::move(inner)), east(x), north(y) {}
  LonLat lonlat(double x, double y) const override { return of->lonlat(x - east, y - north); }

  std::shared_ptr<const Inverse> of;
  double east, north;
};

struct Mapping {
  const char* name;
  std::shared_ptr<const Projection::Inverse> (*make)(const Parameters&);
};

template <class Of> std::shared_ptr<const Projection::Inverse> make(const Parameters& of) {
  return std::make_shared<Of>(of);
}

constexpr const char* rotated_pole = "rotated_latitude_longitude";
constexpr std::array<Mapping, 4> mappings{{{"polar_stereographic", make<PolarStereographic>},
                                           {"lambert_conformal_conic", make<LambertConformal>},
                                           {"lambert_azimuthal_equal_area", make<LambertEqualArea>},
                                           {rotated_pole, make<RotatedPole>}}};

const Mapping* find_mapping(const std::string& name) {
  const auto* const found =
      std::ranges::find_if(mappings, [&](const Mapping& mapping) { return mapping.name == name; });
  return found == mappings.end() ? nullptr : found;
}

} // namespace

bool Projection::reads(const std::string& name) { return find_mapping(name) != nullptr; }

Projection::Projection(const NetcdfReader& file, const std::string& mapping, double metres) {
  const std::string name = file.text(mapping, "grid_mapping_name");
  const Parameters of(file, mapping);
  of_degrees_ = name == rotated_pole;
  const Mapping* const found = find_mapping(name);
  if (found == nullptr)
    file.fail("the grid mapping {} is {}; polar_stereographic, lambert_conformal_conic, "
              "lambert_azimuthal_equal_area and rotated_latitude_longitude are read; convert the "
              "file with GDAL: gdalwarp -t_srs EPSG:4326 -of netCDF",
              mapping, in_quotes(name));
  inverse_ = found->make(of);
  const double east = metres * of.find("false_easting").value_or(0),
               north = metres * of.find("false_northing").value_or(0);
  if (east != 0 || north != 0)
    inverse_ = std::make_shared<Shifted>(inverse_, east, north);
}

} // namespace calotte::io_detail
