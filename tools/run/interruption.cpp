// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/interruption.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>

#include <unistd.h>

namespace calotte::tools {
namespace {

std::atomic<int> noted = 0;
std::atomic<std::int64_t> noted_at = 0;     ///< nanoseconds
std::atomic<const char*> recorded = "";     ///< the answer to a signal that is recorded
std::atomic<bool> may_have_written = false; ///< see announce_files()
std::atomic<bool> on_terminal = false;      ///< standard error
static_assert(std::atomic<int>::is_always_lock_free &&
                  std::atomic<std::int64_t>::is_always_lock_free &&
                  std::atomic<const char*>::is_always_lock_free &&
                  std::atomic<bool>::is_always_lock_free,
              "a handler of signals may use nothing else");

std::int64_t nanoseconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// Text for a handler, which must not allocate memory. What does not fit is cut.
class Line {
public:
  void add(const char* text) {
    const std::size_t length = std::min(std::strlen(text), sizeof text_ - size_);
    std::memcpy(text_ + size_, text, length);
    size_ += length;
  }

  /// In one call, so that no line of Progress stands between its parts. A failure has no remedy.
  void write() { [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text_, size_); }

private:
  char text_[1024];
  std::size_t size_ = 0;
};

/// What clears ^C and the line of Progress.
const char* clearing() { return on_terminal ? "\r\033[K" : ""; }

Line begun_line() {
  Line line;
  line.add(clearing());
  line.add("calotte: ");
  return line;
}

/// Ends the process as the signal does by default.
void end_by(int signal) {
  std::signal(signal, SIG_DFL);
  std::raise(signal); // delivered when the handler returns
}

extern "C" void calotte_end_by_signal(int signal) {
  Line line = begun_line();
  line.add("stopped by ");
  line.add(signal == SIGINT ? "SIGINT" : "SIGTERM");
  line.add(may_have_written
               ? "; unfinished files are named *.part*, and removed when they are written again"
               : "; nothing is written");
  line.add("\n");
  line.write();
  end_by(signal);
}

/// Terminals, shells, timeout and schedulers may send several signals at once.
extern "C" void calotte_note_signal(int signal) {
  constexpr std::int64_t together = 1'000'000'000;
  const int error = errno;
  if (noted == 0) {
    noted_at = nanoseconds();
    noted = signal;
    Line line = begun_line();
    line.add(recorded);
    line.add("\n");
    line.write();
  } else if (nanoseconds() - noted_at > together) {
    Line line;
    line.add(clearing());
    line.write();
    end_by(signal);
  }
  errno = error;
}

/// \param flags of sigaction().
void handle(int signal, void (*handler)(int), int flags, struct sigaction* before) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  ::sigaction(signal, &action, before);
}

} // namespace

void announce_end() {
  on_terminal = ::isatty(STDERR_FILENO) != 0;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before = {};
    handle(signal, calotte_end_by_signal, 0, &before);
    if (before.sa_handler == SIG_IGN)
      ::sigaction(signal, &before, nullptr);
  }
}

void announce_files() { may_have_written = true; }

Interruption::Interruption(const std::string& answer) {
  noted = 0;
  set_answer(answer);
  for (auto& [signal, before] : before_) {
    handle(signal, calotte_note_signal, SA_RESTART, &before); // a write continues
    if (before.sa_handler == SIG_IGN)
      ::sigaction(signal, &before, nullptr);
  }
  // The reader of the answer may be gone, such as a tee that the same signal ended.
  handle(SIGPIPE, SIG_IGN, 0, &before_pipe_);
}

Interruption::~Interruption() {
  // The process ends: another signal within the second must not change its exit code.
  if (noted == 0)
    for (const auto& [signal, before] : before_)
      ::sigaction(signal, &before, nullptr);
  ::sigaction(SIGPIPE, &before_pipe_, nullptr);
  recorded = "";
}

void Interruption::set_answer(const std::string& answer) {
  if (answers_.empty() || answers_.back() != answer)
    recorded = answers_.emplace_back(answer).c_str();
}

int Interruption::signal() { return noted; }

} // namespace calotte::tools
