// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/files.h"

#include <calotte/mesh_file.h>

#include <doctest/doctest.h>

#include <string>

/// Files of text and what the library reads in them.
namespace calotte::test {

inline MeshFile read_text(const std::string& path, const std::string& text) {
  write_text(path, text);
  return read_mesh_file(path);
}

/// The message of the error in which reading ends; it starts with the path.
inline std::string problem_of(const std::string& path, const std::string& text) {
  const Error error = error_of([&] { read_text(path, text); });
  CHECK(error.code() == ErrorCode::parse);
  CHECK(std::string(error.what()).starts_with(path + ": "));
  return error.what();
}

} // namespace calotte::test
