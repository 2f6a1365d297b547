// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "members.h"
#include "module.h"

#include <calotte/error.h>
#include <calotte/quality.h>
#include <calotte/write.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace calotte::python {
namespace {

using Errors = py::class_<OperatorErrors, std::shared_ptr<OperatorErrors>>;

void add_norms(py::module_& module) {
  py::class_<ErrorNorms> norms(module, "ErrorNorms",
                               "Norms of an operator's error over the root mean square of the "
                               "exact values.");
  add_members(norms, Member{"l2", &ErrorNorms::l2, "Root mean square."},
              Member{"max", &ErrorNorms::max, "The greatest value."},
              Member{"cell", &ErrorNorms::cell, "A cell at the greatest value."},
              Member{"position", &ErrorNorms::position,
                     "(3,) of the greatest value, a unit vector; in the plane z is 0."});
}

/// The norms of an operator, and its errors by cell.
void add_operator(Errors& errors, const char* name, const char* by_cell,
                  ErrorNorms OperatorErrors::*norms, DoubleVector OperatorErrorsByCell::*values,
                  const char* doc) {
  errors.def_readonly(name, norms, doc);
  errors.def_property_readonly(
      by_cell,
      [values](py::object self) {
        return view(self.cast<const OperatorErrors&>().by_cell.*values, self);
      },
      "(n,) the same error of each cell; NaN at a boundary.");
}

std::shared_ptr<OperatorErrors> errors_of(const Mesh& mesh, const Density& density) {
  return call([&] { return std::make_shared<OperatorErrors>(operator_errors(mesh, density)); });
}

constexpr std::array norms_of{&OperatorErrors::divergence,   &OperatorErrors::gradient,
                              &OperatorErrors::laplacian,    &OperatorErrors::curl,
                              &OperatorErrors::tangential,   &OperatorErrors::kinetic_energy,
                              &OperatorErrors::off_centroid, &OperatorErrors::off_midpoint};
constexpr std::array values_of{
    &OperatorErrorsByCell::divergence, &OperatorErrorsByCell::gradient,
    &OperatorErrorsByCell::laplacian,  &OperatorErrorsByCell::curl,
    &OperatorErrorsByCell::tangential, &OperatorErrorsByCell::kinetic_energy};

py::tuple state_of_errors(const OperatorErrors& errors) {
  py::list norms, values;
  for (const auto pointer : norms_of)
    norms.append(errors.*pointer);
  for (const auto pointer : values_of)
    values.append(py::cast(errors.by_cell.*pointer));
  return py::make_tuple(norms, values, errors.primal_eigenvalue, errors.dual_eigenvalue);
}

std::shared_ptr<OperatorErrors> errors_of_state(const py::tuple& state) {
  auto errors = std::make_shared<OperatorErrors>();
  const py::list norms = state[0], values = state[1];
  for (std::size_t k = 0; k < norms_of.size(); ++k)
    (*errors).*norms_of[k] = norms[k].cast<ErrorNorms>();
  for (std::size_t k = 0; k < values_of.size(); ++k)
    errors->by_cell.*values_of[k] = values[k].cast<Eigen::VectorXd>();
  errors->primal_eigenvalue = state[2].cast<double>();
  errors->dual_eigenvalue = state[3].cast<double>();
  return errors;
}

/// \param mask empty for none.
py::list gates_of(const Voronoi& cells, const std::string& word, std::optional<double> radius,
                  const Ids& mask) {
  const ModelNeeds* model = find_model(word);
  if (model == nullptr || model->demands.least_sides == 0)
    throw Error(ErrorCode::invalid_argument,
                "model is \"" + word +
                    "\"; give one with demands: mpas-atmosphere, mpas-ocean or mpas-sw");
  py::list list;
  for (const Gate& gate : call([&] { return gates(cells, *model, radius, mask); }))
    list.append(
        py::make_tuple(gate.name, gate.value, gate.limit, gate.at_least, gate.beyond, gate.cell));
  return list;
}

} // namespace

void add_operators(py::module_& module) {
  add_norms(module);
  Errors errors(module, "OperatorErrors",
                "Errors of the operators of a C-grid model (TRiSK), of operator_errors(). All are\n"
                "relative, without unit.");
  add_operator(errors, "divergence", "divergence_by_cell", &OperatorErrors::divergence,
               &OperatorErrorsByCell::divergence, "Of a velocity, at cells.");
  add_operator(errors, "gradient", "gradient_by_cell", &OperatorErrors::gradient,
               &OperatorErrorsByCell::gradient, "Of a scalar, at edges.");
  add_operator(errors, "laplacian", "laplacian_by_cell", &OperatorErrors::laplacian,
               &OperatorErrorsByCell::laplacian, "Divergence of the gradient, at cells.");
  add_operator(errors, "curl", "curl_by_cell", &OperatorErrors::curl, &OperatorErrorsByCell::curl,
               "Of a velocity, at vertices.");
  add_operator(errors, "tangential", "tangential_by_cell", &OperatorErrors::tangential,
               &OperatorErrorsByCell::tangential, "Velocity along an edge, at edges.");
  add_operator(errors, "kinetic_energy", "kinetic_energy_by_cell", &OperatorErrors::kinetic_energy,
               &OperatorErrorsByCell::kinetic_energy, "Of a velocity, at cells.");
  errors
      .def_readonly("off_centroid", &OperatorErrors::off_centroid,
                    "Distance of a site from its cell's centroid over that to its neighbours.")
      .def_readonly("off_midpoint", &OperatorErrors::off_midpoint,
                    "Distance between the midpoints of an edge's two arcs over their length dc.")
      .def_readonly("primal_eigenvalue", &OperatorErrors::primal_eigenvalue,
                    "Largest eigenvalue of the negative Laplacian at cells; 1 over the square of "
                    "radians, in the plane of the points' unit.")
      .def_readonly("dual_eigenvalue", &OperatorErrors::dual_eigenvalue, "The same at vertices.")
      .def(py::pickle(&state_of_errors, &errors_of_state));
  module.def("operator_errors", &errors_of);
  module.def("gates", &gates_of);
}

} // namespace calotte::python
