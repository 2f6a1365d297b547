// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "members.h"
#include "module.h"

#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/read.h>
#include <calotte/widths.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

/// One that asks a function of Python for blocks of points.
Density callable(py::object function) {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [f = Callable(std::move(function))](const Eigen::Ref<const Points3>& x,
                                                         Eigen::Ref<Eigen::VectorXd> rho) {
    const py::gil_scoped_acquire locked;
    const Doubles values(f(handed_over(Points3(x))));
    if (values.ndim() != 1 || values.shape(0) != x.cols())
      throw Error(ErrorCode::invalid_argument,
                  "the density function must return one number for each of its points");
    rho = Eigen::Map<const Eigen::VectorXd>(values.data(), values.shape(0));
  };
  return density;
}

using BumpWords = std::tuple<Eigen::Vector3d, double, double, double, double, Eigen::Vector3d>;

Density bumps(const std::vector<BumpWords>& words, bool sum) {
  Density density;
  density.kind = sum ? Density::Kind::sum : Density::Kind::maximum;
  for (const auto& [centre, beta, alpha, gamma, stretch, major] : words)
    density.bumps.push_back({.centre = centre,
                             .beta = beta,
                             .alpha = alpha,
                             .gamma = gamma,
                             .stretch = stretch,
                             .major = major});
  return density;
}

Raster cell_width(const Doubles& values, const Doubles& x, const Doubles& y, bool of_plane) {
  return {Eigen::Map<const Eigen::VectorXd>(x.data(), x.size()),
          Eigen::Map<const Eigen::VectorXd>(y.data(), y.size()), columns(values), of_plane};
}

void add_cell_width(py::module_& module) {
  py::class_<Raster> widths(module, "CellWidth", "Cell widths at the nodes of a raster.");
  widths.def(py::init(&cell_width), py::arg("widths"), py::arg("x"), py::arg("y"),
             py::arg("of_plane") = false);
  add_members(widths,
              Member{"widths", &Raster::values,
                     "(latitudes, longitudes) or (y, x) distances between "
                     "centres of neighbouring cells, km, in a plane in its unit."},
              Member{"longitudes", &Raster::x, "Degrees, ascending."},
              Member{"latitudes", &Raster::y, "Degrees, ascending."},
              Member{"x", &Raster::x, "Those of a plane; the longitudes of the sphere."},
              Member{"y", &Raster::y, "Those of a plane; the latitudes of the sphere."});
  widths.def_readonly("of_plane", &Raster::of_plane, "True for a raster of a plane.");
  widths.def(
      "at",
      [](const Raster& widths, const Doubles& points) {
        const auto sites = columns(points);
        return handed_over(call([&] { return evaluate(widths, sites); }));
      },
      "(n,) the widths at n x 3 directions, of a plane at n x 2 places.");
  module.def(
      "measure_of", [](const std::string& text) -> std::optional<std::pair<double, std::string>> {
        const std::optional<Measure> measure = measure_of(text);
        return measure ? std::optional(std::pair(measure->value, measure->unit)) : std::nullopt;
      });
  module.def("seconds_in", &seconds_in);
  module.def("kilometres_in", &kilometres_in);
  module.attr("steepest_width") = steepest_width;
  module.def("is_too_steep", &is_too_steep);
  py::class_<WidthField>(module, "WidthField", "Cell widths that a run follows.")
      .def(py::init<const Raster&>())
      .def_property_readonly("least", &WidthField::least, "The least width of the nodes.")
      .def_property_readonly("greatest", &WidthField::greatest, "The largest.")
      .def_property_readonly("of_plane", &WidthField::of_plane, "True for those of a plane.");
  py::implicitly_convertible<Raster, WidthField>();
  module.def("largest_gradient", [](const WidthField& widths, double radius_km) {
    const WidthGradient gradient = call([&] { return largest_gradient(widths, radius_km); });
    return std::tuple(gradient.slope, gradient.longitude, gradient.latitude);
  });
}

} // namespace

void add_densities(py::module_& module) {
  py::class_<Density>(module, "Density",
                      "A density of cells; their widths are proportional to its power -1/4.")
      .def(py::init<>())
      .def_property_readonly("uniform", &Density::uniform, "True if all cells are as wide.")
      .def(
          "at",
          [](const Density& density, const Doubles& points) {
            const auto sites = columns(points);
            return handed_over(call([&] { return evaluate(density, sites); }));
          },
          "(n,) the density at n x 3 directions.");
  module.def("density_of_function", &callable);
  module.def("density_of_bumps", &bumps);
  add_cell_width(module);
  module.def("density_of_widths",
             [](const WidthField& widths) { return call([&] { return density_of(widths); }); });
}

} // namespace calotte::python
