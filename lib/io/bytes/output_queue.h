// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/file.h"
#include "io/bytes/room.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace calotte::io_detail {

/// A queue of blocks for the disk, with threads that write them. The threads mostly wait for the
/// disk; the processors are free for the tasks that fill the next blocks.
class OutputQueue {
public:
  /// Several threads call it at once.
  /// \returns 0, or the errno of the failure.
  using Write = std::function<int(OutputBlock)>;

  explicit OutputQueue(Write write);
  OutputQueue(const OutputQueue&) = delete;
  OutputQueue& operator=(const OutputQueue&) = delete;
  ~OutputQueue(); ///< drops what is not written

  /// Adds a block; waits while the queue is full. Without a thread, the call writes the block
  /// itself. Any thread may call it.
  /// \returns 0, or the first errno so far.
  int push(OutputBlock block);

  /// Waits until all is written, or after a failure until no thread writes any more.
  /// \returns 0, or the first errno.
  int finish();

private:
  void run();

  static constexpr std::size_t most_waiting = 8;
  const Write write_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<OutputBlock> waiting_;
  int writing_ = 0; ///< number of threads that are writing
  bool ended_ = false;
  int error_ = 0;
  std::vector<std::thread> threads_;
};

} // namespace calotte::io_detail
