// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/system.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace calotte::io_detail {
namespace {

int error_of(int result) { return result == 0 ? 0 : errno; }

/// Repeats a call until all bytes are transferred, or until a call transfers none.
/// \param call receives the number of bytes that are done, and returns how many more it
///        transferred.
template <class Call> int transfer(std::int64_t bytes, std::int64_t& done, const Call& call) {
  for (done = 0; done < bytes;) {
    const ssize_t more = call(done);
    if (more < 0 && errno != EINTR)
      return errno;
    if (more == 0)
      return 0;
    if (more > 0)
      done += more;
  }
  return 0;
}

template <class Call> int put_all(std::string_view bytes, const Call& call) {
  std::int64_t done = 0;
  const int error = transfer(std::ssize(bytes), done, [&](std::int64_t from) {
    const std::string_view rest = bytes.substr(static_cast<std::size_t>(from));
    return call(rest.data(), rest.size(), from);
  });
  return error == 0 && done < std::ssize(bytes) ? EIO : error;
}

} // namespace

Descriptor Descriptor::to_read(const std::string& path) {
  return Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
}

Descriptor Descriptor::to_write(const std::string& path) {
  return Descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
}

Descriptor Descriptor::to_write_new(const std::string& path) {
  return Descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
}

Descriptor Descriptor::to_write_direct([[maybe_unused]] const std::string& path) {
#ifdef O_DIRECT
  return Descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_DIRECT));
#else
  return {};
#endif
}

Descriptor Descriptor::to_lock(const std::string& path) {
  return Descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
}

Descriptor Descriptor::duplicate() const {
  return Descriptor(::fcntl(descriptor_, F_DUPFD_CLOEXEC, 0));
}

Descriptor::Descriptor(Descriptor&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

Descriptor::~Descriptor() { close(); }

std::int64_t Descriptor::size() const { return ::lseek(descriptor_, 0, SEEK_END); }

int Descriptor::read(std::int64_t offset, std::int64_t bytes, char* out,
                     std::int64_t& count) const {
  return transfer(bytes, count, [&](std::int64_t done) {
    return ::pread(descriptor_, out + done, static_cast<std::size_t>(bytes - done), offset + done);
  });
}

int Descriptor::write(std::int64_t offset, std::string_view bytes) const {
  return put_all(bytes, [&](const char* data, std::size_t size, std::int64_t done) {
    return ::pwrite(descriptor_, data, size, offset + done);
  });
}

int Descriptor::append(std::string_view bytes) const {
  return put_all(bytes, [&](const char* data, std::size_t size, std::int64_t) {
    return ::write(descriptor_, data, size);
  });
}

int Descriptor::reserve([[maybe_unused]] std::int64_t size) const {
#ifdef __linux__
  const int error = error_of(::fallocate(descriptor_, 0, 0, size));
  return error == ENOSPC || error == EDQUOT || error == EFBIG ? error : 0;
#else
  return 0;
#endif
}

int Descriptor::synchronise() const { return error_of(::fsync(descriptor_)); }

int Descriptor::close() {
  const int descriptor = std::exchange(descriptor_, -1);
  return descriptor < 0 ? 0 : error_of(::close(descriptor));
}

bool Descriptor::lock() const { return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0; }

bool Descriptor::is_named(const std::string& path) const {
  struct stat file = {}, named = {};
  return ::fstat(descriptor_, &file) == 0 && ::stat(path.c_str(), &named) == 0 &&
         file.st_ino == named.st_ino && file.st_dev == named.st_dev;
}

int rename_file(const std::string& from, const std::string& to) {
  return error_of(std::rename(from.c_str(), to.c_str()));
}

void remove_file(const std::string& path) { ::unlink(path.c_str()); }

void for_each_name(const std::string& folder, const std::function<void(std::string_view)>& visit) {
  // The directory iterator of libstdc++ ends the program where memory is short.
  const auto close = [](DIR* opened) { ::closedir(opened); };
  const std::unique_ptr<DIR, decltype(close)> listed(
      ::opendir(folder.empty() ? "." : folder.c_str()), close);
  while (const dirent* const file = listed ? ::readdir(listed.get()) : nullptr)
    visit(file->d_name);
}

std::int64_t process_id() { return ::getpid(); }

} // namespace calotte::io_detail
