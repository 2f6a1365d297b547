// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/gmsh.h"

#include "io/bytes/file_error.h"
#include "io/bytes/text.h"
#include "io/formats/coastal_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

// Meshes of Gmsh (Geuzaine and Remacle, Int. J. Numer. Methods Eng. 79, 2009; the formats MSH 2 and
// 4 of its manual, as text) consist of sections from $Name to $EndName. Nodes and elements have
// numbers of their own. Lines and points of the geometry are elements, too. Lines of the physical
// group "open" are an open boundary, those of "land" and "island" a coast.

namespace calotte::io_detail {
namespace {

enum class Shape { triangle, line, less, more };

/// Classifies the types of the manual. The corners of a triangle, and the ends of a line, precede
/// their other nodes.
Shape classify(std::int64_t type) {
  constexpr std::array<std::int64_t, 8> triangles{2, 9, 20, 21, 22, 23, 24, 25};
  constexpr std::array<std::int64_t, 7> lines{1, 8, 26, 27, 28, 62, 63};
  constexpr std::int64_t point = 15;
  const auto is_in = [&](const auto& types) {
    return std::find(types.begin(), types.end(), type) != types.end();
  };
  return is_in(triangles) ? Shape::triangle
         : is_in(lines)   ? Shape::line
         : type == point  ? Shape::less
                          : Shape::more;
}

/// The names of physical groups, in quotes.
constexpr std::array<std::pair<const char*, BoundaryKind>, 3> boundary_groups{
    {{"\"open\"", BoundaryKind::open},
     {"\"land\"", BoundaryKind::land},
     {"\"island\"", BoundaryKind::island}}};

class GmshFile {
public:
  GmshFile(std::istream& in, const std::string& name) : reader_(in, name) {}

  CoastalGrid read() {
    for (std::string_view line; reader_.next_content(line);)
      section(trimmed(line));
    if (corners_.empty())
      fail_file(reader_.name(),
                "a file of Gmsh without triangles; mesh its surfaces (gmsh -2), and "
                "save all elements (Mesh.SaveAll=1)");
    return grid();
  }

private:
  static std::string trimmed(std::string_view line) {
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t'))
      line.remove_suffix(1);
    return std::string(line);
  }

  void section(const std::string& name) {
    if (!name.starts_with("$"))
      reader_.fail("{} is not the name of a section, such as $Nodes; the section before has more "
                   "lines than it announces",
                   in_quotes(name));
    if (name == "$NOD" || name == "$ELM")
      reader_.fail("version 1 of Gmsh's format is not read; save the mesh as version 2 or 4 "
                   "(Mesh.MshFileVersion)");
    if (name == "$MeshFormat")
      format();
    else if (name == "$PhysicalNames")
      physical_names();
    else if (name == "$Entities")
      entities();
    else if (name == "$Nodes")
      nodes();
    else if (name == "$Elements")
      elements();
    const std::string end = "$End" + name.substr(1);
    const bool known = name == "$Nodes" || name == "$Elements";
    for (std::string_view line = next(name); trimmed(line) != end; line = next(name))
      if (known)
        reader_.fail("{} instead of {}; the section has more lines than it announces",
                     in_quotes(line), end);
  }

  std::string_view next(const std::string& section) {
    std::string_view line;
    if (!reader_.next_content(line))
      reader_.fail("the file ends within {}; it was cut short", section);
    return line;
  }

  template <class T, std::size_t count>
  std::array<T, count> columns(std::string_view line, std::size_t used = count) const {
    std::array<T, count> values{};
    take_columns(reader_, line, static_cast<int>(used), values.data());
    return values;
  }

  std::int64_t require_count(std::int64_t number) const {
    if (number < 0 || number > most_entries)
      reader_.fail("{} is not a number of lines", number);
    return number;
  }

  void format() {
    const auto [version, type, size] = columns<double, 3>(next("$MeshFormat"));
    if (!(version >= 2 && version < 3) && !(version >= 4 && version < 5))
      reader_.fail("only the versions 2 and 4 of Gmsh's format are read; save the mesh as one of "
                   "them (Mesh.MshFileVersion)");
    if (type != 0)
      reader_.fail("a binary file of Gmsh; save the mesh as text (Mesh.Binary=0)");
    version_ = version;
  }

  using Kinds = std::map<double, BoundaryKind>; ///< by the number of a group, or of a curve

  static std::optional<BoundaryKind> kind_of(const Kinds& kinds, double number) {
    const auto found = kinds.find(number);
    return found == kinds.end() ? std::nullopt : std::optional(found->second);
  }

