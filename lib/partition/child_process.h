// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "partition/room.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

/// Work in a child process, for libraries whose state is that of a process.
namespace calotte::partition_detail {

/// Numbers that this process and its children share; 0 at first.
class SharedIds {
public:
  /// \throws std::bad_alloc.
  explicit SharedIds(std::size_t count);
  SharedIds(const SharedIds&) = delete;
  SharedIds& operator=(const SharedIds&) = delete;
  ~SharedIds();

  std::span<std::int32_t> ids() const { return ids_; }

private:
  std::span<std::int32_t> ids_;
};

/// Runs work in a child process: a copy of this one with a single thread, default handlers of
/// signals, and without standard output and error. Linux ends it with this thread.
/// \param work may allocate memory, and must use no thread of this process. All that it changes is
///        lost, but for SharedIds.
/// \returns what work returns; none if a signal or exit() ended the process.
/// \throws Error file, if the system starts no process; std::bad_alloc.
std::optional<int> result_of_child(const std::function<int()>& work);

} // namespace calotte::partition_detail
