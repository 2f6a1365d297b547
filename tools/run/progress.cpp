// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/progress.h"

#include <cstdio>
#include <cstdlib>

#include <unistd.h>

namespace calotte::tools {
namespace {

constexpr const char* clear_to_end = "\033[K";

/// Short runs in scripts have no log. The variable is for tests.
std::chrono::duration<double> silence() {
  const char* const seconds = std::getenv("CALOTTE_LOG_AFTER");
  return std::chrono::duration<double>(seconds == nullptr ? 10 : std::atof(seconds));
}

} // namespace

Progress::Progress() {
  if (::isatty(STDERR_FILENO))
    thread_ = std::thread([this] { show(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  if (thread_.joinable())
    thread_.join();
}

void Progress::stage(const std::string& name, const std::string& level) {
  const std::lock_guard lock(mutex_);
  stage_ = name;
  if (!thread_.joinable() && !level.empty())
    log(level);
}

void Progress::log(const std::string& level) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (now - start_ < silence() || (level == logged_level_ && now - logged_ < 1min))
    return;
  logged_level_ = level;
  logged_ = now;
  const std::chrono::duration<double> elapsed = now - start_;
  std::fprintf(stderr, "calotte: %s (%.1f s)\n", stage_.c_str(), elapsed.count());
}

void Progress::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (thread_.joinable())
    std::fprintf(stderr, "\r%s", clear_to_end);
  std::fprintf(stderr, "calotte: %s\n", line.c_str());
}

void Progress::show() {
  using namespace std::chrono_literals;
  std::unique_lock lock(mutex_);
  if (ended_.wait_for(lock, 1s, [this] { return end_; }))
    return;
  do {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    std::fprintf(stderr, "\rcalotte: %s (%.1f s)%s", stage_.c_str(), elapsed.count(), clear_to_end);
  } while (!ended_.wait_for(lock, 100ms, [this] { return end_; }));
  std::fprintf(stderr, "\r%s", clear_to_end);
}

} // namespace calotte::tools
