// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <csignal>
#include <list>
#include <string>
#include <utility>

namespace calotte::tools {

/// From here on SIGINT and SIGTERM end the process with a line on standard error: that it has
/// written nothing. A signal that the process ignores stays ignored. Call it once.
void announce_end();

/// From here on that line says how files are named that are not complete: see OutputFile.
void announce_files();

/// During its lifetime, the first SIGINT or SIGTERM is answered with a line and recorded instead of
/// ending the process. Others within a second count as the same, also after the lifetime; a later
/// one ends the process at once. A signal that the process ignores stays ignored. A broken pipe
/// does not end the process. One object at a time.
class Interruption {
public:
  /// \param answer the line on standard error, without its end.
  explicit Interruption(const std::string& answer);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Replaces the answer; memory grows with each other text.
  void set_answer(const std::string& answer);

  /// The signal received, or 0.
  static int signal();

private:
  std::list<std::string> answers_; ///< all, as a handler may be reading one
  std::array<std::pair<int, struct sigaction>, 2> before_{{{SIGINT, {}}, {SIGTERM, {}}}};
  struct sigaction before_pipe_ = {};
};

} // namespace calotte::tools
