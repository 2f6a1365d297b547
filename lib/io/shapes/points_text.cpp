// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/points_text.h"
#include "base/lonlat.h"
#include "base/points.h"
#include "io/bytes/file.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <optional>
#include <ostream>

namespace calotte {
namespace {

using io_detail::Columned;
using io_detail::LineReader;
using io_detail::Outcome;

/// What stands in a line.
struct LineFormat {
  int columns;
  std::string expected; ///< what to write in a line, for messages
  std::string perhaps;  ///< a remedy where a column is missing, or empty
  const char* use;      ///< what a non-finite number does not give, for messages
  void (*require)(const LineReader&, const double*);
  void (*append)(std::vector<double>&, const double*);
};

void require_direction(const LineReader& reader, const double* values) {
  if (values[0] == 0 && values[1] == 0 && values[2] == 0)
    reader.fail("the zero vector has no direction; remove the point or correct it");
}

void require_latitude(const LineReader& reader, const double* values) {
  if (std::abs(values[1]) <= 90)
    return;
  char latitude[32];
  std::snprintf(latitude, sizeof latitude, "%g", values[1]);
  reader.fail("latitude " + std::string(latitude) +
              " is outside -90 to 90; write longitude first, then latitude, in degrees");
}

void append_lonlat(std::vector<double>& coordinates, const double* values) {
  const base_detail::Vec3 p = base_detail::from_lonlat(values[0], values[1]);
  coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
}

void append_xyz(std::vector<double>& coordinates, const double* values) {
  coordinates.insert(coordinates.end(), values, values + 3);
}

void append_xy(std::vector<double>& coordinates, const double* values) {
  coordinates.insert(coordinates.end(), {values[0], values[1], 0});
}

LineFormat line_format(Columns columns) {
  if (columns == Columns::lonlat)
    return {2,
            "write longitude and latitude in degrees on each line",
            "",
            "direction",
            require_latitude,
            append_lonlat};
  if (columns == Columns::xy)
    return {2,       "write two numbers x y on each line",    "",
            "place", [](const LineReader&, const double*) {}, append_xy};
  return {3,
          "write three numbers x y z on each line",
          ", or read them as longitude and latitude, or as places in a plane",
          "direction",
          require_direction,
          append_xyz};
}

[[noreturn]] void refuse_line(const LineReader& reader, const Columned& read,
                              const LineFormat& format) {
  if (read.outcome != Outcome::too_few)
    reader.fail(describe(read) + "; " + format.expected);
  const std::string has =
      read.columns == 1 ? "1 column" : std::to_string(read.columns) + " columns";
  reader.fail(has + " only; " + format.expected + (read.columns == 2 ? format.perhaps : ""));
}

void require_finite(const LineReader& reader, const double* values, const LineFormat& format) {
  for (int i = 0; i < format.columns; ++i)
    if (!std::isfinite(values[i]))
      reader.fail(std::string(std::isnan(values[i]) ? "NaN" : "an infinite number") + " gives no " +
                  format.use + "; remove the point or correct it");
}

// ---- Headers

/// The columns of a line: between one separator, or blanks, without quotes and blanks around.
std::vector<std::string_view> columns_of(std::string_view line, char separator) {
  constexpr std::string_view around = " \t\r\"'";
  std::vector<std::string_view> columns;
  const auto is_end = [&](char c) {
    return separator == ' ' ? c == ' ' || c == '\t' : c == separator;
  };
  for (std::size_t begin = 0; begin <= line.size();) {
    std::size_t end = begin;
    while (end < line.size() && !is_end(line[end]))
      ++end;
    std::string_view column = line.substr(begin, end - begin);
    const std::size_t first = column.find_first_not_of(around),
                      last = column.find_last_not_of(around);
    column = first == std::string_view::npos ? std::string_view()
                                             : column.substr(first, last - first + 1);
    if (separator != ' ' || !column.empty())
      columns.push_back(column);
    begin = end + 1;
  }
  return columns;
}

/// Which columns a first line of names gives the coordinates.
struct Header {
  char separator = ' ';
  std::array<std::size_t, 3> column{};
};

/// None where the names are others, or those of the first columns.
std::optional<Header> header_of(std::string_view line, Columns columns) {
  using Names = std::vector<std::string_view>;
  const std::vector<Names> wanted =
      columns == Columns::lonlat
          ? std::vector<Names>{{"lon", "longitude", "long", "lng"}, {"lat", "latitude"}}
      : columns == Columns::xy ? std::vector<Names>{{"x"}, {"y"}}
                               : std::vector<Names>{{"x"}, {"y"}, {"z"}};
  Header header;
  if (const std::size_t at = line.find_first_of(",;|\t"); at != std::string_view::npos)
    header.separator = line[at];
  const std::vector<std::string_view> names = columns_of(line, header.separator);
  bool first = true;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto found = std::find_if(names.begin(), names.end(), [&](std::string_view name) {
      std::string lower(name);
      std::transform(lower.begin(), lower.end(), lower.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      return std::find(wanted[k].begin(), wanted[k].end(), lower) != wanted[k].end();
    });
    if (found == names.end())
      return std::nullopt;
    header.column[k] = static_cast<std::size_t>(found - names.begin());
    first = first && header.column[k] == k;
  }
  return first ? std::nullopt : std::optional(header);
}

Columned parse_named(std::string_view line, const Header& header, int count, double* values) {
  const std::vector<std::string_view> columns = columns_of(line, header.separator);
  for (int k = 0; k < count; ++k) {
    const std::size_t at = header.column[static_cast<std::size_t>(k)];
    if (at >= columns.size())
      return {Outcome::too_few, static_cast<int>(columns.size()), {}};
    const Columned read = io_detail::parse_columns(columns[at], 1, values + k);
    if (read.outcome != Outcome::ok)
      return {read.outcome == Outcome::too_few ? Outcome::no_number : read.outcome, k, columns[at]};
  }
  return {};
}

/// A comma between digits where semicolons separate is a decimal comma.
bool has_decimal_comma(std::string_view line) {
  if (line.find(';') == std::string_view::npos)
    return false;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t k = 1; k + 1 < line.size(); ++k)
    if (line[k] == ',' && is_digit(line[k - 1]) && is_digit(line[k + 1]))
      return true;
  return false;
}

/// \param lines receives those of the columns, unless it is null.
Points3 read_rows(std::istream& in, const std::string& name, Columns columns,
                  std::vector<std::int64_t>* lines) {
  const LineFormat format = line_format(columns);
  LineReader reader(in, name);
  std::vector<double> coordinates;
  bool header = false;
  std::optional<Header> names;
  for (std::string_view line; reader.next_content(line);) {
    double values[3];
    if (has_decimal_comma(line))
      reader.fail("commas and semicolons separate; write numbers with decimal points");
    const Columned read = names ? parse_named(line, *names, format.columns, values)
                                : io_detail::parse_columns(line, format.columns, values);
    if (read.outcome != Outcome::ok) {
      if (header || !coordinates.empty() || io_detail::holds_number(line))
        refuse_line(reader, read, format);
      header = true;
      names = header_of(line, columns);
      continue;
    }
    require_finite(reader, values, format);
    format.require(reader, values);
    format.append(coordinates, values);
    if (lines != nullptr)
      lines->push_back(reader.number());
  }
  if (coordinates.empty())
    throw Error(ErrorCode::parse, name + ": no points in " + std::to_string(reader.number()) +
                                      (reader.number() == 1 ? " line" : " lines") + "; " +
                                      format.expected);
  return Eigen::Map<const Points3>(coordinates.data(), 3, std::ssize(coordinates) / 3);
}

} // namespace

