// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace calotte::tools {

/// A line on standard error that names the stage and the seconds so far: only on a terminal, only
/// after a second; removed at the end.
class Progress {
public:
  Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void stage(const std::string& name);

  /// Prints a permanent line on standard error, on a terminal or not.
  void say(const std::string& line);

private:
  void show();

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  std::string stage_;
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
