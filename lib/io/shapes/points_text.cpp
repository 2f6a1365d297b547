// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/points_text.h"
#include "base/lonlat.h"
#include "base/points.h"
#include "io/bytes/file.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <cmath>
#include <cstdio>
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

/// \param lines receives those of the columns, unless it is null.
Points3 read_rows(std::istream& in, const std::string& name, Columns columns,
                  std::vector<std::int64_t>* lines) {
  const LineFormat format = line_format(columns);
  LineReader reader(in, name);
  std::vector<double> coordinates;
  bool header = false;
  for (std::string_view line; reader.next_content(line);) {
    double values[3];
    const Columned read = io_detail::parse_columns(line, format.columns, values);
    if (read.outcome != Outcome::ok) {
      if (header || !coordinates.empty() || io_detail::holds_number(line))
        refuse_line(reader, read, format);
      header = true;
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
