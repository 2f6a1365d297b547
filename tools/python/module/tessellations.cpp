// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/cvt.h>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>

namespace calotte::python {
namespace {

/// An accepted iteration, as a function of Python receives it.
py::dict progress_of(const CvtProgress& now) {
  const CvtIteration& last = now.report.iterations.back();
  py::dict values;
  values["iterations"] = now.report.iterations.size();
  values["cells"] = last.cells;
  values["residual"] = now.report.residual;
  values["energy"] = last.energy;
  values["bisections_left"] = now.bisections_left;
  values["rounds_left"] = now.rounds_left;
  values["seconds"] = now.report.seconds;
  return values;
}

/// Ends the run after ^C, or where the function returns True.
CvtCallback callback_of(py::object function) {
  return [f = Callable(std::move(function))](const CvtProgress& now) {
    const py::gil_scoped_acquire locked;
    check_interrupt();
    return !f.none() && f(progress_of(now)).template cast<py::object>().is(py::bool_(true));
  };
}

py::dict report_of(const CvtReport& report) {
  py::dict values;
  values["converged"] = report.converged;
  values["well_centred"] = report.well_centred;
  values["misshapen_cells"] = report.misshapen_cells;
  values["worst_cell"] = report.worst_cell;
  values["residual"] = report.residual;
  values["iterations"] = report.iterations.size();
  values["energy"] = report.iterations.empty() ? 0 : report.iterations.back().energy;
  values["seconds"] = report.seconds;
  DoubleVector energies(std::ssize(report.iterations)), norms(std::ssize(report.iterations));
  Eigen::Index k = 0;
  for (const CvtIteration& iteration : report.iterations) {
    energies[k] = iteration.energy;
    norms[k++] = norm_of(iteration, Norm::l2_scaled);
  }
  values["energies"] = handed_over(std::move(energies));
  values["norms"] = handed_over(std::move(norms));
  return values;
}

template <class Result> auto unpacked(Result&& result) {
  using AnyMesh = decltype(result.mesh);
  return std::tuple(std::make_shared<AnyMesh>(std::move(result.mesh)), report_of(result.report));
}

auto cvt(const Doubles& start, const Region& region, const CvtOptions& options,
         py::object function) {
  const auto sites = columns(start);
  const CvtCallback callback = callback_of(std::move(function));
  return unpacked(call([&] { return spherical_cvt(sites, region, options, callback); }));
}

auto cvt_in_plane(const Doubles& start, const PlanarDomain& domain, const CvtOptions& options,
                  py::object function) {
  const auto sites = columns(start);
  const CvtCallback callback = callback_of(std::move(function));
  return unpacked(call([&] { return planar_cvt(sites, domain, options, callback); }));
}

template <class Start> auto start_of(Start&& from) {
  return std::tuple(handed_over(std::move(from.start)), from.bisections);
}

void add_options(py::module_& module) {
  py::enum_<Norm>(module, "Norm")
      .value("l2", Norm::l2)
      .value("linf", Norm::linf)
      .value("l2_scaled", Norm::l2_scaled)
      .value("linf_scaled", Norm::linf_scaled)
      .value("gradient", Norm::gradient)
      .value("none", Norm::none);
  py::enum_<Method>(module, "Method")
      .value("automatic", Method::automatic)
      .value("lloyd", Method::lloyd)
      .value("nesterov", Method::nesterov)
      .value("lbfgs", Method::lbfgs)
      .value("lbfgs_laplacian", Method::lbfgs_laplacian);
  py::class_<CvtOptions>(module, "CvtOptions")
      .def(py::init<>())
      .def_readwrite("density", &CvtOptions::density)
      .def_readwrite("method", &CvtOptions::method)
      .def_readwrite("norm", &CvtOptions::norm)
      .def_readwrite("tolerance", &CvtOptions::tolerance)
      .def_readwrite("max_iterations", &CvtOptions::max_iterations)
      .def_readwrite("bisections", &CvtOptions::bisections)
      .def_readwrite("insertion_rounds", &CvtOptions::insertion_rounds)
      .def_readwrite("cells", &CvtOptions::cells)
      .def_readwrite("fixed", &CvtOptions::fixed)
      .def_readwrite("well_centred", &CvtOptions::well_centred)
      .def_readwrite("least_spacing", &CvtOptions::least_spacing)
      .def_property(
          "regions", [](const CvtOptions& options) { return options.partition.regions; },
          [](CvtOptions& options, std::optional<int> regions) {
            options.partition.regions = regions;
          });
}

} // namespace

void add_tessellations(py::module_& module) {
  add_options(module);
  module.attr("tolerance_before_finish") = tolerance_before_finish;
  module.attr("usual_insertion_rounds") = usual_insertion_rounds;
  module.attr("insertion_rounds_beside_fixed") = insertion_rounds_beside_fixed;
  module.def("continuation", [](std::int64_t cells, const Density& density, std::uint64_t seed) {
    return start_of(call([&] { return continuation(cells, density, seed); }));
  });
  module.def("multilevel", [](std::int64_t cells, const Region& region, const Density& density,
                              std::uint64_t seed, const Doubles& fixed) {
    const Points3 stay = columns(fixed);
    return start_of(call([&] { return multilevel(cells, region, density, seed, stay); }));
  });
  module.def("multilevel_in_plane", [](std::int64_t cells, const PlanarDomain& domain,
                                       const Density& density, std::uint64_t seed,
                                       const Doubles& fixed) {
    const Points2 stay = columns(fixed);
    return start_of(call([&] { return multilevel(cells, domain, density, seed, stay); }));
  });
  module.def("cells_beside", [](const Doubles& fixed, std::int64_t cells, const Density& density,
                                const Region& region) {
    const Points3 stay = columns(fixed);
    return call([&] { return cells_beside(stay, cells, density, region); });
  });
  module.def("cvt", &cvt);
  module.def("cvt_in_plane", &cvt_in_plane);
}

} // namespace calotte::python
