// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_reader.h"

#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"

#include <cerrno>

namespace calotte::io_detail {

FileReader::FileReader(const std::string& path) : path_(path) {
  require_no_folder(path);
  file_ = Descriptor::to_read(path);
  if (!file_)
    refuse_input(path, errno);
  refuse_foreign(path);
  size_ = file_.size();
  if (size_ >= 0)
    return;
  fail_read(path, "it is a pipe, and the format is not read from front to back; give the name of "
                  "a file");
}

void FileReader::read(std::int64_t offset, std::int64_t bytes, char* out) const {
  std::int64_t count = 0;
  if (const int error = file_.read(offset, bytes, out, count); error != 0)
    fail_disk(path_, error);
  io_detail::require_whole(static_cast<std::size_t>(count), static_cast<std::size_t>(bytes), path_);
}

void FileReader::require_whole() const {
  io_detail::require_whole(static_cast<std::size_t>(file_.size()), static_cast<std::size_t>(size_),
                           path_);
}

} // namespace calotte::io_detail
