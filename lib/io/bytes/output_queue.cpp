// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/output_queue.h"

#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

namespace calotte::io_detail {

OutputQueue::OutputQueue(Write write) : write_(std::move(write)) {
  constexpr int threads = 2; // two: the disk writes a block of one while the other wakes up
  try {
    for (int t = 0; t < threads; ++t)
      threads_.emplace_back([this] { run(); });
  } catch (const std::system_error&) { // no more threads: continue with the existing ones
  } catch (const std::bad_alloc&) {    // the same; a started thread must be joined
  }
}

OutputQueue::~OutputQueue() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    waiting_.clear();
  }
  changed_.notify_all();
  for (std::thread& thread : threads_)
    thread.join();
}

int OutputQueue::push(OutputBlock block) {
  if (threads_.empty())
    return write_(std::move(block));
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < most_waiting || error_ != 0; });
  if (error_ == 0)
    waiting_.push_back(std::move(block));
  changed_.notify_all();
  return error_;
}

int OutputQueue::finish() {
  std::unique_lock lock(mutex_);
  // A failure has emptied the queue; a write may still be under way.
  changed_.wait(lock, [this] { return waiting_.empty() && writing_ == 0; });
  return error_;
}

void OutputQueue::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return !waiting_.empty() || ended_; });
    if (ended_)
      return;
    OutputBlock block = std::move(waiting_.front());
    waiting_.pop_front();
    ++writing_;
    changed_.notify_all();
    lock.unlock();
    int error = ENOMEM;
    try {
      error = write_(std::move(block));
    } catch (const std::bad_alloc&) { // no exception leaves the thread
    }
    lock.lock();
    --writing_;
    if (error != 0 && error_ == 0) {
      error_ = error;
      waiting_.clear();
    }
    changed_.notify_all();
  }
}

} // namespace calotte::io_detail
