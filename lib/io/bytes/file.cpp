// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"

#include "io/bytes/output_queue.h"
#include "io/bytes/temporary_file.h"
#include "io/command.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace calotte {
namespace io_detail {
namespace {

namespace fs = std::filesystem;

std::string describe(int error) {
  switch (error) {
  case ENOENT:
  case ENOTDIR:
    return "its folder does not exist; create it first";
  case ENOSPC:
  case EDQUOT:
  case EFBIG:
    return std::generic_category().message(error) + "; make room or write elsewhere";
  case EISDIR:
    return "it is a folder; give the name of a file";
  default:
    return std::generic_category().message(error) + "; write elsewhere";
  }
}

bool renameable(const fs::path& place) {
  std::error_code absent;
  const fs::file_status status = fs::status(place, absent);
  return !fs::exists(status) || fs::is_regular_file(status);
}

fs::path follow_links(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error))
    return path;
  const fs::path place = fs::weakly_canonical(path, error);
  return error ? fs::path(path) : place;
}

/// Returns the errno of a failure, or 0.
int pwrite_all(int descriptor, std::int64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), offset);
    if (written < 0 && errno != EINTR)
      return errno;
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
      offset += written;
    }
  }
  return 0;
}

/// Smallest block for direct output; smaller blocks gain nothing from it.
constexpr std::int64_t least_direct = 1 << 18;
/// Number of spare blocks; more than wait for the disk and are being filled.
constexpr std::size_t most_spare = 64;
/// Size of a block of appended bytes.
constexpr std::int64_t tail_bytes = 1 << 22;

std::int64_t page_before(std::int64_t offset) { return offset & -OutputBlock::page; }

} // namespace

OutputBlock::OutputBlock(std::int64_t offset, std::int64_t size, Array<char> memory)
    : memory_(memory.size() < size + 2 * page ? Array<char>(size + 2 * page) : std::move(memory)),
      offset_(offset), size_(size) {
  const std::int64_t start = reinterpret_cast<std::intptr_t>(memory_.begin());
  begin_ =
      memory_.begin() + (page_before(start + page - 1) - start) + (offset - page_before(offset));
}

OutputFile::OutputFile(const std::string& path) : name_(path), place_(follow_links(path)) {
  if (std::error_code error; fs::is_directory(place_, error))
    fail(EISDIR);
  if (!renameable(place_)) {
    descriptor_ = ::open(place_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    TemporaryFile file = open_temporary(place_);
    descriptor_ = file.descriptor, lock_ = file.lock;
    temporary_ = std::move(file.path);
  }
  if (descriptor_ < 0)
    fail(errno);
}

OutputFile::~OutputFile() {
  queue_.reset();
  if (!temporary_.empty())
    ::unlink(temporary_.c_str());
  for (const int descriptor : {direct_, descriptor_, lock_})
    if (descriptor >= 0)
      ::close(descriptor);
}

void OutputFile::watch(ProgressCallback progress, std::int64_t bytes) {
  if (!progress)
    return;
  progress_ = std::move(progress);
  monitor_ = std::make_unique<Monitor>(progress_);
  monitor_->begin("write", 1, bytes);
}

void OutputFile::append(std::string_view bytes) {
  if (monitor_)
    monitor_->step(static_cast<std::int64_t>(bytes.size()));
  while (!bytes.empty()) {
    if (temporary_.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written >= 0)
        bytes.remove_prefix(static_cast<std::size_t>(written));
      else if (errno != EINTR)
        fail(errno);
      continue;
    }
    if (tail_size_ == tail_.size())
      put_tail();
    const auto count = std::min(bytes.size(), static_cast<std::size_t>(tail_.size() - tail_size_));
    std::copy_n(bytes.data(), count, tail_.begin() + tail_size_);
    tail_size_ += static_cast<std::int64_t>(count);
    bytes.remove_prefix(count);
  }
}

void OutputFile::reserve([[maybe_unused]] std::int64_t size) {
#ifdef __linux__
  // Many file systems do not support fallocate; they allocate space when blocks are written.
  if (!temporary_.empty() && ::fallocate(descriptor_, 0, 0, size) != 0 &&
      (errno == ENOSPC || errno == EDQUOT || errno == EFBIG))
    fail(errno);
#endif
}

/// Writes the tail and begins the next one.
void OutputFile::put_tail() {
  const std::int64_t next = tail_.offset() + tail_size_;
  tail_.shorten(tail_size_);
  if (tail_size_ > 0)
    send(std::move(tail_));
  tail_ = block(next, tail_bytes);
  tail_size_ = 0;
}

void OutputFile::start_queue() {
#ifdef O_DIRECT
  direct_ = ::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC | O_DIRECT);
  {
    const std::lock_guard lock(spare_mutex_); // block() reads it concurrently
    spare_.reserve(most_spare);
  }
  if (direct_ >= 0)
    queue_ = std::make_unique<OutputQueue>([this](OutputBlock block) {
      const int error = write_direct(block);
      keep(block.take_memory());
      return error;
    });
#endif
}

void OutputFile::keep(Array<char> memory) {
  const std::lock_guard lock(spare_mutex_);
  if (spare_.size() < most_spare) // only if there is capacity, so that nothing is thrown
    spare_.push_back(std::move(memory));
}

