// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/font.h"

#include "draw/font_bytes.h"

#include <cairo-ft.h>

#include <stdexcept>

namespace calotte::tools {

namespace {

/// The face lives as long as the program.
cairo_font_face_t* load_face() {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  if (FT_Init_FreeType(&library) != 0 ||
      FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(font_bytes.data()),
                         static_cast<FT_Long>(font_bytes.size()), 0, &face) != 0)
    throw std::runtime_error(
        "the command's font cannot be read; build it with another CALOTTE_FONT");
  return cairo_ft_font_face_create_for_ft_face(face, 0);
}

} // namespace

void set_font(cairo_t* context, double size, bool italic) {
  static cairo_font_face_t* const face = load_face();
  constexpr double slope = 0.2; // of the upright strokes of italic letters
  cairo_matrix_t matrix;
  cairo_matrix_init(&matrix, size, 0, italic ? -slope * size : 0, size, 0, 0);
  cairo_set_font_face(context, face);
  cairo_set_font_matrix(context, &matrix);
}

} // namespace calotte::tools
