// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/errors.h"
#include "support/sanitizer.h"

#include <calotte/error.h>
#include <calotte/mesh.h>

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include <unistd.h>

/// Common code of the tests of files.
namespace calotte::test {

/// A temporary folder, removed at the end of the test.
struct Scratch {
  std::filesystem::path folder;
  explicit Scratch(const std::filesystem::path& parent = std::filesystem::temp_directory_path()) {
    std::string name = parent / "calotte-test-XXXXXX";
    folder = ::mkdtemp(name.data());
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(folder); }
  std::string operator/(const std::string& name) const { return folder / name; }
  std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder),
                         std::filesystem::directory_iterator());
  }
};

inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// From one byte of a file to the next at which a test cuts or damages it.
inline constexpr std::size_t cut_step = sanitized ? 5 : 1;

/// Truncates a file at every length, except for the last byte, and checks that the function either
/// throws an Error or succeeds.
/// \returns the number of successes. The file is complete again at the end.
inline int done_when_cut(const std::string& path, const std::function<void()>& work) {
  const std::string whole = read_file(path);
  int done = 0;
  for (std::size_t size = 0; size + 1 < whole.size(); size += cut_step) {
    std::filesystem::remove(path); // some file systems synchronise a file that is overwritten
    write_text(path, whole.substr(0, size));
    INFO("cut to ", size, " bytes");
    try {
      work();
      ++done;
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find('\n') == std::string::npos);
    }
  }
  write_text(path, whole);
  return done;
}

} // namespace calotte::test
