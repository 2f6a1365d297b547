// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "members.h"
#include "module.h"

#include <calotte/ocean.h>
#include <calotte/read.h>
#include <calotte/widths.h>

#include <string>
#include <vector>

namespace calotte::python {
namespace {

/// \param nodes m x 2: the number and the width.
WidthProfile profile(const Doubles& nodes, bool smooth) {
  WidthProfile profile;
  for (py::ssize_t k = 0; k < nodes.shape(0); ++k)
    profile.nodes.push_back({nodes.at(k, 0), nodes.at(k, 1)});
  profile.smooth = smooth;
  return profile;
}

Widths by_latitude(const Doubles& nodes, bool smooth) {
  return call([of = profile(nodes, smooth)] { return Widths::by_latitude(of); });
}

/// \param lines n x 3 each, in a plane n x 2.
Widths by_distance(const std::vector<Doubles>& lines, const Doubles& nodes, bool smooth,
                   const Surface& surface) {
  return call([&, all = lines_of(lines), of = profile(nodes, smooth)] {
    return Widths::by_distance(all, of, surface);
  });
}

Widths by_distance_from_file(const std::string& path, const Doubles& nodes, bool smooth,
                             const Surface& surface) {
  return call([&, of = profile(nodes, smooth)] {
    return Widths::by_distance(read_shapes(path, surface), of, surface);
  });
}

/// \param least_area of the islands and lakes that count, km^2 on the Earth.
Coast coast_in(const std::string& path, double least_area) {
  return without_small(read_coast(path), least_area, earth_radius_km);
}

/// \param side both, sea or land; "" for distances without a sign.
Widths by_distance_from_coast(const std::string& path, const Doubles& nodes, bool smooth,
                              const std::string& side, double least_area) {
  return call([&, of = profile(nodes, smooth)] {
    const Coast coast = coast_in(path, least_area);
    if (side.empty())
      return Widths::by_distance(shores(coast), of);
    return Widths::by_distance(coast, of,
                               side == "sea"    ? CoastSide::sea
                               : side == "land" ? CoastSide::land
                                                : CoastSide::both);
  });
}

/// The library's functions of several widths, by name.
Widths combined(const std::string& name, const std::vector<Widths>& of) {
  return call([&] {
    return name == "minimum"   ? Widths::minimum(of)
           : name == "maximum" ? Widths::maximum(of)
                               : Widths::sum(of);
  });
}

Widths by_depth(const std::string& path, const std::string& variable, const std::string& kind,
                double cells, double period, double least) {
  using Kind = DepthRule::Kind;
  return call([&] {
    return Widths::by_depth(
        read_raster(path, {.variable = variable, .quantity = RasterQuantity::height}),
        {.kind = kind == "wavelength" ? Kind::wavelength
                 : kind == "rossby"   ? Kind::rossby
                                      : Kind::slope,
         .cells = cells,
         .period = period,
         .least = least});
  });
}

Widths by_channel(const std::string& path, double cells, double least, double widest,
                  double least_area) {
  return call([&] {
    return Widths::by_channel(coast_in(path, least_area),
                              {.cells = cells, .least = least, .widest = widest});
  });
}

} // namespace

void add_widths(py::module_& module) {
  py::class_<Widths> widths(module, "Widths", "A rule for the width of cells, for every place.");
  widths.def(py::init([](double width) { return call([&] { return Widths(width); }); }))
      .def(py::init([](const Raster& raster) { return call([&] { return Widths(raster); }); }))
      .def_static("is_demand", py::vectorize(&Widths::is_demand),
                  "(n,) whether widths of at() are ones that a rule gives.")
      .def(
          "on_sphere",
          [](const Widths& widths, double radius) {
            return call([&] { return widths.on_sphere(radius); });
          },
          py::arg("earth_radius"),
          "The same rules on a sphere of another radius, km: distances and gradients are km of it.")
      .def_property_readonly("of_plane", &Widths::is_of_plane,
                             "True for rules of a plane, in its unit.")
      .def(
          "limit_gradient",
          [](const Widths& widths, double gradient, const std::optional<Surface>& surface) {
            return call([&] {
              return surface ? widths.limit_gradient(gradient, *surface)
                             : widths.limit_gradient(gradient);
            });
          },
          py::arg("gradient"), py::arg("surface") = py::none(),
          "The largest widths below these that change by at most so many km per km. surface: a "
          "plane, for rules whose limit depends on the domain; they become a raster.")
      .def(
          "at",
          [](const Widths& widths, const Doubles& points) {
            const auto sites = columns(points);
            return handed_over(call([&] { return evaluate(widths, sites); }));
          },
          "(n,) the widths at n x 3 directions, km; of a plane at n x 2 places, in its unit.")
      .def(
          "sampled",
          [](const Widths& widths, double step, const std::optional<Surface>& surface) {
            return call([&] { return sampled(widths, surface.value_or(Surface()), step); });
          },
          py::arg("step") = 0, py::arg("surface") = py::none(),
          "A CellWidth with nodes so many degrees apart, in a plane of its unit; 0: by its least "
          "width. surface: the sphere (None), a part of it or a plane, where the rules must give a "
          "width everywhere.");
  widths.def("_field", [](const Widths& of, const Surface& surface) {
    return call([&] { return width_field(of, surface); });
  });
  module.def("read_widths", [](const std::string& path, const Surface& surface, double radius_km) {
    return call([&] { return read_widths(path, {.radius_km = radius_km}, surface); });
  });
  module.def("widths_by_latitude", &by_latitude);
  module.def("widths_by_distance", &by_distance);
  module.def("widths_by_distance_from_file", &by_distance_from_file);
  module.def("widths_around", [](const std::vector<Doubles>& lines, double width, double over,
                                 const Surface& surface) {
    return call([&, all = lines_of(lines)] { return Widths::around(all, width, over, surface); });
  });
  module.def("widths_around_file", [](const std::string& path, double width, double over,
                                      const Surface& surface) {
    return call([&] { return Widths::around(read_shapes(path, surface), width, over, surface); });
  });
  module.def("widths_by_distance_from_coast", &by_distance_from_coast);
  module.def("widths_by_depth", &by_depth);
  module.def("widths_by_channel", &by_channel);
  module.def("combined_widths", &combined);
  module.def("widths_times", [](const Widths& widths, double factor) {
    return call([&] { return widths.times(factor); });
  });
  py::class_<WidthShare>(module, "Share",
                         "A share from 0 to 1 for every place, of one of two rules.");
  module.def("share_of_region",
             [](const Surface& region) { return call([&] { return WidthShare(region); }); });
  module.def("share_by_distance", [](const Surface& region, const Doubles& nodes, bool smooth) {
    return call([&, of = profile(nodes, smooth)] { return WidthShare(region, of); });
  });
  module.def("share_by_distance_from_coast",
             [](const std::string& path, const Doubles& nodes, bool smooth, double least_area) {
               return call([&, of = profile(nodes, smooth)] {
                 return WidthShare(coast_in(path, least_area), of);
               });
             });
  module.def("share_of_raster", [](const std::string& path, const std::string& variable) {
    return call([&] {
      return WidthShare(
          read_raster(path, {.variable = variable, .quantity = RasterQuantity::land_fraction}));
    });
  });
  module.def("widths_where",
             [](const WidthShare& share, const Widths& inside, const Widths& outside) {
               return call([&] { return Widths::where(share, inside, outside); });
             });
  module.def("widths_blend", [](const Widths& a, const Widths& b, const WidthShare& share) {
    return call([&] { return Widths::blend(a, b, share); });
  });
}

} // namespace calotte::python
