// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/coastal_grid.h"

#include "base/lonlat.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/text.h"
#include "io/formats/format_table.h"
#include "io/formats/formats.h"
#include "io/formats/gmsh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <istream>
#include <string_view>
#include <utility>

// coastal_grid.cpp describes the formats.

namespace calotte::io_detail {

MeshField make_depth_field(const std::vector<double>& depth) {
  return {.name = depth_field,
          .long_name = "depth of the bottom, positive down",
          .units = "m",
          .values = Eigen::Map<const DoubleVector>(depth.data(), std::ssize(depth))};
}

MeshField make_open_field(const NodeLists& boundary, std::int64_t nodes) {
  MeshField field{.name = open_field,
                  .long_name = "1 for a node of the open boundary",
                  .values = DoubleVector::Zero(nodes),
                  .integer = true};
  for (const NodeList& list : boundary.lists)
    if (list.kind == BoundaryKind::open)
      for (const std::int32_t site : list.sites)
        field.values[site] = 1;
  return field;
}

namespace {

/// The nodes of a grid, as they are read.
struct Nodes {
  std::vector<double> coordinates, depth;

  std::int64_t count() const { return std::ssize(depth); }

  /// \param row id, longitude, latitude, depth.
  void add(const LineReader& reader, const std::array<double, 4>& row) {
    if (row[0] != static_cast<double>(count() + 1))
      reader.fail("node {} has another id; number the nodes from 1 on", count() + 1);
    if (!(std::abs(row[1]) <= 360) || !(std::abs(row[2]) <= 90))
      reader.fail(
          "{} {} is no longitude and latitude in degrees; give the grid of the sphere, such "
          "as hgrid.ll, not one in metres",
          row[1], row[2]);
    if (!std::isfinite(row[3]))
      reader.fail("the depth is NaN or infinite; correct it");
    const Vec3 point = base_detail::from_lonlat(row[1], row[2]);
    coordinates.insert(coordinates.end(), {point.x, point.y, point.z});
    depth.push_back(row[3]);
  }
};

CoastalGrid make_grid(const Nodes& nodes, const std::vector<std::int32_t>& triangles,
                      NodeLists boundary) {
  CoastalGrid grid{
      .raw = {.points = Eigen::Map<const Points3>(nodes.coordinates.data(), 3, nodes.count()),
              .triangles =
                  Eigen::Map<const Triangles>(triangles.data(), 3, std::ssize(triangles) / 3)},
      .boundary = std::move(boundary)};
  grid.raw.fields.push_back(make_depth_field(nodes.depth));
  if (std::ranges::any_of(grid.boundary.lists,
                          [](const NodeList& list) { return list.kind == BoundaryKind::open; }))
    grid.raw.fields.push_back(make_open_field(grid.boundary, nodes.count()));
  return grid;
}

std::int64_t require_count(const LineReader& reader, std::int64_t count, const char* of) {
  if (count < 0 || count > std::int64_t{1} << 30)
    reader.fail("{} is not a number of {}", count, of);
  return count;
}

/// A number, and the one after it, or 0 where there is none.
std::array<std::int64_t, 2> number_and_type(LineReader& reader, const std::string& awaited) {
  const std::string_view line = line_with(reader, awaited);
  std::array<std::int64_t, 2> row{};
  if (parse_columns(line, 2, row.data()).outcome != Outcome::ok) {
    row[1] = 0;
    take_columns(reader, line, 1, row.data(), awaited);
  }
  return row;
}

// The types of ADCIRC's boundaries (IBTYPE of its manual). SCHISM's are 0, and 1 for islands.
bool is_island_type(std::int64_t type) { return type == 1 || type == 11 || type == 21; }
bool is_paired_type(std::int64_t type) {
  return type == 4 || type == 24 || type == 5 || type == 25 || type == 64;
}
bool is_barrier_type(std::int64_t type) {
  return is_paired_type(type) || type == 3 || type == 13 || type == 23;
}

void read_list(LineReader& reader, std::int64_t nodes, bool open, NodeLists& boundary) {
  const std::string awaited = open ? "the number of nodes of an open boundary"
                                   : "the number of nodes of a land boundary and its type";
  const auto [count, type] = number_and_type(reader, awaited);
  require_count(reader, count, "nodes");
  const bool paired = !open && is_paired_type(type);
  NodeList list{.line = reader.number(),
                .kind = open                   ? BoundaryKind::open
                        : is_island_type(type) ? BoundaryKind::island
                                               : BoundaryKind::land,
                .is_barrier = !open && is_barrier_type(type)};
  NodeList behind = list;
  for (std::int64_t i = 0; i < count; ++i) {
    std::array<std::int64_t, 2> row{};
    const int columns = paired ? 2 : 1;
    take_columns(reader, columns, row.data(), message("node {} of {}", i + 1, count));
    parse_ids(reader, row.data(), nodes, list.sites, 1, 1);
    if (paired)
      parse_ids(reader, row.data() + 1, nodes, behind.sites, 1, 1);
  }
  boundary.lists.push_back(std::move(list));
  if (paired)
    boundary.lists.push_back(std::move(behind));
}

void read_lists(LineReader& reader, std::int64_t nodes, bool open, std::int64_t lists,
                NodeLists& boundary) {
  require_count(reader, lists, "boundaries");
  std::int64_t& stated = open ? boundary.open_nodes : boundary.other_nodes;
  take_columns(reader, 1, &stated,
               open ? "the number of nodes of open boundaries" : "that of land boundaries");
  for (std::int64_t k = 0; k < lists; ++k)
    read_list(reader, nodes, open, boundary);
}

/// The part of the boundary, which files of SCHISM other than hgrid.gr3 need not have.
NodeLists read_boundary(LineReader& reader, std::int64_t nodes) {
  NodeLists boundary;
  std::string_view line;
  if (!reader.next_content(line))
    return boundary;
  boundary.given = true;
  std::int64_t lists = 0;
  take_columns(reader, line, 1, &lists, "the number of open boundaries");
  read_lists(reader, nodes, true, lists, boundary);
  take_columns(reader, 1, &lists, "the number of land boundaries");
  if (lists > 0) {
    read_lists(reader, nodes, false, lists, boundary);
    return boundary;
  }
  boundary.other_nodes = 0; // files without land may end here
  if (reader.next_content(line))
    take_columns(reader, line, 1, &boundary.other_nodes, "the number of nodes of land boundaries");
  return boundary;
}

} // namespace

CoastalGrid get_schism_or_adcirc(std::istream& in, const std::string& name) {
  LineReader reader(in, name);
  if (std::string_view title; !reader.next(title))
    reader.fail("the file is empty; make it again");
  std::array<std::int64_t, 2> counts{};
  take_columns(reader, 2, counts.data(), "the numbers of elements and nodes");
  for (const std::int64_t count : counts)
    require_count(reader, count, "elements or nodes");
  Nodes nodes;
  for (std::int64_t i = 0; i < counts[1]; ++i) {
    std::array<double, 4> row{};
    take_columns(reader, 4, row.data(), message("node {} of {}", i + 1, counts[1]));
    nodes.add(reader, row);
  }
  std::vector<std::int32_t> triangles;
  for (std::int64_t t = 0; t < counts[0]; ++t) {
    std::array<std::int64_t, 5> row{};
    const std::string_view line = line_with(reader, message("element {} of {}", t + 1, counts[0]));
    take_columns(reader, line, 2, row.data(), message("element {} of {}", t + 1, counts[0]));
    if (row[1] != 3)
      reader.fail("an element of {} nodes; only triangles are read, so cut others in two", row[1]);
    take_columns(reader, line, 5, row.data(), message("element {} of {}", t + 1, counts[0]));
    parse_ids(reader, row.data() + 2, nodes.count(), triangles, 1);
  }
  return make_grid(nodes, triangles, read_boundary(reader, nodes.count()));
}

namespace {

/// The ids of a string of nodes, which follow each other over lines.
class NodeStrings {
public:
  /// Takes the words of a card.
  void add(const LineReader& reader, std::string_view words) {
    std::vector<double> ids = numbers(reader, words);
    for (const double id : ids) {
      if (open_.sites.empty())
        open_.line = reader.number();
      if (id == 0 || id != std::trunc(id) || std::abs(id) > most_id)
        reader.fail("{} is no id of a node", id);
      open_.sites.push_back(static_cast<std::int32_t>(std::abs(id)) - 1);
      if (id < 0) { // its number, which may follow, has no meaning
        lists_.lists.push_back(std::exchange(open_, {}));
        return;
      }
    }
  }

