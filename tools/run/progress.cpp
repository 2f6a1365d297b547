// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/progress.h"

#include <cstdio>

#include <unistd.h>

namespace calotte::tools {
namespace {

constexpr const char* clear_to_end = "\033[K";

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

void Progress::stage(const std::string& name) {
  const std::lock_guard lock(mutex_);
  stage_ = name;
}

void Progress::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (thread_.joinable())
    std::fprintf(stderr, "\r%s", clear_to_end);
  std::fprintf(stderr, "%s\n", line.c_str());
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
