// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"
#include "io/bytes/file.h"
#include "io/bytes/output_queue.h"
#include "support/files.h"
#include "support/full_disk.h"
#include "support/text.h"

#include <calotte/error.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace fs = std::filesystem;
using calotte::Error;
using calotte::ErrorCode;
using calotte::io_detail::OutputBlock;
using calotte::io_detail::OutputFile;
using calotte::io_detail::OutputQueue;
using calotte::test::has;
using calotte::test::Scratch;

namespace {

/// On a disk, and on a file system in memory, which may have a page cache alone.
std::vector<fs::path> parents() {
  std::vector<fs::path> all{fs::temp_directory_path()};
  if (fs::is_directory("/dev/shm"))
    all.emplace_back("/dev/shm");
  return all;
}

char byte_at(std::int64_t i) { return static_cast<char>(i * 2654435761 >> 13); }

std::string bytes_to(std::int64_t size) {
  std::string bytes(static_cast<std::size_t>(size), ' ');
  for (std::int64_t i = 0; i < size; ++i)
    bytes[static_cast<std::size_t>(i)] = byte_at(i);
  return bytes;
}

/// Puts the bytes between consecutive cuts, each a task of its own, the last first. Blocks are
/// fresh or may stand where others stood.
void put_pieces(OutputFile& file, const std::vector<std::int64_t>& cuts, bool fresh = false) {
  const auto pieces = static_cast<std::int64_t>(cuts.size()) - 1;
  calotte::base_detail::for_each_task(pieces, [&](std::int64_t k) {
    const auto piece = static_cast<std::size_t>(pieces - 1 - k);
    const std::int64_t size = cuts[piece + 1] - cuts[piece];
    OutputBlock block = fresh ? OutputBlock(cuts[piece], size) : file.block(cuts[piece], size);
    for (std::int64_t i = 0; i < block.size(); ++i)
      block.begin()[i] = byte_at(block.offset() + i);
    file.put(std::move(block));
  });
}

/// Of blocks large and small, whose ends are those of pages, beside them, and anywhere.
std::vector<std::int64_t> uneven_cuts() {
  std::vector<std::int64_t> cuts{0, 4096, 4096 + 300'000, 1 << 20, (1 << 20) + 1};
  for (int k = 0; k < 20; ++k)
    cuts.push_back(cuts.back() + 262'144 + 37 * k);
  for (const std::int64_t step : {1, 4095, 4097, 5'000'000, 262'143})
    cuts.push_back(cuts.back() + step);
  return cuts;
}

std::string message_of_file_error(const std::function<void()>& work) {
  const Error error = calotte::test::error_of(work);
  CHECK(error.code() == ErrorCode::file);
  return error.what();
}

} // namespace

TEST_CASE("a block has the same alignment in memory as in the file") {
  for (const std::int64_t offset : {0, 1, 4095, 4096, 123'457}) {
    OutputBlock block(offset, 10'000);
    CHECK(block.size() == 10'000);
    CHECK((reinterpret_cast<std::intptr_t>(block.begin()) - offset) % OutputBlock::page == 0);
    std::fill_n(block.begin(), 10'000, 'x'); // the sanitizers watch
  }
}

TEST_CASE("blocks of any size, put in any order from any thread, become one file") {
  const std::vector<std::int64_t> cuts = uneven_cuts();
  const std::string expected = bytes_to(cuts.back());
  for (const fs::path& parent : parents())
    for (const int threads : {1, 2, 5}) {
      CAPTURE(parent.string());
      const Scratch scratch(parent);
      OutputFile file(scratch / "a");
      tbb::task_arena(threads).execute([&] { put_pieces(file, cuts); });
      CHECK(!fs::exists(scratch / "a"));
      file.commit();
      CHECK(scratch.files() == 1);
      CHECK((calotte::test::read_file(scratch / "a") == expected));
    }
}

TEST_CASE("room that is reserved, and memory of blocks that are written, change no byte") {
  const std::vector<std::int64_t> cuts = uneven_cuts();
  const std::string expected = bytes_to(cuts.back());
  for (const fs::path& parent : parents())
    for (const bool fresh : {false, true}) {
      CAPTURE(parent.string());
      const Scratch scratch(parent);
      OutputFile file(scratch / "a");
      file.reserve(cuts.back());
      put_pieces(file, cuts, fresh);
      file.commit();
      CHECK((calotte::test::read_file(scratch / "a") == expected));
    }
  OutputFile device("/dev/null");
  device.reserve(1 << 20); // has no room to reserve
}

TEST_CASE("a reservation larger than the disk fails before anything is written") {
  for (const fs::path& parent : parents()) {
    CAPTURE(parent.string());
    const Scratch scratch(parent);
    {
      OutputFile file(scratch / "a");
      CHECK(has(message_of_file_error([&] { file.reserve(std::int64_t{1} << 60); }), "make room"));
    }
    CHECK(scratch.files() == 0);
  }
}

TEST_CASE("pieces of any size are appended in order") {
  const std::string expected = bytes_to(13'000'001);
  for (const fs::path& parent : parents())
    for (const std::size_t step : {std::size_t{977'777}, std::size_t{4 << 20}, expected.size()}) {
      const Scratch scratch(parent);
      OutputFile file(scratch / "a");
      for (std::size_t i = 0; i < expected.size(); i += step)
        file.append(std::string_view(expected).substr(i, step));
      file.commit();
      CHECK((calotte::test::read_file(scratch / "a") == expected));
    }
}

TEST_CASE("a disk that fills up at any block keeps the old file and removes the new one") {
  const std::vector<std::int64_t> cuts = uneven_cuts();
  const std::string bytes = bytes_to(cuts.back());
  for (const fs::path& parent : parents()) {
    const Scratch scratch(parent);
    calotte::io_detail::OutputFile old(scratch / "a");
    old.append("old");
    old.commit();
    const std::string expected =
        "cannot write " + (scratch / "a") + ": File too large; make room or write elsewhere";
    for (const std::int64_t room : {std::int64_t{0}, cuts[2] - 5, cuts[10], cuts.back() - 1}) {
      const calotte::test::FullDisk full(static_cast<rlim_t>(room));
      CHECK(message_of_file_error([&] {
              OutputFile file(scratch / "a");
              put_pieces(file, cuts);
              file.commit();
            }) == expected);
      CHECK(message_of_file_error([&] {
              OutputFile file(scratch / "a");
              file.append(bytes);
              file.commit();
            }) == expected);
      CHECK(scratch.files() == 1);
      CHECK(calotte::test::read_file(scratch / "a") == "old");
    }
  }
}

TEST_CASE("a file abandoned while blocks wait leaves nothing") {
  const Scratch scratch(fs::temp_directory_path());
  {
    OutputFile file(scratch / "a");
    put_pieces(file, uneven_cuts());
  }
  CHECK(scratch.files() == 0);
}

TEST_CASE("the queue writes each block once and reports the first failure") {
  std::atomic<std::int64_t> sum = 0;
  OutputQueue right([&](const OutputBlock& block) {
    sum += block.offset();
    return 0;
  });
  for (std::int64_t k = 1; k <= 1000; ++k)
    CHECK(right.push(OutputBlock(k, 1)) == 0);
  CHECK(right.finish() == 0);
  CHECK(sum == 500'500);

  std::atomic<int> writes = 0;
  OutputQueue wrong([&](const OutputBlock& block) {
    ++writes;
    return block.offset() == 20 ? ENOSPC : 0;
  });
  int error = 0;
  for (std::int64_t k = 0; k < 1000; ++k)
    error = std::max(error, wrong.push(OutputBlock(k, 1)));
  CHECK(error == ENOSPC);
  CHECK(wrong.finish() == ENOSPC);
  CHECK(wrong.push(OutputBlock(0, 1)) == ENOSPC);
  CHECK(writes >= 21);
  CHECK(writes < 40); // at most those that waited or were being pushed
}

TEST_CASE("temporary files that killed processes left are removed, and no other file") {
  for (const fs::path& parent : parents()) {
    CAPTURE(parent.string());
    const Scratch scratch(parent);
    const std::vector<std::string> left{"a.part1-0", "a.part1-1", "a.part4194304-17"};
    const std::vector<std::string> others{"b.part1-0",  "a.part",     "a.part1",   "a.part-1",
                                          "a.part1-",   "a.part1-x",  "a.partial", "xa.part1-0",
                                          "a.part1-0~", "a.part1-0-1"};
    for (const auto* names : {&left, &others})
      for (const std::string& name : *names)
        calotte::test::write_text(scratch / name, "left");
    fs::create_directory(scratch / "a.part2-0");
    OutputFile(scratch / "a").commit();
    for (const std::string& name : left)
      CHECK(!fs::exists(scratch / name));
    for (const std::string& name : others)
      CHECK(calotte::test::read_file(scratch / name) == "left");
    CHECK(scratch.files() == std::ssize(others) + 2);
  }
}

TEST_CASE("two writers of one target do not disturb each other, even between finish and commit") {
  for (const fs::path& parent : parents()) {
    CAPTURE(parent.string());
    const Scratch scratch(parent);
    OutputFile first(scratch / "a");
    OutputFile second(scratch / "a");
    first.append("first");
    second.append("second");
    first.finish();
    OutputFile(scratch / "a").commit();
    first.commit();
    CHECK(calotte::test::read_file(scratch / "a") == "first");
    second.commit();
    CHECK(calotte::test::read_file(scratch / "a") == "second");
    CHECK(scratch.files() == 1);
  }
}
