// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace calotte::detail {

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

  /// \throws Error file.
  void append(std::string_view bytes);

  /// Writes bytes at an offset, from any thread. \pre temporary() is not empty. \throws Error file.
  void put(std::int64_t offset, std::string_view bytes) const;

  /// Where the file stands until it is whole, so that others may write to it; empty when it is
  /// written in place.
  const std::string& temporary() const { return temporary_; }

  /// The file takes its name; what others wrote to temporary() is brought to the disk, too.
  /// \throws Error file.
  void commit();

  /// \throws Error file that says what an errno means for this file, always.
  [[noreturn]] void fail(int error) const;

private:
  std::string name_;      ///< as the caller wrote it, for messages
  std::string place_;     ///< where the file shall be: symbolic links are followed
  std::string temporary_; ///< where it is until it is whole; empty when it is written in place
  int descriptor_ = -1;
};

/// For formats that are not written from front to back. \throws Error file for a device or a pipe.
void require_regular_output(const std::string& path);

/// \throws Error file.
std::ifstream open_input(const std::string& path);

/// The rest of a stream. \throws Error file.
std::string read_all(std::istream& in, const std::string& name);

} // namespace calotte::detail
