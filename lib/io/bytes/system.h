// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

/// All system calls for files: those of POSIX, and some of Linux. Errors are errno values; 0 means
/// success.
namespace calotte::io_detail {

/// An open file.
class Descriptor {
public:
  Descriptor() = default;
  // Each function opens a file. After a failure the result converts to false, and errno has the
  // reason.
  static Descriptor to_read(const std::string& path);
  static Descriptor to_write(const std::string& path);        ///< one that exists
  static Descriptor to_write_new(const std::string& path);    ///< one that does not exist yet
  static Descriptor to_write_direct(const std::string& path); ///< past the page cache
  static Descriptor to_lock(const std::string& path);         ///< follows no link, waits for nobody
  /// Another descriptor of the same open file. A lock on the file stays until both are closed.
  Descriptor duplicate() const;

  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();
  explicit operator bool() const { return descriptor_ >= 0; }

  std::int64_t size() const; ///< bytes; -1 for a pipe
  /// Reads up to `bytes` bytes from an offset on.
  /// \param count receives their number.
  int read(std::int64_t offset, std::int64_t bytes, char* out, std::int64_t& count) const;
  int write(std::int64_t offset, std::string_view bytes) const;
  int append(std::string_view bytes) const;
  /// Allocates disk space for a file of that size. Has no effect on file systems that allocate
  /// space only when bytes are written.
  int reserve(std::int64_t size) const;
  int synchronise() const;
  int close(); ///< may report the error of an earlier write

  /// Locks the file against other processes. Returns false if another process has the lock, or if
  /// the file system has no locks.
  bool lock() const;
  /// Whether the path still names this file.
  bool is_named(const std::string& path) const;

private:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

/// Renames a file. Replaces a file that has the new name.
int rename_file(const std::string& from, const std::string& to);
void remove_file(const std::string& path); ///< if there is one
/// Calls `visit` with the name of each file in a folder; "" is the current folder.
void for_each_name(const std::string& folder, const std::function<void(std::string_view)>& visit);
std::int64_t process_id();

} // namespace calotte::io_detail
