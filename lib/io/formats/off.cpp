// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/formats/formats.h"
#include "io/formats/poly_data.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

// The Object File Format of Geomview: "OFF"; the numbers of points, faces and edges; a point on
// each line; then a face on each line, after its number of corners. If not all faces are triangles,
// they are cells.

namespace calotte::io_detail {
namespace {

void put_head(Writer& out, const Points3& points, std::int64_t faces) {
  out.text("OFF\n").number(std::int64_t{points.cols()}).text(" ").number(faces).text(" 0\n");
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    out.number(points(0, i))
        .text(" ")
        .number(points(1, i))
        .text(" ")
        .number(points(2, i))
        .text("\n");
}

void put_face(Writer& out, std::span<const std::int32_t> ids) {
  out.number(std::ssize(ids));
  for (const std::int32_t id : ids)
    out.text(" ").number(std::int64_t{id});
  out.text("\n");
}

/// Reads the corners of the next face.
void take_face(LineReader& reader, std::int64_t points, const std::string& awaited,
               std::vector<std::int64_t>& face, std::vector<std::int32_t>& ids) {
  const std::string_view line = line_with(reader, awaited);
  std::int64_t corners = 0;
  take_columns(reader, line, 1, &corners, awaited);
  if (corners < 3 || corners > std::max<std::int64_t>(points, 3))
    reader.fail("a face of {} corners; give 3 or more, each a point", corners);
  face.resize(static_cast<std::size_t>(corners) + 1);
  take_columns(reader, line, static_cast<int>(corners) + 1, face.data(), awaited);
  parse_ids(reader, face.data() + 1, points, ids, 0, corners);
}

} // namespace

void put_off(const Sink& sink, const Mesh& mesh) {
  Writer out(sink);
  put_head(out, mesh.points, mesh.triangles.cols());
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    put_face(out, {mesh.triangles.col(t).data(), 3});
  out.flush();
}

void put_off(const Sink& sink, const Polygons& polygons) {
  Writer out(sink);
  put_head(out, polygons.corners, polygons.size());
  for (std::int64_t i = 0; i < polygons.size(); ++i)
    put_face(out, polygons.ids[i]);
  out.flush();
}

RawMesh get_off(std::istream& in, const std::string& name) {
  LineReader reader(in, name);
  std::string_view line;
  if (!reader.next_content(line) || line.substr(0, line.find_last_not_of(" \t") + 1) != "OFF")
    fail_at(name, 1, "not an OFF file, which starts with the line OFF");
  std::int64_t counts[2];
  take_columns(reader, 2, counts, "the numbers of points and faces");

  std::vector<double> points;
  for (std::int64_t i = 0; i < counts[0]; ++i) {
    double p[3];
    take_columns(reader, 3, p, message("point {} of {}", i, counts[0]));
    points.insert(points.end(), p, p + 3);
  }
  std::vector<std::int32_t> ids;
  std::vector<std::int64_t> begin{0}, face;
  for (std::int64_t i = 0; i < counts[1]; ++i) {
    take_face(reader, counts[0], message("face {} of {}", i, counts[1]), face, ids);
    begin.push_back(std::ssize(ids));
  }
  if (reader.next_content(line))
    reader.fail("more lines than the file's counts announce");
  PolyData poly_data;
  poly_data.points = Eigen::Map<const Points3>(points.data(), 3, std::ssize(points) / 3);
  poly_data.ids = {Eigen::Map<const Offsets>(begin.data(), std::ssize(begin)),
                   Eigen::Map<const Ids>(ids.data(), std::ssize(ids))};
  return make_raw_mesh(name, std::move(poly_data));
}

} // namespace calotte::io_detail
