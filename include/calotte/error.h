// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>

#include <cstdint>
#include <stdexcept>
#include <string>

CALOTTE_API_BEGIN
namespace calotte {

enum class ErrorCode {
  not_finite,    ///< a coordinate is NaN or infinite
  zero_vector,   ///< a point at the origin has no direction
  duplicate,     ///< equal directions or places, and the options do not allow them
  too_few_sites, ///< fewer than 4 distinct sites, in the plane 3; too few for a periodic box
  degenerate,    ///< all sites on one great circle or line
  bad_option,    ///< an option outside its range
  parse,         ///< a file violates its format
  file,          ///< a file cannot be opened, read or written
  cancelled,     ///< the caller's progress callback ended the run
  internal,      ///< a bug of this library; please report it
};

/// The one exception this library throws. `what()` is one line that names the offending index (or
/// line of a file) and the remedy; `index()` is that 0-based index or 1-based line, -1 where none
/// is.
class Error : public std::runtime_error {
public:
  Error(ErrorCode code, const std::string& message, std::int64_t index = -1)
      : std::runtime_error(message), code_(code), index_(index) {}
  ErrorCode code() const noexcept { return code_; }
  std::int64_t index() const noexcept { return index_; }

private:
  ErrorCode code_;
  std::int64_t index_;
};

} // namespace calotte
CALOTTE_API_END
