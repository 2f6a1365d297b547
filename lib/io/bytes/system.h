// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

/// All calls of the operating system about files: those of POSIX, and some of Linux. An error is an
/// errno; 0 is none.
namespace calotte::io_detail {

/// An open file.
class Descriptor {
public:
  Descriptor() = default;
  // Each opens a file, or is false and leaves the errno.
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
  /// Reads bytes from an offset on, as many as there are. \param count receives their number.
  int read(std::int64_t offset, std::int64_t bytes, char* out, std::int64_t& count) const;
  int write(std::int64_t offset, std::string_view bytes) const;
  int append(std::string_view bytes) const;
  /// Allocates the space of a file of that size. Many file systems do so when bytes are written; of
  /// these it says nothing.
  int reserve(std::int64_t size) const;
  int synchronise() const;
  int close(); ///< an error may be one of bytes written before

  /// Locks the file against other processes; false where one of them has, or there are no locks.
  bool lock() const;
  /// Whether the path names this file, still.
  bool is_named(const std::string& path) const;

private:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

/// Gives a file another name, and takes it from the one that has it.
int rename_file(const std::string& from, const std::string& to);
void remove_file(const std::string& path); ///< if there is one
/// Calls for the name of each file in a folder; "" is the current one.
void for_each_name(const std::string& folder, const std::function<void(std::string_view)>& visit);
std::int64_t process_id();

} // namespace calotte::io_detail
