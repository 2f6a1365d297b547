// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/generators.h>

#include <cstdint>

namespace calotte::python {
namespace {

/// Points of a function of the library as an array of Python.
template <class Make> py::array made(Make make) { return handed_over(call(make)); }

} // namespace

void add_points(py::module_& module) {
  module.def("random_points", [](std::int64_t n, const Surface& surface, const Density& density,
                                 std::uint64_t seed) {
    return handed_over_on(surface, call([&] { return random_points(n, surface, density, seed); }));
  });
  module.def("geodesic_sphere",
             [](std::int64_t n) { return made([&] { return geodesic_sphere(n); }); });
  module.def("fibonacci_sphere",
             [](std::int64_t n) { return made([&] { return fibonacci_sphere(n); }); });
  module.def("spiral_sphere",
             [](std::int64_t n) { return made([&] { return spiral_sphere(n); }); });
  module.def("bisected_icosahedron",
             [](int level) { return made([&] { return bisected_icosahedron(level); }); });
  module.def("lat_lon_sphere", [](std::int64_t latitudes, std::int64_t longitudes, bool poles) {
    return made([&] { return lat_lon_sphere(latitudes, longitudes, poles); });
  });
  module.def("cubed_sphere", [](std::int64_t m) { return made([&] { return cubed_sphere(m); }); });
  module.def("hexagonal_lattice", [](std::int64_t n, const Surface& surface) {
    return handed_over_on(surface, call([&] { return hexagonal_lattice(n, surface); }));
  });
  module.def("from_lonlat", [](const Doubles& lonlat) {
    const auto places = columns(lonlat);
    return made([&] { return from_lonlat(places); });
  });
  module.def("to_lonlat", [](const Doubles& points) {
    const auto places = columns(points);
    return made([&] { return to_lonlat(places); });
  });
}

} // namespace calotte::python
