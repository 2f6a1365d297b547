// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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

  /// The file takes its name. \throws Error file.
  void commit();

private:
  [[noreturn]] void fail(int error) const;

  std::string name_;      ///< as the caller wrote it, for messages
  std::string place_;     ///< where the file shall be: symbolic links are followed
  std::string temporary_; ///< where it is until it is whole; empty when it is written in place
  int descriptor_ = -1;
};

/// \throws Error file.
std::ifstream open_input(const std::string& path);

/// The rest of a stream. \throws Error file.
std::string read_all(std::istream& in, const std::string& name);

} // namespace calotte::detail
