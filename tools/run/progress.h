// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/progress.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace calotte::tools {

/// A line on standard error that names the stage and the seconds so far, with a bar where the part
/// that is done is known. On a terminal it is renewed, after the first second, and removed at the
/// end. Elsewhere it is a log: a line for each level of a run, and each minute, after the first ten
/// seconds.
class Progress {
public:
  Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// \param level of a run, in words; empty for other stages.
  void stage(const std::string& name, const std::string& level = {});

  /// Begins the stage "writing PATH". From here on a signal that ends the command says what becomes
  /// of its files, see announce_files().
  /// \returns bar().
  ProgressCallback writing(const std::string& path);

  /// For a function of the library that tells its progress: shows it as the bar of the current
  /// stage. Empty without a terminal. \pre it is not called after the lifetime.
  ProgressCallback bar();

  /// Prints a permanent line on standard error, on a terminal or not.
  void say(const std::string& line);

private:
  void show();
  void log(const std::string& level);

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  std::string stage_;
  std::optional<double> fraction_; ///< of the stage that is done, if it is known
  std::string logged_level_;       ///< of the last line of the log
  std::chrono::steady_clock::time_point logged_ = start_;
  bool end_ = false;
  std::thread thread_; ///< last, so that it starts after all other members exist
};

/// The line of a stage: "calotte: writing a.nc [#####---------------]  25% (3.1 s)".
/// \param fraction of the stage, 0 to 1; without a bar if it is not known.
/// \param columns of the terminal, beyond which the name is cut; 0 if they are not known.
std::string progress_line(const std::string& stage, std::optional<double> fraction, double seconds,
                          int columns);

/// Seconds of wall-clock time that a piece of work takes.
template <class Work> double seconds_of(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace calotte::tools
