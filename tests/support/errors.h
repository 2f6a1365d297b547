// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>

#include <doctest/doctest.h>

#include <functional>

namespace calotte::test {

/// The error that `act` throws.
inline Error error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error;
  }
  FAIL("no error");
  return {ErrorCode::internal, ""};
}

inline ErrorCode code_of(const std::function<void()>& act) { return error_of(act).code(); }

} // namespace calotte::test
