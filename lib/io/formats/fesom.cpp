// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "base/message.h"
#include "base/points.h"
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/cells/model_grid.h"
#include "io/formats/coastal_grid.h"
#include "io/formats/formats.h"
#include "mesh/orientation.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

// The mesh files of FESOM (Danilov et al., Geosci. Model Dev. 10, 2017) are text. nod2d.out has the
// number of nodes, then a line for each node: id, longitude and latitude in degrees, and a flag, 1
// on the coast. elem2d.out has the number of triangles, then three ids a line. Ids count from 1.
// aux3d.out has the number of levels, their depths, and the depth of the bottom at each node, a
// number a line.

namespace calotte::io_detail {
namespace {

std::string beside_nodes(const std::string& path, std::string_view name) {
  return sibling(path, fesom_nodes_name, name).value_or(path);
}

std::int64_t take_count(LineReader& reader, const std::string& of) {
  std::int64_t count = 0;
  take_columns(reader, 1, &count, "the number of " + of);
  if (count < 0 || count > (std::int64_t{1} << 30))
    reader.fail("{} is not a number of {}", count, of);
  return count;
}

/// Reads the nodes. Ids must be consecutive; the flags become a field.
/// \param longitudes receives those of the file.
RawMesh read_nodes(const std::string& path, std::vector<double>& longitudes) {
  std::ifstream in = open_input(path);
  LineReader reader(in, path);
  const std::int64_t count = take_count(reader, "nodes");
  std::vector<double> coordinates, flags;
  for (std::int64_t i = 0; i < count; ++i) {
    std::array<double, 4> row{};
    take_columns(reader, 4, row.data(), message("node {} of {}", i + 1, count));
    if (row[0] != static_cast<double>(i + 1))
      reader.fail("node {} has another id; number the nodes from 1 on", i + 1);
    if (!std::isfinite(row[1]) || !(std::abs(row[2]) <= 90))
      reader.fail("longitude and latitude are no place on the sphere; make the file again");
    const Vec3 point = from_lonlat(row[1], row[2]);
    longitudes.push_back(row[1]);
    coordinates.insert(coordinates.end(), {point.x, point.y, point.z});
    flags.push_back(row[3]);
  }
  RawMesh raw{.points = Eigen::Map<const Points3>(coordinates.data(), 3, count)};
  raw.fields.push_back({.name = "coast",
                        .long_name = "1 for a node on the coast",
                        .values = Eigen::Map<const DoubleVector>(flags.data(), count)});
  return raw;
}

Triangles read_elements(const std::string& path, std::int64_t nodes) {
  std::ifstream in = open_input(path);
  LineReader reader(in, path);
  const std::int64_t count = take_count(reader, "elements");
  std::vector<std::int32_t> ids;
  for (std::int64_t t = 0; t < count; ++t) {
    std::array<std::int64_t, 3> row{};
    take_columns(reader, 3, row.data(), message("element {} of {}", t + 1, count));
    parse_ids(reader, row.data(), nodes, ids, 1);
  }
  return Eigen::Map<const Triangles>(ids.data(), 3, count);
}

/// Reads the depths of aux3d.out, if it is there and is of these nodes. It may have been left by
/// another mesh.
void read_depths(const std::string& path, RawMesh& raw) {
  if (std::error_code error; !std::filesystem::is_regular_file(path, error))
    return;
  std::ifstream in = open_input(path);
  LineReader reader(in, path);
  std::vector<double> numbers;
  for (std::string_view line; reader.next_content(line);) {
    const std::optional<std::vector<double>> some = parse_numbers(line);
    if (!some)
      reader.fail("{} is no line of numbers; make the file again", in_quotes(line));
    numbers.insert(numbers.end(), some->begin(), some->end());
  }
  const double levels = numbers.empty() ? 0 : numbers.front();
  const auto nodes = raw.points.cols();
  if (static_cast<double>(numbers.size()) != 1 + levels + static_cast<double>(nodes)) {
    raw.ignored.push_back(std::string(fesom_depths_name) + ", of other nodes");
    return;
  }
  std::vector<double> depth(numbers.end() - nodes, numbers.end());
  for (double& value : depth)
    value = std::abs(value);
  raw.fields.push_back(make_depth_field(depth));
}

// ---- Channels

/// The range of longitudes of the corners of a triangle, in degrees.
struct Span {
  double least = 1e300, greatest = -1e300;
  void add(double x) {
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
  double width() const { return greatest - least; }
};

/// Refuses a mesh of a channel: FESOM joins the ends of a mesh after cyclic_length degrees, a
/// number that is not in the files. On the sphere the triangles at the joint would extend the other
/// way around, along the whole mesh.
/// \param longitudes of the nodes, as in the file.
void require_no_channel(const std::string& path, const std::vector<double>& longitudes,
                        const RawMesh& raw) {
  const mesh_detail::Orientations found = mesh_detail::orientations_of(raw.points, raw.triangles);
  if (!found.contradict())
    return;
  Span all, most_others;
  std::int64_t joining = 0;
  for (const double x : longitudes)
    all.add(x);
  for (Eigen::Index t = 0; t < raw.triangles.cols(); ++t) {
    Span span;
    for (const std::int32_t node : raw.triangles.col(t))
      span.add(longitudes[static_cast<std::size_t>(node)]);
    if (span.width() > all.width() / 2)
      ++joining;
    else
      most_others.add(span.width());
  }
  if (joining != std::min(found.clockwise, found.counter_clockwise) || !(all.width() < 359))
    return;
  std::ostringstream text;
  text << path << ": " << joining
       << " triangles join both ends of a channel that is periodic after "
       << "some " << std::setprecision(3) << all.width() + most_others.greatest
       << " degrees of longitude (FESOM's cyclic_length), which the sphere does not hold; leave "
          "these triangles out, or give a mesh that goes around the sphere";
  throw Error(ErrorCode::parse, text.str());
}

} // namespace

namespace {

Writer to(OutputFile& file) {
  return Writer([&file](std::string_view bytes) { file.append(bytes); });
}

void put_nodes(const Mesh& mesh, OutputFile& file) {
  std::vector<bool> coast(static_cast<std::size_t>(mesh.points.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) < 0)
        for (const int end : {1, 2})
          coast[static_cast<std::size_t>(mesh.triangles((i + end) % 3, t))] = true;
  Writer out = to(file);
  out.number(std::int64_t{mesh.points.cols()}).text("\n");
  const Points3 units = on_sphere(mesh.points, 1);
  for (Eigen::Index i = 0; i < units.cols(); ++i) {
    const LonLat lonlat = eastern_lonlat_of(column(units, i));
    out.number(std::int64_t{i + 1}).text(" ").number(lonlat.longitude).text(" ");
    out.number(lonlat.latitude).text(coast[static_cast<std::size_t>(i)] ? " 1\n" : " 0\n");
  }
  out.flush();
}

void put_elements(const Mesh& mesh, OutputFile& file) {
  Writer out = to(file);
  out.number(std::int64_t{mesh.triangles.cols()}).text("\n");
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      out.number(std::int64_t{mesh.triangles(i, t) + 1}).text(i < 2 ? " " : "\n");
  out.flush();
}

/// Writes depths as negative numbers. FESOM applies the sign of the second level to all.
void put_depths(const WriteOptions& options, OutputFile& file) {
  Writer out = to(file);
  out.number(std::int64_t{options.depth_levels.size()}).text("\n");
  for (const DoubleVector* depths : {&options.depth_levels, &options.site_depth})
    for (const double depth : *depths)
      out.number(depth == 0 ? 0 : -std::abs(depth)).text("\n");
  out.flush();
}

} // namespace

void write_fesom(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  OutputFile nodes(path), elements(beside_nodes(path, fesom_elements_name));
  std::optional<OutputFile> depths;
  nodes.watch(options.progress, 60 * mesh.points.cols());
  put_nodes(mesh, nodes);
  put_elements(mesh, elements);
  if (options.depth_levels.size() > 0) {
    depths.emplace(beside_nodes(path, fesom_depths_name));
    put_depths(options, *depths);
    depths->commit();
  }
  elements.commit();
  nodes.commit();
}

RawMesh read_fesom(const std::string& path) {
  std::vector<double> longitudes;
  RawMesh raw = read_nodes(path, longitudes);
  read_depths(beside_nodes(path, fesom_depths_name), raw);
  raw.triangles = read_elements(beside_nodes(path, fesom_elements_name), raw.points.cols());
  require_no_channel(path, longitudes, raw);
  return raw;
}

} // namespace calotte::io_detail
