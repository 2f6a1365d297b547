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
  std::int64_t sites, triangles;
  std::uint64_t digest;
  std::array<char, 256> failure;
};

Message message_of(const Outcome& outcome) {
  Message message{outcome, outcome.sites, outcome.triangles, outcome.digest, {}};
  outcome.failure.copy(message.failure.data(), message.failure.size() - 1);
  return message;
}

Outcome outcome_of(const Message& message) {
  return {message.timed, message.sites, message.triangles, message.digest, message.failure.data()};
}

Outcome failed(const std::string& why) { return {{}, 0, 0, 0, why}; }

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
  if (pipe(ends.data()) != 0)
    return failed("no pipe");
  const pid_t child = fork();
  if (child == 0)
    run_and_send(run, ends[1]);
  close(ends[1]);
  Message message{};
  const bool received = child > 0 && read(ends[0], &message, sizeof message) == sizeof message;
  close(ends[0]);
  if (child > 0)
    waitpid(child, nullptr, 0);
  return received ? outcome_of(message) : failed("the new process ended without a result");
}

} // namespace calotte::bench
