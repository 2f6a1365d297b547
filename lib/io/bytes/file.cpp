// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"

#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/bytes/output_queue.h"
#include "io/bytes/temporary_file.h"
#include "io/command.h"

#include <calotte/read.h>
#include <calotte/write.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace calotte {
namespace io_detail {
namespace {

namespace fs = std::filesystem;

std::string describe_error(int error) {
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

bool renameable(const fs::path& target) {
  std::error_code absent;
  const fs::file_status status = fs::status(target, absent);
  return !fs::exists(status) || fs::is_regular_file(status);
}

fs::path follow_links(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error))
    return path;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? fs::path(path) : target;
}

/// Smallest block for direct output; smaller blocks gain nothing from it.
constexpr std::int64_t least_direct = 1 << 18;
/// Maximum number of spare blocks; more than are being filled or written at once.
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

OutputFile::OutputFile(const std::string& path) : name_(path), target_(follow_links(path)) {
  if (std::error_code error; fs::is_directory(target_, error))
    fail(EISDIR);
  if (!renameable(target_)) {
    file_ = Descriptor::to_write(target_);
    require(file_ ? 0 : errno);
  } else {
    TemporaryFile file = open_temporary(target_);
    require(file.error);
    file_ = std::move(file.file), lock_ = std::move(file.lock);
    temporary_ = std::move(file.path);
  }
}

OutputFile::~OutputFile() {
  queue_.reset();
  if (!temporary_.empty())
    remove_file(temporary_);
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
  if (temporary_.empty()) {
    require(file_.append(bytes));
    return;
  }
  while (!bytes.empty()) {
    if (tail_size_ == tail_.size())
      put_tail();
    const auto count = std::min(bytes.size(), static_cast<std::size_t>(tail_.size() - tail_size_));
    std::copy_n(bytes.data(), count, tail_.begin() + tail_size_);
    tail_size_ += static_cast<std::int64_t>(count);
    bytes.remove_prefix(count);
  }
}

void OutputFile::reserve(std::int64_t size) {
  if (!temporary_.empty())
    require(file_.reserve(size));
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
  direct_ = Descriptor::to_write_direct(temporary_);
  {
    const std::lock_guard lock(spare_mutex_); // block() reads it concurrently
    spare_.reserve(most_spare);
  }
  if (direct_)
    queue_ = std::make_unique<OutputQueue>([this](OutputBlock block) {
      const int error = write_direct(block);
      keep(block.take_memory());
      return error;
    });
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
  if (block.size() >= least_direct)
    std::call_once(queue_started_, [this] { start_queue(); });
  if (block.size() >= least_direct && queue_)
    require(queue_->push(std::move(block)));
  else
    require(file_.write(block.offset(), block.bytes()));
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
  int error = direct_.write(first, part(first, last));
  if (error == EINVAL) // the file system opens files for direct output but does not write them
    error = file_.write(first, part(first, last));
  if (error == 0)
    error = file_.write(block.offset(), part(block.offset(), first));
  return error != 0 ? error : file_.write(last, part(last, end));
}

void OutputFile::finish() {
  if (!file_)
    return;
  if (tail_size_ > 0)
    put_tail();
  if (queue_)
    require(queue_->finish());
  // A device or a pipe needs no synchronisation.
  if (!temporary_.empty())
    require(file_.synchronise());
  require(file_.close());
}

void OutputFile::commit() {
  finish();
  if (!temporary_.empty())
    require(rename_file(temporary_, target_));
  temporary_.clear();
}

void OutputFile::require(int error) const {
  if (error != 0)
    fail(error);
}

void OutputFile::fail(int error) const { fail_write(name_, describe_error(error)); }

void require_regular_output(const std::string& path) {
  if (!renameable(path) && !fs::is_directory(path))
    fail_write(path, "it is not a regular file, and the format is not written from front to back; "
                     "give the name of a file");
}

void require_no_folder(const std::string& path) {
  if (std::error_code error; fs::is_directory(path, error))
    fail_read(path, "it is a folder; give the name of a file");
}

void refuse_input(const std::string& path, int error) {
  fail_read(path, std::generic_category().message(error) + "; check its name and its permissions");
}

namespace {

std::ifstream open_any(const std::string& path) {
  require_no_folder(path);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in)
    refuse_input(path, errno);
  return in;
}

} // namespace

std::ifstream open_input(const std::string& path) {
  std::ifstream in = open_any(path);
  refuse_foreign(path);
  return in;
}

std::ifstream open_geometries(const std::string& path) {
  return is_shapefile(path) ? open_any(path) : open_input(path);
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
    fail_read(name, "it became shorter; check which program writes it");
}

void read_some(std::istream& in, char* bytes, std::int64_t size, const std::string& name) {
  in.read(bytes, size);
  if (in.bad())
    fail_read(name, "the disk or the network failed");
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
  std::ifstream in = io_detail::open_any(path);
  return io_detail::read_all(in, path);
}

void write_file(const std::string& path, std::string_view bytes) {
  io_detail::OutputFile file(path);
  file.append(bytes);
  file.commit();
}

} // namespace calotte
