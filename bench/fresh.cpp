// SPDX-License-Identifier: GPL-3.0-or-later
#include "fresh.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <exception>

namespace calotte::bench {

namespace {

/// An outcome as bytes.
struct Message {
  Timed timed;
  std::int64_t sites, triangles, exact_predicates;
  std::uint64_t digest;
  decltype(DelaunayReport::seconds) seconds;
  int regions;
  double overlap;
  std::array<char, 256> failure;
};

Message message_of(const Outcome& outcome) {
  const DelaunayReport& report = outcome.report;
  Message message{outcome,
                  outcome.sites,
                  outcome.triangles,
                  report.exact_predicates,
                  outcome.digest,
                  report.seconds,
                  report.regions,
                  report.overlap,
                  {}};
  outcome.failure.copy(message.failure.data(), message.failure.size() - 1);
  return message;
}

Outcome outcome_of(const Message& message) {
  Outcome outcome;
  static_cast<Timed&>(outcome) = message.timed;
  outcome.sites = message.sites;
  outcome.triangles = message.triangles;
  outcome.digest = message.digest;
  outcome.failure = message.failure.data();
  outcome.report.seconds = message.seconds;
  outcome.report.regions = message.regions;
  outcome.report.overlap = message.overlap;
  outcome.report.exact_predicates = message.exact_predicates;
  return outcome;
}

Outcome failed(const std::string& why) {
  Outcome outcome;
  outcome.failure = why;
  return outcome;
}

[[noreturn]] void run_and_send(const std::function<Outcome()>& run, int pipe_end) {
  Outcome outcome;
  try {
    outcome = run();
  } catch (const std::exception& error) {
    outcome = failed(error.what());
  }
  const Message message = message_of(outcome);
  const bool sent = write(pipe_end, &message, sizeof message) == sizeof message;
  _exit(sent ? 0 : 1);
}

} // namespace

Outcome run_in_new_process(const std::function<Outcome()>& run) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) {
    return failed("no pipe");
  }
  const pid_t child = fork();
  if (child == 0) {
    run_and_send(run, ends[1]);
  }
  close(ends[1]);
  Message message{};
  const bool received = child > 0 && read(ends[0], &message, sizeof message) == sizeof message;
  close(ends[0]);
  if (child > 0) {
    waitpid(child, nullptr, 0);
  }
  return received ? outcome_of(message) : failed("the new process ended without a result");
}

} // namespace calotte::bench
