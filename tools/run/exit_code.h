// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/warning.h"

#include <CLI/App.hpp>

#include <iostream>
#include <string>

namespace calotte::tools {

enum ExitCode {
  done = 0,
  check_failed = 1,
  not_converged = 1,
  bad_input = 2,
  file_trouble = 3,
  internal_error = 4,
  not_well_centred = 5,
  beyond_demands = 5, ///< of the model that is to read the grid
  interrupted = 130,  ///< by SIGINT, as in a shell: 128 and the signal's number
  terminated = 143,   ///< by SIGTERM
};

/// Ends the command with an exit code, without a message.
[[noreturn]] inline void finish(ExitCode code) { throw CLI::RuntimeError(code); }

/// The same, with a message after all that standard output has.
[[noreturn]] inline void finish(ExitCode code, const std::string& text) {
  std::cout.flush();
  complain(text);
  finish(code);
}

} // namespace calotte::tools
