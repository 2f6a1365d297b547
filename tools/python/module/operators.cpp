// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/operators.h>

#include <memory>

namespace calotte::python {
namespace {

using Errors = py::class_<OperatorErrors, std::shared_ptr<OperatorErrors>>;

void add_norms(py::module_& module) {
  py::class_<ErrorNorms>(module, "ErrorNorms")
      .def_readonly("l2", &ErrorNorms::l2)
      .def_readonly("max", &ErrorNorms::max)
      .def_readonly("cell", &ErrorNorms::cell)
      .def_property_readonly(
          "place", [](py::object self) { return view(self.cast<const ErrorNorms&>().place, self); })
      .def("__repr__", [](const ErrorNorms& norms) {
        return py::str("ErrorNorms(l2={}, max={}, cell={})")
            .format(norms.l2, norms.max, norms.cell);
      });
}

/// The norms of an operator, and its errors by cell.
void add_operator(Errors& errors, const char* name, const char* by_cell,
                  ErrorNorms OperatorErrors::*norms,
                  Eigen::VectorXd OperatorErrorsByCell::*values) {
  errors.def_readonly(name, norms);
  errors.def_property_readonly(by_cell, [values](py::object self) {
    return view(self.cast<const OperatorErrors&>().by_cell.*values, self);
  });
}

template <class... Arguments>
std::shared_ptr<OperatorErrors> errors_of(const Arguments&... arguments) {
  return call([&] { return std::make_shared<OperatorErrors>(operator_errors(arguments...)); });
}

} // namespace

void add_operators(py::module_& module) {
  add_norms(module);
  Errors errors(module, "OperatorErrors");
  add_operator(errors, "divergence", "divergence_by_cell", &OperatorErrors::divergence,
               &OperatorErrorsByCell::divergence);
  add_operator(errors, "gradient", "gradient_by_cell", &OperatorErrors::gradient,
               &OperatorErrorsByCell::gradient);
  add_operator(errors, "laplacian", "laplacian_by_cell", &OperatorErrors::laplacian,
               &OperatorErrorsByCell::laplacian);
  add_operator(errors, "curl", "curl_by_cell", &OperatorErrors::curl, &OperatorErrorsByCell::curl);
  add_operator(errors, "tangential", "tangential_by_cell", &OperatorErrors::tangential,
               &OperatorErrorsByCell::tangential);
  add_operator(errors, "kinetic_energy", "kinetic_energy_by_cell", &OperatorErrors::kinetic_energy,
               &OperatorErrorsByCell::kinetic_energy);
  errors.def_readonly("off_centroid", &OperatorErrors::off_centroid)
      .def_readonly("off_midpoint", &OperatorErrors::off_midpoint)
      .def_readonly("primal_eigenvalue", &OperatorErrors::primal_eigenvalue)
      .def_readonly("dual_eigenvalue", &OperatorErrors::dual_eigenvalue);
  module.def("operator_errors", &errors_of<Mesh, Density>);
  module.def("operator_errors", &errors_of<PlanarMesh, PlanarDomain, Density>);
}

} // namespace calotte::python
