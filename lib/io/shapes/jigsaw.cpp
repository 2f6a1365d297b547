// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/jigsaw.h"

#include "base/lonlat.h"
#include "base/points.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>

namespace calotte::io_detail {
namespace {

std::string trimmed_lower(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0)
    text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0)
    text.remove_suffix(1);
  return lower(text);
}

/// Reads the lines of one file, section by section.
class Sections {
public:
  Sections(std::istream& in, const std::string& name) : reader_(in, name) {}

  JigsawFile read() {
    for (std::string_view line; reader_.next_content(line);)
      section(line);
    if (file_.kind.empty())
      fail_file(reader_.name(), "no MSHID line; give a .msh file as JIGSAW writes it");
    require_vertices();
    return std::move(file_);
  }

private:
  /// Reads a section, "NAME=what". In most sections `what` is the number of lines.
  void section(std::string_view line) {
    if (line.starts_with("$"))
      reader_.fail("a file of Gmsh; give one of JIGSAW");
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos)
      reader_.fail("{} is not a line NAME=...; a section has more or fewer lines than it announces",
                   in_quotes(line));
    const std::string name = trimmed_lower(line.substr(0, equals));
    const std::string what(line.substr(equals + 1));
    if (name != "coord" && !seen_.insert(name).second)
      reader_.fail("the section {} comes twice; leave one of them out", in_quotes(name));
    if (name == "mshid")
      file_.kind = kind_in(what);
    else if (name == "ndims")
      file_.dimensions = static_cast<int>(whole<1>(what)[0]);
    else if (name == "coord")
      grid(whole<2>(what));
    else if (name == "point")
      points(whole<1>(what)[0]);
    else if (name == "edge2")
      edges(whole<1>(what)[0]);
    else if (name == "tria3")
      triangles(whole<1>(what)[0]);
    else if (name == "value")
      values(what);
    else if (name == "bound")
      bounds(whole<1>(what)[0]);
    else if (name == "slope")
      file_.slopes = numbers(whole<1>(what)[0], 1);
    else if (name == "radii")
      radii(what);
    else
      skip(whole<1>(what)[0]);
  }

  /// The kind in the text of a head, such as "3;ellipsoid-mesh"; it may be missing.
  static std::string kind_in(const std::string& text) {
    const std::size_t semicolon = text.find(';');
    const std::string kind =
        semicolon == std::string::npos ? "" : trimmed_lower(text.substr(semicolon + 1));
    return kind.empty() ? "euclidean-mesh" : kind;
  }

  /// Reads one radius for all axes, or three.
  void radii(std::string_view text) {
    std::array<double, 3>& radii = file_.radii.emplace();
    if (parse_columns(text, 3, radii.data()).outcome != Outcome::ok) {
      take_columns(reader_, text, 1, radii.data());
      radii.fill(radii[0]);
    }
    for (const double radius : radii)
      if (!(radius > 0 && std::isfinite(radius)))
        reader_.fail("a radius that is not positive and finite; correct it");
  }

  /// Parses the whole numbers in the head of a section.
  template <int count> std::array<std::int64_t, count> whole(std::string_view text) {
    std::array<std::int64_t, count> values{};
    const Columned read = parse_columns(text, count, values.data());
    if (read.outcome != Outcome::ok || *std::min_element(values.begin(), values.end()) < 0)
      reader_.fail("{} is not a count of lines", in_quotes(text));
    return values;
  }

  std::string_view next() {
    std::string_view line;
    if (!reader_.next_content(line))
      reader_.fail("the file ends within a section; it was cut short");
    return line;
  }

  /// Reads the first columns of so many lines, line by line.
  std::vector<double> numbers(std::int64_t lines, int columns) {
    std::vector<double> values;
    std::array<double, 4> row{};
    for (std::int64_t i = 0; i < lines; ++i) {
      take_columns(reader_, next(), columns, row.data());
      for (int c = 0; c < columns; ++c)
        if (!std::isfinite(row[static_cast<std::size_t>(c)]))
          reader_.fail("NaN or an infinite number; correct it");
      values.insert(values.end(), row.begin(), row.begin() + columns);
    }
    return values;
  }

  void grid(const std::array<std::int64_t, 2>& head) {
    if (head[0] != 1 && head[0] != 2)
      reader_.fail("COORD={} is not an axis of a grid; give 1 and 2", head[0]);
    std::vector<double>& axis = head[0] == 1 ? file_.x_grid : file_.y_grid;
    if (!axis.empty())
      reader_.fail("COORD={} comes twice; leave one of them out", head[0]);
    axis = numbers(head[1], 1);
  }

  void points(std::int64_t count) {
    if (file_.dimensions != 2 && file_.dimensions != 3)
      reader_.fail("points of {} dimensions; write NDIMS=2 or NDIMS=3 before them",
                   file_.dimensions);
    const int columns = file_.dimensions + 1;
    const std::vector<double> all = numbers(count, columns);
    const Eigen::Map<const DoubleMatrix> rows(all.data(), columns,
                                              std::ssize(all) / static_cast<Eigen::Index>(columns));
    file_.points = rows.topRows(file_.dimensions);
    for (const double tag : rows.bottomRows<1>().reshaped())
      file_.fixed.push_back(tag < 0);
  }

  void edges(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      std::array<std::int64_t, 3> ids{}; // and a tag
      take_columns(reader_, next(), 3, ids.data());
      if (std::min(ids[0], ids[1]) < 0 || std::max(ids[0], ids[1]) >= most_points)
        reader_.fail("an edge's end is no number of a point; count the points from 0");
      file_.edges.push_back({static_cast<std::int32_t>(ids[0]), static_cast<std::int32_t>(ids[1])});
    }
  }

  void triangles(std::int64_t count) {
    std::vector<std::int32_t> all;
    for (std::int64_t i = 0; i < count; ++i) {
      std::array<std::int64_t, 4> ids{}; // and a tag
      take_columns(reader_, next(), 4, ids.data());
      parse_ids(reader_, ids.data(), most_points, all);
    }
    file_.triangles =
        Eigen::Map<const Triangles>(all.data(), 3, static_cast<Eigen::Index>(all.size() / 3));
  }

  void values(const std::string& head) {
    const std::size_t semicolon = head.find(';');
    if (semicolon != std::string::npos)
      file_.values_of_each = whole<1>(head.substr(semicolon + 1))[0];
    file_.values = numbers(whole<1>(head)[0], 1);
  }

  /// Reads BOUND: each line starts with the number of a part.
  void bounds(std::int64_t count) {
    std::set<double> parts;
    for (const double part : numbers(count, 1))
      parts.insert(part);
    file_.parts = static_cast<int>(parts.size());
  }

  void skip(std::int64_t lines) {
    for (std::int64_t i = 0; i < lines; ++i)
      next();
  }

  /// Points may follow the triangles.
  void require_vertices() const {
    for (std::size_t e = 0; e < file_.edges.size(); ++e)
      if (const std::int32_t last = std::max(file_.edges[e][0], file_.edges[e][1]);
          last >= file_.points.cols())
        fail_file(reader_.name(), "edge {} has the point {}, but there are {}, counted from 0", e,
                  last, file_.points.cols());
    for (Eigen::Index t = 0; t < file_.triangles.cols(); ++t)
      if (const std::int32_t last = file_.triangles.col(t).maxCoeff(); last >= file_.points.cols())
        fail_file(reader_.name(),
                  "triangle {} has vertex {}, but there are {} points, counted from 0", t, last,
                  file_.points.cols());
  }

  static constexpr std::int64_t most_points = std::int64_t{1} << 31;

  LineReader reader_;
  JigsawFile file_;
  std::set<std::string> seen_;
};

} // namespace