PointLines read_point_lines(std::istream& in, const std::string& name, Columns columns) {
  PointLines result;
  result.points = read_rows(in, name, columns, &result.lines);
  return result;
}

PointLines read_point_lines(const std::string& path, Columns columns) {
  std::ifstream in = io_detail::open_input(path);
  return read_point_lines(in, path, columns);
}

Points3 read_points(std::istream& in, const std::string& name, Columns columns) {
  return read_rows(in, name, columns, nullptr);
}

Points3 read_points(const std::string& path, Columns columns) {
  std::ifstream in = io_detail::open_input(path);
  return read_points(in, path, columns);
}

namespace {

// ---- Writing

/// A line for each column, its coordinates separated by blanks.
void put_rows(const io_detail::Sink& sink, const PointsRef& points) {
  io_detail::Writer out(sink);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index j = 0; j < points.rows(); ++j)
      out.number(points(j, i)).text(j + 1 == points.rows() ? "\n" : " ");
  out.flush();
}

void require_2_or_3_rows(const PointsRef& points) {
  if (points.rows() != 3)
    base_detail::require_rows(points, 2, "2 x n columns x y, or 3 x n columns x y z", {});
}

} // namespace

void io_detail::put_points(const Sink& sink, const Points3& points) { put_rows(sink, points); }

void write_points(const std::string& path, const PointsRef& points) {
  require_2_or_3_rows(points);
  io_detail::OutputFile file(path);
  put_rows([&](std::string_view bytes) { file.append(bytes); }, points);
  file.commit();
}

void write_points(std::ostream& out, const PointsRef& points) {
  require_2_or_3_rows(points);
  put_rows(
      [&](std::string_view bytes) {
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      },
      points);
  if (!out.flush())
    throw Error(ErrorCode::file, "cannot write the points: the stream failed; make room or write "
                                 "elsewhere");
}

} // namespace calotte
