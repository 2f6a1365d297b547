// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/progress.h>

#include <pybind11/pybind11.h>

namespace calotte::python {

/// Calls a function, if it is not None, with a dict after each accepted iteration. ^C ends the run.
/// \param end what follows where the function returns True.
ProgressCallback callback_of(pybind11::object function, ProgressReply end);

} // namespace calotte::python