JigsawFile read_jigsaw(std::istream& in, const std::string& name) {
  return Sections(in, name).read();
}

JigsawFile read_jigsaw(const std::string& path) {
  std::ifstream in = open_input(path);
  return read_jigsaw(in, path);
}

double require_sphere_radius(const JigsawFile& file, const std::string& name) {
  const auto& [a, b, c] = file.radii.value_or(std::array<double, 3>{1, 1, 1});
  if (a != b || b != c)
    fail_file(name, "the radii differ; only meshes of a sphere are read");
  return a;
}

void require_values(const JigsawFile& file, std::size_t nodes, const std::string& name) {
  if (file.values.size() != nodes)
    fail_file(name, "VALUE has {} widths for {} nodes; give one for each", file.values.size(),
              nodes);
}

bool is_planar_mesh(const JigsawFile& file) {
  return file.kind == "euclidean-mesh" && file.dimensions == 2;
}

Points3 make_directions(const JigsawFile& file, const std::string& name) {
  if (file.dimensions == 3)
    return file.points;
  if (file.kind != "ellipsoid-mesh")
    fail_file(name, "a mesh of the plane; give an ellipsoid-mesh, or points of NDIMS=3");
  constexpr double degrees = 180 / std::numbers::pi;
  Points3 points(3, file.points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double latitude = file.points(1, i) * degrees;
    if (std::abs(latitude) > 90.001)
      fail_file(name, i, "latitude {} of point {} is not an angle in radians from -pi/2 to pi/2",
                file.points(1, i), i);
    const Vec3 p = from_lonlat(file.points(0, i) * degrees, std::clamp(latitude, -90.0, 90.0));
    points.col(i) << p.x, p.y, p.z;
  }
  return points;
}

Points3 make_columns(const JigsawFile& file, const std::string& name) {
  return is_planar_mesh(file) ? with_z(Points2(file.points)) : make_directions(file, name);
}

} // namespace calotte::io_detail
