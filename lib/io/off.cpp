// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats.h"

#include <calotte/error.h>

// The Object File Format of Geomview: "OFF", the counts of points, faces and edges, a point a line,
// then a face a line with its number of corners first.

namespace calotte::io_detail {
namespace {

/// The next line with its first `count` columns in `values`.
template <class T> void take(LineReader& reader, int count, T* values, const std::string& awaited) {
  std::string_view line;
  if (!reader.next_content(line))
    reader.fail("the file ends before " + awaited + "; it is incomplete; make it again");
  const Columned read = parse_columns(line, count, values);
  if (read.outcome != Outcome::ok)
    reader.fail((read.outcome == Outcome::too_few ? "too few columns" : describe(read)) +
                " where " + awaited + " belongs");
}

std::string of(const char* thing, std::int64_t index, std::int64_t count) {
  return std::string(thing) + " " + std::to_string(index) + " of " + std::to_string(count);
}

} // namespace

void put_off(const Sink& sink, const Mesh& mesh) {
  Writer out(sink);
  out.text("OFF\n").number(std::int64_t{mesh.points.cols()}).text(" ");
  out.number(std::int64_t{mesh.triangles.cols()}).text(" 0\n");
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    out.number(mesh.points(0, i))
        .text(" ")
        .number(mesh.points(1, i))
        .text(" ")
        .number(mesh.points(2, i))
        .text("\n");
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    out.text("3");
    for (int i = 0; i < 3; ++i)
      out.text(" ").number(std::int64_t{mesh.triangles(i, t)});
    out.text("\n");
  }
  out.flush();
}

Soup get_off(std::istream& in, const std::string& name) {
  LineReader reader(in, name);
  std::string_view line;
  if (!reader.next_content(line) || line.substr(0, line.find_last_not_of(" \t") + 1) != "OFF")
    throw Error(ErrorCode::parse, name + " line 1: not an OFF file, which starts with the line OFF",
                1);
  std::int64_t counts[2];
  take(reader, 2, counts, "the numbers of points and faces");

  std::vector<double> points;
  for (std::int64_t i = 0; i < counts[0]; ++i) {
    double p[3];
    take(reader, 3, p, of("point", i, counts[0]));
    points.insert(points.end(), p, p + 3);
  }
  std::vector<std::int32_t> triangles;
  for (std::int64_t t = 0; t < counts[1]; ++t) {
    std::int64_t face[4];
    take(reader, 4, face, of("triangle", t, counts[1]));
    if (face[0] != 3)
      reader.fail("a face of " + std::to_string(face[0]) + " corners; only triangles are read");
    parse_ids(reader, face + 1, counts[0], triangles);
  }
  if (reader.next_content(line))
    reader.fail("more lines than the file's counts announce");
  return {Eigen::Map<const Points3>(points.data(), 3, Eigen::Index(points.size() / 3)),
          Eigen::Map<const Triangles>(triangles.data(), 3, Eigen::Index(triangles.size() / 3))};
}

} // namespace calotte::io_detail