OutputBlock OutputFile::block(std::int64_t offset, std::int64_t size) {
  Array<char> memory;
  if (const std::lock_guard lock(spare_mutex_); size >= least_direct && !spare_.empty()) {
    memory = std::move(spare_.back());
    spare_.pop_back();
  }
  return {offset, size, std::move(memory)};
}

void OutputFile::put(OutputBlock block) {
  if (monitor_)
    monitor_->step(block.size());
  send(std::move(block));
}

void OutputFile::send(OutputBlock block) {
  int error = 0;
  if (block.size() >= least_direct)
    std::call_once(queue_started_, [this] { start_queue(); });
  if (block.size() >= least_direct && queue_)
    error = queue_->push(std::move(block));
  else
    error = write_through_cache(block.offset(), block.bytes());
  if (error != 0)
    fail(error);
}

int OutputFile::write_through_cache(std::int64_t offset, std::string_view bytes) const {
  return pwrite_all(descriptor_, offset, bytes);
}

/// Writes whole pages from memory to the disk; the parts of the first and the last page go through
/// the page cache, where they meet the parts of neighbouring blocks.
int OutputFile::write_direct(const OutputBlock& block) {
  const std::int64_t end = block.offset() + block.size(),
                     first = page_before(block.offset() + OutputBlock::page - 1),
                     last = page_before(end);
  const auto part = [&](std::int64_t from, std::int64_t to) {
    return block.bytes().substr(static_cast<std::size_t>(from - block.offset()),
                                static_cast<std::size_t>(to - from));
  };
  int error = pwrite_all(direct_, first, part(first, last));
  if (error == EINVAL) // the file system opens files for direct output but does not write them
    error = write_through_cache(first, part(first, last));
  if (error == 0)
    error = write_through_cache(block.offset(), part(block.offset(), first));
  return error != 0 ? error : write_through_cache(last, part(last, end));
}

void OutputFile::finish() {
  if (descriptor_ < 0)
    return;
  if (tail_size_ > 0)
    put_tail();
  if (queue_)
    if (const int error = queue_->finish(); error != 0)
      fail(error);
  // A device or a pipe needs no synchronisation.
  if (!temporary_.empty() && ::fsync(descriptor_) != 0)
    fail(errno);
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0)
    fail(errno);
}

void OutputFile::commit() {
  finish();
  if (!temporary_.empty() && ::rename(temporary_.c_str(), place_.c_str()) != 0)
    fail(errno);
  temporary_.clear();
}

void OutputFile::fail(int error) const {
  throw Error(ErrorCode::file, "cannot write " + name_ + ": " + describe(error));
}

void require_regular_output(const std::string& path) {
  if (!renameable(path) && !fs::is_directory(path))
    throw Error(ErrorCode::file,
                "cannot write " + path +
                    ": it is not a regular file, and the format is not written from "
                    "front to back; give the name of a file");
}

void require_no_folder(const std::string& path) {
  if (std::error_code error; fs::is_directory(path, error))
    throw Error(ErrorCode::file,
                "cannot read " + path + ": it is a folder; give the name of a file");
}

void refuse_input(const std::string& path, int error) {
  throw Error(ErrorCode::file, "cannot read " + path + ": " +
                                   std::generic_category().message(error) +
                                   "; check its name and its permissions");
}

std::ifstream open_input(const std::string& path) {
  require_no_folder(path);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    refuse_input(path, errno);
  return in;
}

std::size_t bytes_left(std::istream& in) {
  const std::istream::pos_type here = in.tellg();
  in.seekg(0, std::ios::end);
  const std::istream::pos_type end = in.tellg();
  in.clear();
  if (here < 0 || end < here)
    return 0;
  in.seekg(here);
  return static_cast<std::size_t>(end - here);
}

void require_whole(std::size_t read, std::size_t at_first, const std::string& name) {
  if (read < at_first)
    throw Error(ErrorCode::file,
                "cannot read " + name + ": it became shorter; check which program writes it");
}

void read_some(std::istream& in, char* bytes, std::int64_t size, const std::string& name) {
  in.read(bytes, size);
  if (in.bad())
    throw Error(ErrorCode::file, "cannot read " + name + ": the disk or the network failed");
}

std::string read_all(std::istream& in, const std::string& name, StartCheck check_start) {
  constexpr std::size_t chunk = std::size_t{1} << 20;
  const std::size_t at_first = bytes_left(in);
  std::string bytes(chunk, '\0');
  std::size_t size = 0;
  const auto read_more = [&] {
    read_some(in, bytes.data() + size, static_cast<std::int64_t>(bytes.size() - size), name);
    size += static_cast<std::size_t>(in.gcount());
  };
  read_more();
  if (check_start)
    check_start({bytes.data(), size}, name);
  bytes.reserve(at_first + chunk);
  while (in) {
    if (bytes.size() - size < chunk)
      bytes.resize(std::max(2 * bytes.size(), bytes.capacity()));
    read_more();
  }
  require_whole(size, at_first, name);
  bytes.resize(size);
  return bytes;
}

} // namespace io_detail

std::string read_file(const std::string& path) {
  std::ifstream in = io_detail::open_input(path);
  return io_detail::read_all(in, path);
}

void write_file(const std::string& path, std::string_view bytes) {
  io_detail::OutputFile file(path);
  file.append(bytes);
  file.commit();
}

} // namespace calotte
