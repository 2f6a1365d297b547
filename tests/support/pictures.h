// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/scale.h"
#include "support/errors.h"

#include <cairo.h>
#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

/// Tools for tests that write pictures and read them back.
namespace calotte::test {

namespace fs = std::filesystem;

/// A temporary folder, removed at the end of the test.
struct Folder {
  Folder() : path(fs::temp_directory_path() / ("calotte-draw-" + std::to_string(getpid()))) {
    fs::remove_all(path);
    fs::create_directory(path);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path); }
  std::string file(const std::string& name) const { return (path / name).string(); }
  std::ptrdiff_t count() const {
    return std::distance(fs::directory_iterator(path), fs::directory_iterator());
  }
  fs::path path;
};

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A PNG file, read back.
struct Picture {
  explicit Picture(const std::string& path)
      : surface(cairo_image_surface_create_from_png(path.c_str())) {
    REQUIRE(cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS);
  }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  ~Picture() { cairo_surface_destroy(surface); }
  int width() const { return cairo_image_surface_get_width(surface); }
  int height() const { return cairo_image_surface_get_height(surface); }
  std::uint32_t at(int x, int y) const {
    REQUIRE((x >= 0 && y >= 0 && x < width() && y < height()));
    const auto* row = cairo_image_surface_get_data(surface) +
                      static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(surface);
    return reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff;
  }
  cairo_surface_t* surface;
};

inline std::uint32_t packed(const tools::Rgb& c) {
  const auto byte = [](double x) { return static_cast<std::uint32_t>(std::lround(255 * x)); };
  return byte(c.r) << 16 | byte(c.g) << 8 | byte(c.b);
}

/// True if a pixel has a colour, up to rounding.
inline bool has_colour(std::uint32_t pixel, const tools::Rgb& colour) {
  const std::uint32_t expected = packed(colour);
  for (const int shift : {0, 8, 16}) {
    const auto channel = [shift](std::uint32_t c) { return static_cast<int>(c >> shift & 0xff); };
    if (std::abs(channel(pixel) - channel(expected)) > 2) {
      return false;
    }
  }
  return true;
}

} // namespace calotte::test
