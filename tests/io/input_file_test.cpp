// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "support/files.h"

#include <calotte/error.h>

#include <doctest/doctest.h>

#include <cstddef>
#include <sstream>
#include <streambuf>
#include <string>
#include <string_view>

using calotte::Error;
using calotte::ErrorCode;
using calotte::io_detail::read_all;

namespace {

constexpr std::size_t mib = std::size_t{1} << 20;

std::string sample(std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<char>(i % 251);
  return bytes;
}

/// A stream without positions, as a pipe.
class Pipe : public std::stringbuf {
public:
  explicit Pipe(const std::string& bytes) : std::stringbuf(bytes, std::ios::in) {}

private:
  pos_type seekoff(off_type, std::ios::seekdir, std::ios::openmode) override {
    return {off_type{-1}};
  }
  pos_type seekpos(pos_type, std::ios::openmode) override { return {off_type{-1}}; }
};

void refuse(std::string_view start, const std::string& name) {
  throw Error(ErrorCode::parse, name + ": " + std::to_string(start.size()));
}

} // namespace

TEST_CASE("a stream is read whole, whatever its size and whether it has positions") {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, mib - 1, mib, mib + 1, 2 * mib, 3 * mib + 5}) {
    CAPTURE(size);
    const std::string bytes = sample(size);
    std::istringstream file(bytes);
    CHECK(read_all(file, "a") == bytes);
    Pipe buffer(bytes);
    std::istream pipe(&buffer);
    CHECK(read_all(pipe, "a") == bytes);
  }
}

TEST_CASE("the rest of a stream is read after its first bytes are accepted") {
  std::istringstream file(sample(3 * mib));
  const Error error = calotte::test::error_of([&] { read_all(file, "a.ply", refuse); });
  CHECK(error.what() == "a.ply: " + std::to_string(mib));
  CHECK(file.tellg() == std::istream::pos_type(mib));
}
