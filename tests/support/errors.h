// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>

#include <doctest/doctest.h>

#include <functional>
#include <string>

namespace calotte::test {

/// The error that `act` throws, checked to be one line.
inline Error error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return error;
  }
  FAIL("no error");
  return {ErrorCode::internal, ""};
}

inline ErrorCode code_of(const std::function<void()>& act) { return error_of(act).code(); }

/// Its message.
inline std::string message_of(const std::function<void()>& act) { return error_of(act).what(); }

/// The message that refuses an argument.
inline std::string refusal_of(const std::function<void()>& act) {
  const Error error = error_of(act);
  CHECK(error.code() == ErrorCode::invalid_argument);
  return error.what();
}

} // namespace calotte::test
