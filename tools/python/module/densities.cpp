// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "members.h"
#include "module.h"

#include <calotte/cell_width.h>
#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/planar_raster.h>
#include <calotte/read.h>

#include <string>
#include <tuple>
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

CellWidth cell_width(const Doubles& values, const Doubles& longitudes, const Doubles& latitudes) {
  CellWidth widths;
  widths.longitudes = Eigen::Map<const Eigen::VectorXd>(longitudes.data(), longitudes.size());
  widths.latitudes = Eigen::Map<const Eigen::VectorXd>(latitudes.data(), latitudes.size());
  widths.widths = columns(values);
  return widths;
}

PlanarCellWidth planar_widths(const Doubles& values, const Doubles& x, const Doubles& y) {
  PlanarCellWidth widths;
  widths.x = Eigen::Map<const Eigen::VectorXd>(x.data(), x.size());
  widths.y = Eigen::Map<const Eigen::VectorXd>(y.data(), y.size());
  widths.widths = columns(values);
  return widths;
}

CellWidth read_widths(const std::string& path, double inside, double outside, double transition,
                      double radius_km, const Surface& region) {
  return call([&] {
    return read_cell_width(path, {inside, outside, transition, radius_km}, region);
  });
}

void add_cell_width(py::module_& module) {
  py::class_<CellWidth> widths(module, "CellWidth",
                               "Cell widths at the nodes of longitudes and latitudes.");
  widths.def(py::init(&cell_width));
  add_members(widths,
              Member{"widths", &CellWidth::widths,
                     "(latitudes, longitudes) distances between "
                     "centres of neighbouring cells, km."},
              Member{"longitudes", &CellWidth::longitudes, "Degrees, ascending."},
              Member{"latitudes", &CellWidth::latitudes, "Degrees, ascending."});
  widths.def(
      "at",
      [](const CellWidth& widths, const Doubles& points) {
        const auto sites = columns(points);
        return handed_over(call([&] { return evaluate(widths, sites); }));
      },
      "(n,) the widths at n x 3 directions, km.");
  module.def("read_cell_width", &read_widths);
  module.def("require_covering", [](const CellWidth& widths, const Surface& region) {
    call([&] { require_covering(widths, region); });
  });
  module.def("kilometres_in", &kilometres_in);
  module.def("implied_cells",
             [](const CellWidth& widths, const Surface& surface, double radius_km) {
               return call([&] { return implied_cells(widths, surface, radius_km); });
             });
  module.attr("steepest_width") = steepest_width;
  module.def("is_too_steep", &is_too_steep);
  module.def("largest_gradient", [](const CellWidth& widths, double radius_km) {
    const Gradient gradient = call([&] { return largest_gradient(widths, radius_km); });
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
             [](const CellWidth& widths) { return call([&] { return density_of(widths); }); });
  py::class_<PlanarCellWidth>(module, "PlanarCellWidth")
      .def(py::init(&planar_widths))
      .def_property_readonly(
          "widths",
          [](py::object self) { return view(self.cast<const PlanarCellWidth&>().widths, self); })
      .def_property_readonly(
          "x", [](py::object self) { return view(self.cast<const PlanarCellWidth&>().x, self); })
      .def_property_readonly(
          "y", [](py::object self) { return view(self.cast<const PlanarCellWidth&>().y, self); })
      .def("density", [](const PlanarCellWidth& widths) { return density_of(widths); });
  module.def("read_planar_cell_width", &read_planar_cell_width);
}

} // namespace calotte::python
