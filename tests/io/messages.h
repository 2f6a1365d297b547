// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/files.h"

#include <functional>
#include <string>

namespace calotte::test {

/// The message of the error that the function throws.
inline std::string message_of(const std::function<void()>& work) { return error_of(work).what(); }

} // namespace calotte::test
