// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/progress.h"

#include "run/interruption.h"
#include "text/text.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <sys/ioctl.h>
#include <unistd.h>

namespace calotte::tools {
namespace {

constexpr const char* clear_to_end = "\033[K";

/// Short runs in scripts have no log. The variable is for tests.
std::chrono::duration<double> silence() {
  const char* const seconds = std::getenv("CALOTTE_LOG_AFTER");
  return std::chrono::duration<double>(seconds == nullptr ? 10 : std::atof(seconds));
}

/// Columns of the terminal; 0 if it does not tell them.
int terminal_columns() {
  winsize size = {};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::string bar_text(double fraction) {
  constexpr int width = 20;
  const double part = std::clamp(fraction, 0.0, 1.0);
  const auto done = static_cast<std::size_t>(width * part);
  return message(" [{}{}] {}", std::string(done, '#'), std::string(width - done, '-'),
                 formatted("%3.0f%%", 100 * part));
}

/// Cuts a text to so many bytes, between characters of UTF-8.
std::string cut(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes)
    return text;
  constexpr std::string_view end = "...";
  std::size_t size = std::max(bytes, end.size()) - end.size();
  while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0U) == 0x80)
    --size;
  return text.substr(0, size).append(end);
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
  fraction_ = {};
  if (!thread_.joinable() && !level.empty())
    log(level);
}

ProgressCallback Progress::writing(const std::string& path) {
  stage("writing " + path);
  announce_files();
  return bar();
}

ProgressCallback Progress::bar() {
  if (!thread_.joinable())
    return {};
  return [this](const calotte::Progress& now) {
    const std::lock_guard lock(mutex_);
    fraction_ = now.fraction;
    return ProgressReply::proceed;
  };
}

void Progress::log(const std::string& level) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (now - start_ < silence() || (level == logged_level_ && now - logged_ < 1min))
    return;
  logged_level_ = level;
  logged_ = now;
  const std::chrono::duration<double> elapsed = now - start_;
  std::fprintf(stderr, "%s\n", progress_line(stage_, {}, elapsed.count(), 0).c_str());
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
    const std::string line = progress_line(stage_, fraction_, elapsed.count(), terminal_columns());
    std::fprintf(stderr, "\r%s%s", line.c_str(), clear_to_end);
  } while (!ended_.wait_for(lock, 100ms, [this] { return end_; }));
  std::fprintf(stderr, "\r%s", clear_to_end);
}

std::string progress_line(const std::string& stage, std::optional<double> fraction, double seconds,
                          int columns) {
  const std::string start = "calotte: ",
                    end = message("{} ({} s)", fraction ? bar_text(*fraction) : "",
                                  formatted("%.1f", seconds));
  if (columns <= 0)
    return start + stage + end;
  // A line that ends in the last column may begin the next one.
  const std::size_t used = start.size() + end.size() + 1,
                    left = std::max(static_cast<std::size_t>(columns), used) - used;
  return start + cut(stage, left) + end;
}

} // namespace calotte::tools
