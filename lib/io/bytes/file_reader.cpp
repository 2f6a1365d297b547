// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_reader.h"

#include "io/bytes/file.h"

#include <calotte/error.h>

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace calotte::io_detail {

FileReader::FileReader(const std::string& path) : path_(path) {
  require_no_folder(path);
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0)
    refuse_input(path, errno);
  size_ = ::lseek(descriptor_, 0, SEEK_END);
  if (size_ >= 0)
    return;
  ::close(descriptor_);
  throw Error(ErrorCode::file, "cannot read " + path +
                                   ": it is a pipe, and the format is not read from front to "
                                   "back; give the name of a file");
}

FileReader::~FileReader() { ::close(descriptor_); }

void FileReader::read(std::int64_t offset, std::int64_t bytes, char* out) const {
  while (bytes > 0) {
    const ssize_t got = ::pread(descriptor_, out, static_cast<std::size_t>(bytes), offset);
    if (got < 0 && errno != EINTR)
      throw Error(ErrorCode::file, "cannot read " + path_ + ": " +
                                       std::generic_category().message(errno) + "; check the disk");
    if (got == 0)
      io_detail::require_whole(0, 1, path_);
    if (got > 0)
      out += got, offset += got, bytes -= got;
  }
}

void FileReader::require_whole() const {
  io_detail::require_whole(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)),
                           static_cast<std::size_t>(size_), path_);
}

} // namespace calotte::io_detail