  /// Finds the groups of curves that are parts of the boundary.
  void physical_names() {
    const std::int64_t lines = require_count(columns<std::int64_t, 1>(next("$PhysicalNames"))[0]);
    for (std::int64_t i = 0; i < lines; ++i) {
      const std::string_view line = next("$PhysicalNames");
      const auto [dimension, group] = columns<double, 2>(line);
      for (const auto& [name, kind] : boundary_groups)
        if (dimension == 1 && line.find(name) != std::string_view::npos)
          groups_[group] = kind;
    }
  }

  /// Finds the curves of these groups: the number of a curve, six bounds, the number of its groups
  /// and these.
  void entities() {
    const auto counts = columns<std::int64_t, 4>(next("$Entities"));
    for (std::int64_t i = 0; i < require_count(counts[0]); ++i)
      next("$Entities");
    for (std::int64_t i = 0; i < require_count(counts[1]); ++i) {
      std::array<double, 8 + most_tags> row{};
      const Columned read = parse_columns(next("$Entities"), std::ssize(row), row.data());
      const double groups = std::clamp(row[7], 0.0, static_cast<double>(most_tags));
      const auto end = std::min<std::size_t>(static_cast<std::size_t>(read.columns),
                                             8 + static_cast<std::size_t>(groups));
      for (std::size_t k = 8; k < end; ++k)
        if (const auto kind = kind_of(groups_, row[k]))
          curves_[row[0]] = *kind;
    }
    for (std::int64_t i = 0; i < require_count(counts[2]) + require_count(counts[3]); ++i)
      next("$Entities");
  }

  /// Calls block(kind, lines, entity) for each block of a section of version 4.
  template <class Block> void blocks(const std::string& name, const Block& block) {
    const std::int64_t count = require_count(columns<std::int64_t, 2>(next(name))[0]);
    for (std::int64_t i = 0; i < count; ++i) {
      const auto head = columns<std::int64_t, 4>(next(name));
      block(head[2], require_count(head[3]), head[version_ >= 4.1 ? 1 : 0]);
    }
  }

  void nodes() {
    if (version_ >= 4.1) {
      blocks("$Nodes", [&](std::int64_t /*parametric*/, std::int64_t lines, std::int64_t) {
        const std::size_t first = coordinates_.size() / 3;
        for (std::int64_t i = 0; i < lines; ++i)
          number_node(columns<std::int64_t, 1>(next("$Nodes"))[0],
                      first + static_cast<std::size_t>(i));
        for (std::int64_t i = 0; i < lines; ++i)
          add_point(columns<double, 3>(next("$Nodes")));
      });
      return;
    }
    const auto read_lines = [&](std::int64_t lines) {
      for (std::int64_t i = 0; i < lines; ++i) {
        const std::string_view line = next("$Nodes");
        const auto row = columns<double, 4>(line);
        number_node(columns<std::int64_t, 1>(line)[0], coordinates_.size() / 3);
        add_point({row[1], row[2], row[3]});
      }
    };
    if (version_ >= 4)
      blocks("$Nodes", [&](std::int64_t, std::int64_t lines, std::int64_t) { read_lines(lines); });
    else
      read_lines(require_count(columns<std::int64_t, 1>(next("$Nodes"))[0]));
  }

  void number_node(std::int64_t node, std::size_t index) {
    if (!index_of_.emplace(node, index).second)
      reader_.fail("the node {} comes twice; make the file again", node);
  }

  void add_point(const std::array<double, 3>& point) {
    for (const double x : point)
      if (!std::isfinite(x))
        reader_.fail("NaN or an infinite number; correct it");
    coordinates_.insert(coordinates_.end(), point.begin(), point.end());
  }

  void elements() {
    if (version_ >= 4) {
      blocks("$Elements", [&](std::int64_t type, std::int64_t lines, std::int64_t entity) {
        for (std::int64_t i = 0; i < lines; ++i)
          element(next("$Elements"), type, 1, kind_of(curves_, static_cast<double>(entity)));
      });
      return;
    }
    const std::int64_t lines = require_count(columns<std::int64_t, 1>(next("$Elements"))[0]);
    for (std::int64_t i = 0; i < lines; ++i) {
      const std::string_view line = next("$Elements");
      const auto [number, type, tags] = columns<std::int64_t, 3>(line);
      if (tags < 0 || tags > std::int64_t{most_tags})
        reader_.fail("{} is not a number of tags", tags);
      element(line, type, 3 + static_cast<std::size_t>(tags),
              tags > 0 ? kind_of(groups_, columns<double, 4>(line)[3]) : std::nullopt);
    }
  }

