// SPDX-License-Identifier: GPL-3.0-or-later
#include "module.h"

#include <calotte/error.h>

#include <exception>
#include <string>

namespace calotte::python {
namespace {

namespace py = pybind11;

std::string name_of(ErrorCode code) {
  switch (code) {
  case ErrorCode::not_finite:
    return "not_finite";
  case ErrorCode::zero_vector:
    return "zero_vector";
  case ErrorCode::duplicate:
    return "duplicate";
  case ErrorCode::too_few_sites:
    return "too_few_sites";
  case ErrorCode::degenerate:
    return "degenerate";
  case ErrorCode::invalid_argument:
    return "invalid_argument";
  case ErrorCode::parse:
    return "parse";
  case ErrorCode::file:
    return "file";
  case ErrorCode::cancelled:
    return "cancelled";
  case ErrorCode::internal:
    return "internal";
  }
  return "internal";
}

PyObject* error_type = nullptr; // lives as long as the interpreter

void set_error(const Error& error) {
  py::object instance = py::handle(error_type)(error.what());
  instance.attr("code") = name_of(error.code());
  if (error.index() >= 0)
    instance.attr("index") = error.index();
  PyErr_SetObject(error_type, instance.ptr());
}

} // namespace

void add_errors(py::module_& module) {
  error_type = PyErr_NewExceptionWithDoc(
      "calotte.Error",
      "Input that calotte refuses, in one line that names the remedy.\n\n"
      "code: why, one of not_finite, zero_vector, duplicate, too_few_sites, degenerate,\n"
      "invalid_argument, parse, file, cancelled, internal.\n"
      "index: the 0-based index, or the 1-based line of a file, or None.",
      PyExc_ValueError, nullptr);
  if (error_type == nullptr)
    throw py::error_already_set();
  const py::object type = py::reinterpret_borrow<py::object>(error_type);
  type.attr("code") = "invalid_argument";
  type.attr("index") = py::none();
  module.attr("Error") = type;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown)
        std::rethrow_exception(thrown);
    } catch (const Error& error) {
      set_error(error);
    }
  });
}

} // namespace calotte::python
