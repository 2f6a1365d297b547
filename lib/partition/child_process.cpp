// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/child_process.h"

#include <calotte/error.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <new>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace calotte::partition_detail {
namespace {

constexpr int failed = 1;

/// Ends a child that a library calls exit() in, before what the parent has registered for its end.
void leave() { ::_exit(failed); }

/// \param parent which may have ended before the child asks for its signal.
void become_child(pid_t parent) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (::getppid() != parent)
    leave();
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGABRT, SIGTERM})
    ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  std::atexit(leave);
}

[[noreturn]] void refuse_process(int error) {
  if (error == ENOMEM)
    throw std::bad_alloc();
  throw Error(ErrorCode::file,
              "the system starts no process for METIS: " + std::generic_category().message(error) +
                  "; raise its limit (ulimit -u), or give fewer threads");
}

} // namespace

SharedIds::SharedIds(std::size_t count) {
  void* const memory = ::mmap(nullptr, count * sizeof(std::int32_t), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
    throw std::bad_alloc();
  ids_ = {static_cast<std::int32_t*>(memory), count};
}

SharedIds::~SharedIds() { ::munmap(ids_.data(), ids_.size_bytes()); }

std::optional<int> result_of_child(const std::function<int()>& work) {
  // Not the exit code: a process that ignores SIGCHLD, or waits for any child, takes that away.
  const SharedIds state(2);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0)
    refuse_process(errno);
  if (child == 0) {
    become_child(parent);
    state.ids()[0] = work();
    state.ids()[1] = 1;
    ::_exit(0);
  }
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR)
    ;
  return state.ids()[1] == 1 ? std::optional<int>(state.ids()[0]) : std::nullopt;
}

} // namespace calotte::partition_detail
