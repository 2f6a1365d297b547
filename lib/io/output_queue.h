// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/file.h"
#include "io/room.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace calotte::io_detail {

/// Blocks that wait for the disk, and threads that wait with them: these take next to no time of
/// the processors, which the tasks that fill the next blocks have meanwhile.
class OutputQueue {
public:
  /// Called from several threads at once. \returns 0, or the errno of what failed.
  using Write = std::function<int(OutputBlock)>;

  explicit OutputQueue(Write write);
  OutputQueue(const OutputQueue&) = delete;
  OutputQueue& operator=(const OutputQueue&) = delete;
  ~OutputQueue(); ///< drops what is not written

  /// Waits while too many blocks do; without a thread to write it, writes it itself. From any
  /// thread. \returns 0, or the first errno so far.
  int push(OutputBlock block);

  /// Waits until all is written. \returns 0, or the first errno.
  int finish();

private:
  void run();

  static constexpr std::size_t most_waiting = 8;
  const Write write_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<OutputBlock> waiting_;
  int writing_ = 0; ///< threads that do
  bool ended_ = false;
  int error_ = 0;
  std::vector<std::thread> threads_;
};

} // namespace calotte::io_detail
