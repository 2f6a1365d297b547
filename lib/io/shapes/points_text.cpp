// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/points_text.h"
#include "base/parallel.h"
#include "base/points.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/shapes/row_parser.h"
#include "io/shapes/text_parts.h"

#include <calotte/read.h>
#include <calotte/write.h>

#include <algorithm>
#include <ostream>

namespace calotte {
namespace {

using io_detail::LineReader;
using io_detail::PointRows;
using io_detail::RowParser;

using Part = io_detail::TextPart<RowParser, PointRows>;

/// Gives `out` room for the points that the text may have. Eigen's conservativeResize() would not
/// throw where there is no memory.
void make_room(std::int64_t points, PointLines& out) {
  Points3 larger(3, points);
  const auto known = std::ssize(out.lines);
  larger.leftCols(known) = out.points.leftCols(known);
  out.points = std::move(larger);
  out.lines.reserve(static_cast<std::size_t>(points));
}

/// Appends the points of parts.
void append(const std::vector<Part>& parts, const LineReader& reader, PointLines& out) {
  std::vector<std::int64_t> begin;
  auto points = std::ssize(out.lines);
  for (const Part& part : parts) {
    begin.push_back(points);
    points += std::ssize(part.rows.lines);
  }
  if (points > out.points.cols()) // one line, the first, does not tell how long the others are
    make_room(points == 1 ? 1 : std::max(points, reader.estimate_all(points)), out);
  for (const Part& part : parts)
    for (const std::int64_t line : part.rows.lines)
      out.lines.push_back(part.before + line);
  base_detail::for_each_task(std::ssize(parts), [&](std::int64_t i) {
    std::ranges::copy(parts[static_cast<std::size_t>(i)].rows.coordinates,
                      out.points.data() + 3 * begin[static_cast<std::size_t>(i)]);
  });
}

PointLines read_rows(std::istream& in, const std::string& name, Columns columns) {
  LineReader reader(in, name);
  PointLines result;
  const RowParser parser = io_detail::parse_text<PointRows>(
      reader, RowParser(columns),
      [&](const std::vector<Part>& parts, const LineReader& at) { append(parts, at, result); });
  result.further_columns = parser.finish(reader);
  result.points.conservativeResize(3, std::ssize(result.lines)); // shrinks in its memory
  return result;
}

} // namespace

PointLines read_point_lines(std::istream& in, const std::string& name, Columns columns) {
  return read_rows(in, name, columns);
}

PointLines read_point_lines(const std::string& path, Columns columns) {
  std::ifstream in = io_detail::open_input(path);
  return read_rows(in, path, columns);
}

Points3 read_points(std::istream& in, const std::string& name, Columns columns) {
  return read_rows(in, name, columns).points;
}

Points3 read_points(const std::string& path, Columns columns) {
  return read_point_lines(path, columns).points;
}

namespace {

// ---- Writing

/// Writes each column on a line, with blanks between its coordinates.
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
    io_detail::fail_write("the points", "the stream failed; make room or write elsewhere");
}

} // namespace calotte
