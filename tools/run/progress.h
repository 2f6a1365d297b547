// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace calotte::tools {

/// A line on standard error that names the stage and the seconds so far. On a terminal it is
/// renewed, after the first second, and removed at the end. Elsewhere it is a log: a line for each
/// level of a run, and each minute, after the first ten seconds.
class Progress {
public:
  Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// \param level of a run, in words; empty for other stages.
  void stage(const std::string& name, const std::string& level = {});

  /// Prints a permanent line on standard error, on a terminal or not.
  void say(const std::string& line);

private:
  void show();
  void log(const std::string& level);

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  std::string stage_;
  std::string logged_level_; ///< of the last line of the log
  std::chrono::steady_clock::time_point logged_ = start_;
  bool end_ = false;
  std::thread thread_; ///< last, so that it starts after all other members exist
};

/// Seconds of wall-clock time that a piece of work takes.
template <class Work> double seconds_of(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace calotte::tools
