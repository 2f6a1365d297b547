// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>

#include <cstdint>
#include <stdexcept>
#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// Why a call failed.
enum class ErrorCode {
  not_finite,  ///< a coordinate is NaN or infinite
  zero_vector, ///< a point at the origin has no direction
  duplicate,   ///< equal directions or positions, which Duplicates::refuse does not allow
  /// Fewer than 3 distinct sites, or 12 generators of a CVT of the whole sphere; sites that leave
  /// an empty circle wider than half of a periodic box.
  too_few_sites,
  degenerate,       ///< all sites on one great circle or line
  invalid_argument, ///< an argument or option of the wrong shape or out of its range
  parse,            ///< a file violates its format
  file,             ///< a file cannot be opened, read or written
  cancelled,        ///< the caller's progress callback ended the run
  internal,         ///< a bug of this library; please report it
};

/// The one exception this library throws. `what()` is one line that names the offending index (or
/// line of a file) and the remedy. `index()` is that 0-based index or 1-based line; -1 (the
/// default) if the error has none.
class Error : public std::runtime_error {
public:
  /// \param message one line.
  Error(ErrorCode code, const std::string& message, std::int64_t index = -1)
      : std::runtime_error(message), code_(code), index_(index) {}
  ErrorCode code() const noexcept { return code_; }      ///< the kind of the error
  std::int64_t index() const noexcept { return index_; } ///< the offender; -1 for none

private:
  ErrorCode code_;
  std::int64_t index_;
};

} // namespace calotte
CALOTTE_API_END
