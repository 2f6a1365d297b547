// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "run/cvt_start.h"

#include <calotte/error.h>

namespace calotte::tools {

/// Reads the points of START.
/// \throws Error bad_option, parse, file.
CvtStart read_start(const CvtRequest& request);

/// Reads the fixed points, if there are any, and puts them before those of START.
/// \throws Error as above.
void add_fixed(const CvtRequest& request, CvtStart& start);

/// The columns of both.
template <class Points> Points joined(const Points& first, const Points& then) {
  Points all(first.rows(), first.cols() + then.cols());
  all.leftCols(first.cols()) = first;
  all.rightCols(then.cols()) = then;
  return all;
}

/// \throws Error bad_option if the fixed points leave no free one of the request's cells.
void require_free(const CvtRequest& request, const CvtStart& start);

/// Replaces the column of a bad point of the start in an error by the line in its file.
[[noreturn]] void rethrow_with_line(const Error& error, const CvtStart& start);

} // namespace calotte::tools
