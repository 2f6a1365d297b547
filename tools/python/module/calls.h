// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <tbb/task_arena.h>

#include <memory>
#include <utility>

namespace calotte::python {

namespace py = pybind11;

/// The number of threads of this Python thread's calls; 0 for all cores.
int& threads();

/// Does work of the library without the interpreter's lock.
template <class Work> auto call(Work work) {
  const int n = threads();
  const py::gil_scoped_release unlocked;
  return n == 0 ? work() : tbb::task_arena(n).execute(work);
}

/// Ends a run after ^C. \pre the interpreter's lock is held.
inline void check_interrupt() {
  if (PyErr_CheckSignals() != 0)
    throw py::error_already_set();
}

/// A function of Python that threads of the library may copy and drop without the lock.
class Callable {
public:
  explicit Callable(py::object function)
      : function_(new py::object(std::move(function)), [](py::object* object) {
          const py::gil_scoped_acquire locked;
          delete object;
        }) {}

  bool none() const { return function_->is_none(); }

  /// \pre the interpreter's lock is held.
  template <class... Arguments> py::object operator()(Arguments&&... arguments) const {
    return (*function_)(std::forward<Arguments>(arguments)...);
  }

private:
  std::shared_ptr<py::object> function_;
};

} // namespace calotte::python
