// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/picture_density.h"

#include "io/command.h"
#include "text/text.h"

#include <png.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace calotte::tools {
namespace {

constexpr std::int64_t most_pixels = 100'000'000;

/// libpng's reader of pictures in memory.
class Png {
public:
  explicit Png(const std::string& path) : path_(path), bytes_(read_file(path)) {
    image_.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image_, bytes_.data(), bytes_.size()) == 0)
      refuse();
    if (image_.width < 2 || image_.height < 2 || width() * height() > most_pixels)
      refuse_path(path_, "the picture has {} x {} pixels; give one of 2 x 2 to {} pixels", width(),
                  height(), most_pixels);
  }
  ~Png() { png_image_free(&image_); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;

  std::int64_t width() const { return image_.width; }
  std::int64_t height() const { return image_.height; }

  /// Row by row from the top: 0 is black, 255 white.
  std::vector<std::uint8_t> read_greys() {
    constexpr png_color white{255, 255, 255};
    image_.format = PNG_FORMAT_GRAY;
    image_.flags |= PNG_IMAGE_FLAG_16BIT_sRGB; // as viewers see 16 bits without a gamma
    std::vector<std::uint8_t> greys(static_cast<std::size_t>(width() * height()));
    if (png_image_finish_read(&image_, &white, greys.data(), 0, nullptr) == 0)
      refuse();
    return greys;
  }

private:
  [[noreturn]] void refuse() const {
    refuse_path(path_, "it is no PNG, or is damaged ({}); make it again",
                std::string(static_cast<const char*>(image_.message)));
  }

  std::string path_, bytes_;
  png_image image_{};
};

} // namespace

bool is_picture(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension();
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return std::tolower(c); });
  return suffix == ".png";
}

std::string rectangle_of_picture(const std::string& path) {
  const Png png(path);
  return message("0,0,{},{}", png.width(), png.height());
}

Raster read_picture(const std::string& path) {
  Png png(path);
  const std::vector<std::uint8_t> greys = png.read_greys();
  if (std::ranges::all_of(greys, [](std::uint8_t grey) { return grey == 255; }))
    refuse_path(path, "the picture is white everywhere, so it has no dark part for generators; "
                      "give another");
  const auto middles = [](std::int64_t count) -> DoubleVector {
    return DoubleVector::LinSpaced(count, 0.5, static_cast<double>(count) - 0.5);
  };
  Raster raster{middles(png.width()), middles(png.height()), {}, true};
  raster.values.resize(png.width(), png.height());
  auto grey = greys.begin();
  for (std::int64_t row = png.height(); row-- > 0;)
    for (std::int64_t column = 0; column < png.width(); ++column) {
      const double darkness = std::max(255 - *grey++, 1) / 255.0;
      raster.values(column, row) = darkness * darkness;
    }
  return raster;
}

} // namespace calotte::tools
