// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/monitor.h"
#include "io/bytes/room.h"
#include "io/bytes/system.h"

#include <cstdint>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::io_detail {

/// Consecutive bytes of a file that is being written. They have the alignment of the file's pages,
/// so that the disk can read them from there.
class OutputBlock {
public:
  static constexpr std::int64_t page = 4096; ///< of the system, and at least a sector of any disk

  OutputBlock() = default;
  /// The bytes are not initialised.
  /// \param offset offset of the first byte in the file.
  /// \param memory reused if it is large enough.
  OutputBlock(std::int64_t offset, std::int64_t size, Array<char> memory = {});

  std::int64_t offset() const { return offset_; }
  std::int64_t size() const { return size_; }
  char* begin() { return begin_; }
  std::string_view bytes() const { return {begin_, static_cast<std::size_t>(size_)}; }
  /// \pre size <= size()
  void shorten(std::int64_t size) { size_ = size; }
  /// Moves out the memory for another block; this block is then empty.
  Array<char> take_memory() { return std::move(memory_); }

private:
  Array<char> memory_;
  char* begin_ = nullptr;
  std::int64_t offset_ = 0, size_ = 0;
};

class OutputQueue;

/// A file that appears under its name only when it is complete: it is written under a temporary
/// name in the same folder, synchronised and renamed. A temporary file that a killed process left
/// is removed when its target is written again. A target that cannot be renamed, such as a device
/// or a pipe, is opened and written directly.
class OutputFile {
public:
  /// \throws Error file.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile(); ///< removes what was not committed

  /// Reports progress while bytes are written: a run of one stage, "write".
  /// \param bytes expected total.
  /// \throws Error cancelled, as append() and put() do from then on.
  void watch(ProgressCallback progress, std::int64_t bytes);

  /// \throws Error file, at once or from commit().
  void append(std::string_view bytes);

  /// Announces the size of the file; no effect if the target is written directly. This detects a
  /// full disk early and allocates contiguous blocks.
  /// \throws Error file.
  void reserve(std::int64_t size);

  /// Returns a block to put, from any thread. It may reuse the memory of a block that is written:
  /// fresh memory would take the system longer than the disk takes to write the block.
  OutputBlock block(std::int64_t offset, std::int64_t size);

  /// Writes a block, from any thread. A large block goes from its memory to the disk while the
  /// caller continues, if the file system supports that.
  /// \pre temporary() is not empty; nothing is appended.
  /// \throws Error file, immediately, from a later call or from commit().
  void put(OutputBlock block);

  /// The temporary name, so that others may write to the file; empty if the target is written
  /// directly.
  const std::string& temporary() const { return temporary_; }

  /// Completes and synchronises the file, also data that others wrote to temporary(). Nothing can
  /// be written afterwards.
  /// \throws Error file.
  void finish();

  /// Gives the file its name, after finish().
  /// \throws Error file.
  void commit();

  /// \throws Error file, always, with the meaning of an errno for this file.
  [[noreturn]] void fail(int error) const;

private:
  void start_queue();
  void send(OutputBlock block);
  void keep(Array<char> memory);
  int write_direct(const OutputBlock& block);
  void require(int error) const;
  void put_tail();

  ProgressCallback progress_;
  std::unique_ptr<Monitor> monitor_; ///< null without a callback
  std::string name_;                 ///< as the caller wrote it, for messages
  std::string target_;               ///< final path; symbolic links are resolved
  std::string temporary_; ///< path until commit(); empty if the target is written directly
  Descriptor file_;
  Descriptor lock_;   ///< keeps the lock of the temporary file until it is renamed
  Descriptor direct_; ///< writes past the page cache; none if the file system does not support it
  OutputBlock tail_;  ///< appended bytes that are not yet put
  std::int64_t tail_size_ = 0;
  std::mutex spare_mutex_;
  std::vector<Array<char>> spare_; ///< memory of large blocks that are written
  std::once_flag queue_started_;
  std::unique_ptr<OutputQueue> queue_; ///< writes blocks to direct_; null without it
};

/// Throws for an output that cannot be written at random offsets.
/// \throws Error file for a device or a pipe.
void require_regular_output(const std::string& path);

/// \throws Error file for a folder, which the system would open.
void require_no_folder(const std::string& path);

/// \throws Error file, always, with the meaning of an errno of opening a file.
[[noreturn]] void refuse_input(const std::string& path, int error);

/// \throws Error file; parse, as refuse_foreign().
std::ifstream open_input(const std::string& path);

/// The same for readers of geometries, who take shapefiles, too.
std::ifstream open_geometries(const std::string& path);

/// The number of bytes from the current position to the end of a stream; 0 for a stream that cannot
/// tell it, such as a pipe.
std::size_t bytes_left(std::istream& in);

/// Checks the number of bytes after reading a file.
/// \throws Error file if it is smaller than `at_first`, the size at the start.
void require_whole(std::size_t read, std::size_t at_first, const std::string& name);

/// Reads up to `size` bytes; in.gcount() is their number.
/// \throws Error file for an error of the disk; the end of the stream is none.
void read_some(std::istream& in, char* bytes, std::int64_t size, const std::string& name);

/// Throws if a file starts as files of another format do. The message starts with `name`.
using StartCheck = void (*)(std::string_view start, const std::string& name);

/// Reads the rest of a stream.
/// \param check_start receives up to 1 MiB. If it throws, the rest is not read.
/// \throws Error file.
std::string read_all(std::istream& in, const std::string& name, StartCheck check_start = nullptr);

} // namespace calotte::io_detail
