// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/picture.h"

#include "io/command.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/write.h>

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <memory>
#include <string>

namespace calotte::tools {

namespace {

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using CairoContext = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// Receives bytes from Cairo's C code, which exceptions must not cross: an exception is stored
/// until the call returns.
struct Stream {
  std::string bytes;
  std::exception_ptr failure;

  static cairo_status_t write(void* closure, const unsigned char* data, unsigned int length) {
    auto& stream = *static_cast<Stream*>(closure);
    try {
      stream.bytes.append(reinterpret_cast<const char*>(data), length);
      return CAIRO_STATUS_SUCCESS;
    } catch (...) {
      stream.failure = std::current_exception();
      return CAIRO_STATUS_WRITE_ERROR;
    }
  }
  void check(cairo_status_t status, const std::string& path) const {
    if (failure) {
      std::rethrow_exception(failure);
    }
    if (status != CAIRO_STATUS_SUCCESS) {
      throw Error(ErrorCode::file, message("{}: the picture cannot be made: {}; try a smaller size",
                                           path, cairo_status_to_string(status)));
    }
  }
};

CairoSurface surface_for(PictureFormat format, int width, int height, Stream& stream) {
  cairo_surface_t* surface = nullptr;
  if (format == PictureFormat::png) {
    surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  } else if (format == PictureFormat::svg) {
    surface = cairo_svg_surface_create_for_stream(Stream::write, &stream, width, height);
  } else {
    surface = cairo_pdf_surface_create_for_stream(Stream::write, &stream, width, height);
  }
  return {surface, cairo_surface_destroy};
}

} // namespace

PictureFormat picture_format(const std::string& path, const std::string& other) {
  const std::size_t dot = path.find_last_of("./");
  std::string suffix = dot == std::string::npos || path[dot] == '/' ? "" : path.substr(dot);
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == ".png") {
    return PictureFormat::png;
  }
  if (suffix == ".svg") {
    return PictureFormat::svg;
  }
  if (suffix == ".pdf") {
    return PictureFormat::pdf;
  }
  refuse_path(path, "the suffix names no picture format; use .png, .svg{}",
              other.empty() ? " or .pdf" : ", .pdf or " + other);
}

void require_picture(const std::string& path, int width) {
  picture_format(path);
  if (width < 64 || width > 16384) {
    refuse(message("a picture is 64 to 16384 pixels wide, not {}", width));
  }
}

void write_picture(const std::string& path, int width, int height,
                   const std::function<void(cairo_t*)>& paint) {
  require_picture(path, width);
  const PictureFormat format = picture_format(path);
  Stream stream{};
  const CairoSurface surface = surface_for(format, width, height, stream);
  {
    const CairoContext context(cairo_create(surface.get()), cairo_destroy);
    cairo_set_source_rgb(context.get(), 1, 1, 1);
    cairo_paint(context.get());
    paint(context.get());
    stream.check(cairo_status(context.get()), path);
  }
  cairo_status_t status = CAIRO_STATUS_SUCCESS;
  if (format == PictureFormat::png) {
    status = cairo_surface_write_to_png_stream(surface.get(), Stream::write, &stream);
  } else {
    cairo_surface_finish(surface.get());
    status = cairo_surface_status(surface.get());
  }
  stream.check(status, path);
  write_file(path, stream.bytes);
}

} // namespace calotte::tools
