// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/text.h"

#include "draw/font.h"
#include "text/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::tools {

namespace {

constexpr double small_letters = 0.72; ///< of raised and lowered ones, of the others' size

/// A piece of marked text.
struct Piece {
  std::string text;
  bool italic = false;
  int level = 0; ///< 1 raised, -1 lowered
};

std::vector<Piece> pieces_of(const std::string& text) {
  std::vector<Piece> pieces(1);
  const auto begin = [&](bool italic, int level) { pieces.push_back({"", italic, level}); };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Piece& last = pieces.back();
    if (text[i] == '*') {
      begin(!last.italic, last.level);
    } else if ((text[i] == '^' || text[i] == '_') && i + 1 < text.size() && text[i + 1] == '{') {
      begin(last.italic, text[i] == '^' ? 1 : -1);
      ++i;
    } else if (text[i] == '}') {
      begin(last.italic, 0);
    } else {
      pieces.back().text += text[i];
    }
  }
  return pieces;
}

/// Sets the font of the piece and returns its length.
double select_for(cairo_t* context, const Piece& piece, double size) {
  set_font(context, piece.level == 0 ? size : small_letters * size, piece.italic);
  return text_width(context, piece.text);
}

double font_size(cairo_t* context) {
  cairo_matrix_t matrix;
  cairo_get_font_matrix(context, &matrix);
  return matrix.xx;
}

} // namespace

void set_colour(cairo_t* context, const Rgb& colour) {
  cairo_set_source_rgb(context, colour.r, colour.g, colour.b);
}

void select_font(cairo_t* context, double size) {
  // Widths that grow with the size: of hinted letters each is a whole number of pixels, so that a
  // line that was measured in one size does not fit in another.
  cairo_font_options_t* const options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
  set_font(context, size);
}

double text_width(cairo_t* context, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  return extents.x_advance;
}

void centred_text(cairo_t* context, double x, double baseline, const std::string& text) {
  cairo_move_to(context, x - text_width(context, text) / 2, baseline);
  cairo_show_text(context, text.c_str());
}

void fitted_text(cairo_t* context, double x, double baseline, const std::string& text, double size,
                 double room) {
  select_font(context, size);
  select_font(context, size * std::min(1.0, room / std::max(marked_width(context, text), 1e-9)));
  marked_text(context, x, baseline, text, 0.5);
}

std::string grouped(std::int64_t number) {
  std::string text = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), "\u2009");
  }
  return text;
}

std::string with_minus(const std::string& text) {
  return text.starts_with('-') ? "\u2212" + text.substr(1) : text;
}

std::string power_of_ten(int exponent) {
  return "10^{" + with_minus(std::to_string(exponent)) + "}";
}

std::string number_text(double value, int digits) {
  std::string text =
      with_minus(formatted(("%." + std::to_string(digits) + "g").c_str(), value + 0.0)); // no -0
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    const std::string factor = text.substr(0, e);
    const bool one = factor == "1" || factor == "\u22121";
    text = (one ? factor.substr(0, factor.size() - 1) : factor + "\u2009\u00d7\u2009") +
           power_of_ten(std::stoi(text.substr(e + 1)));
  }
  return text;
}

std::string shown(const std::string& name) {
  const std::string quoted =
      nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(quoted).get<std::string>();
}

std::string unmarked(const std::string& text) {
  std::string result = shown(text);
  std::erase_if(result, [](char c) { return c == '*' || c == '{' || c == '}'; });
  return result;
}

bool is_unit(const std::string& units) {
  static constexpr std::array<std::string_view, 6> none = {"",     "1",        "-",
                                                           "none", "unitless", "dimensionless"};
  return std::find(none.begin(), none.end(), units) == none.end();
}

std::string unit_text(const std::string& units) {
  static const std::regex negative("\\b([A-Za-z]+)-([0-9]+)\\b");
  static const std::regex positive("\\b([A-Za-z]+)([0-9]+)\\b");
  const std::string text = std::regex_replace(unmarked(units), negative, "$1^{\u2212$2}");
  return std::regex_replace(text, positive, "$1^{$2}");
}

double marked_width(cairo_t* context, const std::string& text) {
  const double size = font_size(context);
  double width = 0;
  for (const Piece& piece : pieces_of(text)) {
    width += select_for(context, piece, size);
  }
  select_font(context, size);
  return width;
}

double marked_text(cairo_t* context, double x, double baseline, const std::string& text,
                   double align) {
  const double size = font_size(context);
  x -= align * marked_width(context, text);
  for (const Piece& piece : pieces_of(text)) {
    const double width = select_for(context, piece, size);
    const double rise = piece.level > 0 ? 0.4 * size : piece.level < 0 ? -0.2 * size : 0;
    cairo_move_to(context, x, baseline - rise);
    cairo_show_text(context, piece.text.c_str());
    x += width;
  }
  select_font(context, size);
  return x;
}

} // namespace calotte::tools
