// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"
#include "io/bytes/system.h"

#include <cstdint>
#include <string>

namespace calotte::io_detail {

/// A file that is open for reading at any offset, from several threads at once. It stays the same
/// file if its name is removed or given to another.
class FileReader {
public:
  /// \throws Error file; also for a pipe.
  explicit FileReader(const std::string& path);

  const std::string& path() const { return path_; }
  std::int64_t size() const { return size_; } ///< size in bytes when the file was opened

  /// \throws Error file for a disk error, and if the file ends earlier.
  void read(std::int64_t offset, std::int64_t bytes, char* out) const;

  /// \throws Error file if the file is smaller than when it was opened.
  void require_whole() const;

private:
  std::string path_;
  Descriptor file_;
  std::int64_t size_ = 0;
};

} // namespace calotte::io_detail