  /// \throws Error parse, for a string without its end, and an id that is none of the nodes.
  NodeLists finished(const LineReader& reader, std::int64_t nodes) && {
    if (!open_.sites.empty())
      fail_at(reader.name(), open_.line, "the string of nodes has no end; negate its last id");
    for (const NodeList& list : lists_.lists)
      for (const std::int32_t site : list.sites)
        if (site >= nodes)
          fail_at(reader.name(), list.line, "the string has node {}, but there are {} nodes",
                  site + 1, nodes);
    lists_.given = !lists_.lists.empty();
    return std::move(lists_);
  }

private:
  static constexpr double most_id = 1 << 30;

  /// The numbers before a name, if there is one.
  static std::vector<double> numbers(const LineReader& reader, std::string_view words) {
    std::array<double, 64> row{};
    const Columned read = parse_columns(words, static_cast<int>(row.size()), row.data());
    if (read.outcome == Outcome::out_of_range)
      reader.fail("{}; correct it", describe(read));
    return {row.begin(), row.begin() + read.columns};
  }

  NodeLists lists_;
  NodeList open_;
};

/// Splits a card of SMS into its name and the rest.
std::array<std::string_view, 2> split_card(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
  line.remove_prefix(begin);
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  return {line.substr(0, end), line.substr(end)};
}

} // namespace

CoastalGrid get_sms_grid(std::istream& in, const std::string& name) {
  LineReader reader(in, name);
  Nodes nodes;
  NodeStrings strings;
  std::vector<std::int64_t> corners, lines;
  if (line_with(reader, "the card MESH2D").find("MESH2D") == std::string_view::npos)
    reader.fail("the file does not begin with the card MESH2D; give a .2dm file of SMS");
  for (std::string_view line; reader.next_content(line);) {
    const auto [card, words] = split_card(line);
    if (card == "ND") {
      std::array<double, 4> row{};
      take_columns(reader, words, 4, row.data());
      row[3] = row[3] == 0 ? 0 : -row[3]; // heights
      nodes.add(reader, row);
    } else if (card == "E3T") {
      std::array<std::int64_t, 4> row{};
      take_columns(reader, words, 4, row.data());
      corners.insert(corners.end(), row.begin() + 1, row.end());
      lines.push_back(reader.number());
    } else if (card == "NS") {
      strings.add(reader, words);
    } else if (card.starts_with("E") && card.size() >= 3 && std::isdigit(card[1]) != 0) {
      reader.fail("the card {}; only triangles, E3T, are read", std::string(card));
    }
  }
  std::vector<std::int32_t> triangles;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (corners[k] < 1 || corners[k] > nodes.count())
      fail_at(name, lines[k / 3], "the triangle has node {}, but there are {} nodes", corners[k],
              nodes.count());
    triangles.push_back(static_cast<std::int32_t>(corners[k] - 1));
  }
  return make_grid(nodes, triangles, std::move(strings).finished(reader, nodes.count()));
}

NodeLists read_node_lists(const std::string& path) {
  const std::optional<Format> format = format_of_name(path);
  std::ifstream in = open_input(path);
  if (format == Format::schism || format == Format::adcirc)
    return get_schism_or_adcirc(in, path).boundary;
  if (format == Format::sms)
    return get_sms_grid(in, path).boundary;
  if (format == Format::msh && is_gmsh(in))
    return get_gmsh(in, path).boundary;
  return {};
}

RawMesh get_coastal(std::istream& in, const std::string& name) {
  return std::move(get_schism_or_adcirc(in, name).raw);
}

RawMesh get_sms(std::istream& in, const std::string& name) {
  return std::move(get_sms_grid(in, name).raw);
}

} // namespace calotte::io_detail
