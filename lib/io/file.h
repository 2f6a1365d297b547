// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "base/monitor.h"
#include "io/room.h"

#include <cstdint>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::io_detail {

/// Consecutive bytes of a file in the making. They stand in memory as they stand in the file's
/// pages, so that the disk can fetch them from there.
class OutputBlock {
public:
  static constexpr std::int64_t page = 4096; ///< of the system, and at least a sector of any disk

  OutputBlock() = default;
  /// The bytes are not initialised. \param offset of the first one in the file. \param memory is
  /// used where it is large enough.
  OutputBlock(std::int64_t offset, std::int64_t size, Array<char> memory = {});

  std::int64_t offset() const { return offset_; }
  std::int64_t size() const { return size_; }
  char* begin() { return begin_; }
  std::string_view bytes() const { return {begin_, static_cast<std::size_t>(size_)}; }
  /// \pre size <= size()
  void shorten(std::int64_t size) { size_ = size; }
  /// For another block; this one is no more.
  Array<char> take_memory() { return std::move(memory_); }

private:
  Array<char> memory_;
  char* begin_ = nullptr;
  std::int64_t offset_ = 0, size_ = 0;
};

class OutputQueue;

/// A file that appears under its name only when it is whole: it is written beside its place,
/// brought to the disk and renamed. What cannot be renamed, such as a device or a pipe, is written
/// in place.
class OutputFile {
public:
  /// \throws Error file.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile(); ///< removes what was not committed

  /// Tells a caller of bytes as they come: a run of one stage, "write".
  /// \param bytes expected in all. \throws Error cancelled, as append() and put() do from here on.
  void watch(ProgressCallback progress, std::int64_t bytes);

  /// \throws Error file, at once or from commit().
  void append(std::string_view bytes);

  /// Tells how large the file will be, where it is not written in place. A full disk is found now,
  /// and the blocks lie side by side. \throws Error file.
  void reserve(std::int64_t size);

  /// A block to put, from any thread. It may stand where one stood that is written: the system's
  /// memory for a fresh one would cost more than the disk takes to write it.
  OutputBlock block(std::int64_t offset, std::int64_t size);

  /// Writes a block, from any thread. A large one goes from its memory to the disk where the file
  /// system can do that, while the caller goes on. \pre temporary() is not empty; nothing is
  /// appended. \throws Error file, at once, from a later call or from commit().
  void put(OutputBlock block);

  /// Where the file stands until it is whole, so that others may write to it; empty when it is
  /// written in place.
  const std::string& temporary() const { return temporary_; }

  /// The file takes its name; what others wrote to temporary() is brought to the disk, too.
  /// \throws Error file.
  void commit();

  /// \throws Error file that says what an errno means for this file, always.
  [[noreturn]] void fail(int error) const;

private:
  void start_queue();
  void send(OutputBlock block);
  void keep(Array<char> memory);
  int write_direct(const OutputBlock& block);
  int write_through_cache(std::int64_t offset, std::string_view bytes) const;
  void put_tail();

  ProgressCallback progress_;
  std::unique_ptr<Monitor> monitor_; ///< null where nobody watches
  std::string name_;                 ///< as the caller wrote it, for messages
  std::string place_;                ///< where the file shall be: symbolic links are followed
  std::string temporary_; ///< where it is until it is whole; empty when it is written in place
  int descriptor_ = -1;
  int direct_ = -1;  ///< writes past the page cache; -1 where the file system cannot
  OutputBlock tail_; ///< what is appended and not yet put
  std::int64_t tail_size_ = 0;
  std::mutex spare_mutex_;
  std::vector<Array<char>> spare_; ///< of large blocks that are written
  std::once_flag queue_started_;
  std::unique_ptr<OutputQueue> queue_; ///< of blocks for direct_; null where it is -1
};

/// For formats that are not written from front to back. \throws Error file for a device or a pipe.
void require_regular_output(const std::string& path);

/// \throws Error file.
std::ifstream open_input(const std::string& path);

/// The rest of a stream. \throws Error file.
std::string read_all(std::istream& in, const std::string& name);

} // namespace calotte::io_detail