  /// \param first the column of its first node.
  /// \param kind of a line, if it is a part of the boundary.
  void element(std::string_view line, std::int64_t type, std::size_t first,
               std::optional<BoundaryKind> kind) {
    const Shape shape = classify(type);
    if (shape == Shape::more)
      reader_.fail("an element of type {}{}; only triangles are read, so mesh the surfaces with "
                   "triangles alone",
                   type, type == 3 ? ", a quadrangle" : "");
    if (shape == Shape::less || (shape == Shape::line && !kind))
      return;
    const std::size_t nodes = shape == Shape::line ? 2 : 3;
    const auto row = columns<std::int64_t, 3 + most_tags + 3>(line, first + nodes);
    if (shape == Shape::line)
      lines_.push_back({reader_.number(), *kind, {row[first], row[first + 1]}});
    else
      corners_.insert(corners_.end(), row.begin() + static_cast<std::ptrdiff_t>(first),
                      row.begin() + static_cast<std::ptrdiff_t>(first + 3));
  }

  /// Only the nodes of triangles are sites: others belong to the geometry, such as the centre of a
  /// sphere.
  CoastalGrid grid() const {
    std::vector<std::int32_t> site(coordinates_.size() / 3, -1);
    const auto index_of = [&](std::int64_t node) {
      const auto found = index_of_.find(node);
      if (found == index_of_.end() || found->second >= site.size())
        fail_file(reader_.name(),
                  "a triangle has the node {}, which $Nodes does not have; make the file again",
                  node);
      return found->second;
    };
    for (const std::int64_t node : corners_)
      site[index_of(node)] = 0;
    std::int32_t sites = 0;
    for (std::int32_t& id : site)
      id = id < 0 ? -1 : sites++;
    CoastalGrid grid{.raw = {.points = Points3(3, sites)}, .boundary = {}};
    RawMesh& raw = grid.raw;
    for (std::size_t k = 0; k < site.size(); ++k)
      if (site[k] >= 0)
        raw.points.col(site[k]) = Eigen::Map<const Eigen::Vector3d>(coordinates_.data() + 3 * k);
    raw.triangles.resize(3, std::ssize(corners_) / 3);
    for (std::size_t k = 0; k < corners_.size(); ++k)
      raw.triangles.data()[k] = site[index_of(corners_[k])];
    grid.boundary = boundary(site);
    const auto is_open = [](const Line& line) { return line.kind == BoundaryKind::open; };
    if (std::ranges::any_of(lines_, is_open))
      raw.fields.push_back(make_open_field(grid.boundary, sites));
    return grid;
  }

  /// The lines between sites, each as a list of its own.
  /// \param site by index of a node; -1 for none.
  NodeLists boundary(const std::vector<std::int32_t>& site) const {
    const auto site_of = [&](std::int64_t node) {
      const auto found = index_of_.find(node);
      return found == index_of_.end() || found->second >= site.size() ? -1 : site[found->second];
    };
    NodeLists all{.given = !lines_.empty()};
    for (const Line& line : lines_) {
      const std::int32_t from = site_of(line.ends[0]), to = site_of(line.ends[1]);
      if (from >= 0 && to >= 0)
        all.lists.push_back({.line = line.number, .kind = line.kind, .sites = {from, to}});
    }
    return all;
  }

  /// A line of the boundary.
  struct Line {
    std::int64_t number; ///< of the line of text
    BoundaryKind kind;
    std::array<std::int64_t, 2> ends; ///< numbers of nodes
  };

  static constexpr std::size_t most_tags = 8;
  static constexpr std::int64_t most_entries = std::int64_t{1} << 30;

  LineReader reader_;
  double version_ = 2;
  std::unordered_map<std::int64_t, std::size_t> index_of_; ///< by number of a node: its index
  std::vector<double> coordinates_;                        ///< x y z of each node
  std::vector<std::int64_t> corners_;                      ///< numbers of the nodes of triangles
  std::vector<Line> lines_;
  Kinds groups_, curves_;
};

} // namespace

bool is_gmsh(std::istream& in) { return in.peek() == '$'; }

CoastalGrid get_gmsh(std::istream& in, const std::string& name) {
  return GmshFile(in, name).read();
}

} // namespace calotte::io_detail
