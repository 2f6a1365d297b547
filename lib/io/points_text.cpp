// SPDX-License-Identifier: GPL-3.0-or-later
#include "file.h"
#include "formats.h"
#include "lonlat.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <cmath>
#include <cstdio>
#include <ostream>

namespace calotte {
namespace {

using detail::Columned;
using detail::LineReader;
using detail::Outcome;

std::string expected(Columns columns) {
  return columns == Columns::xyz ? "write three numbers x y z a line"
                                 : "write longitude and latitude in degrees a line";
}

[[noreturn]] void refuse(const LineReader& reader, const Columned& read, Columns columns) {
  if (read.outcome != Outcome::too_few)
    reader.fail(describe(read) + "; " + expected(columns));
  const std::string has =
      read.columns == 1 ? "1 column" : std::to_string(read.columns) + " columns";
  const bool maybe_degrees = columns == Columns::xyz && read.columns == 2;
  reader.fail(has + " only; " + expected(columns) +
              (maybe_degrees ? ", or read them as longitude and latitude (--lonlat)" : ""));
}

/// Requires finite numbers, not all 0, and for degrees a latitude in range.
void require_place(const LineReader& reader, const double* values, Columns columns) {
  const int count = columns == Columns::xyz ? 3 : 2;
  for (int i = 0; i < count; ++i)
    if (!std::isfinite(values[i]))
      reader.fail(std::string(std::isnan(values[i]) ? "NaN" : "an infinite number") +
                  " gives no direction; remove the point or correct it");
  if (columns == Columns::xyz && values[0] == 0 && values[1] == 0 && values[2] == 0)
    reader.fail("the zero vector has no direction; remove the point or correct it");
  if (columns == Columns::lonlat && std::abs(values[1]) > 90) {
    char latitude[32];
    std::snprintf(latitude, sizeof latitude, "%g", values[1]);
    reader.fail("latitude " + std::string(latitude) +
                " is outside -90 to 90; write longitude first, then latitude, in degrees");
  }
}

void append_place(std::vector<double>& coordinates, const double* values, Columns columns) {
  if (columns == Columns::xyz) {
    coordinates.insert(coordinates.end(), values, values + 3);
    return;
  }
  const detail::Vec3 p = detail::from_lonlat(values[0], values[1]);
  coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
}

} // namespace

namespace detail {

void put_points(const Sink& sink, const Points3& points) {
  Writer out(sink);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    out.number(points(0, i))
        .text(" ")
        .number(points(1, i))
        .text(" ")
        .number(points(2, i))
        .text("\n");
  out.flush();
}

} // namespace detail

Points3 read_points(std::istream& in, const std::string& name, Columns columns,
                    std::vector<std::int64_t>* lines) {
  const int count = columns == Columns::xyz ? 3 : 2;
  LineReader reader(in, name);
  std::vector<double> coordinates;
  std::vector<std::int64_t> numbers;
  bool header = false;
  for (std::string_view line; reader.next_content(line);) {
    double values[3];
    const Columned read = detail::parse_columns(line, count, values);
    if (read.outcome != Outcome::ok) {
      if (header || !coordinates.empty() || detail::holds_number(line))
        refuse(reader, read, columns);
      header = true;
      continue;
    }
    require_place(reader, values, columns);
    append_place(coordinates, values, columns);
    if (lines)
      numbers.push_back(reader.number());
  }
  if (coordinates.empty())
    throw Error(ErrorCode::parse, name + ": no points in " + std::to_string(reader.number()) +
                                      (reader.number() == 1 ? " line" : " lines") + "; " +
                                      expected(columns));
  if (lines)
    *lines = std::move(numbers);
  return Eigen::Map<const Points3>(coordinates.data(), 3,
                                   static_cast<Eigen::Index>(coordinates.size() / 3));
}

Points3 read_points(const std::string& path, Columns columns, std::vector<std::int64_t>* lines) {
  std::ifstream in = detail::open_input(path);
  return read_points(in, path, columns, lines);
}

void write_points(const std::string& path, const Points3& points) {
  detail::OutputFile file(path);
  detail::put_points([&](std::string_view bytes) { file.append(bytes); }, points);
  file.commit();
}

void write_points(std::ostream& out, const Points3& points) {
  detail::put_points(
      [&](std::string_view bytes) {
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      },
      points);
  if (!out.flush())
    throw Error(ErrorCode::file, "cannot write the points: the stream failed; make room or write "
                                 "elsewhere");
}

} // namespace calotte
