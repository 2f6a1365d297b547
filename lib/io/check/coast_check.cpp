// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/coast_check.h"

#include "base/message.h"
#include "io/formats/coastal_grid.h"
#include "io/formats/format_table.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

namespace calotte::io_detail {
namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

/// The findings: the first of each kind, and how many there are.
class Findings {
public:
  void add(const std::string& variable, const std::string& rule, const std::string& first,
           std::int64_t index) {
    Found& found = found_[{variable, rule}];
    if (found.count++ == 0) {
      found.first = first;
      found.index = index;
    }
  }

  std::vector<Deviation> result() const {
    std::vector<Deviation> all;
    for (const auto& [key, found] : found_)
      all.push_back({.variable = key.first,
                     .difference = 1,
                     .index = found.index,
                     .text = message("{}: {}{}; {}", key.first, key.second,
                                     found.count > 1 ? message(" ({} times)", found.count) : "",
                                     found.first)});
    return all;
  }

private:
  struct Found {
    std::int64_t count = 0, index = -1;
    std::string first;
  };
  std::map<std::pair<std::string, std::string>, Found> found_;
};

/// All edges of a mesh, from the lower site on.
std::set<Edge> all_edges(const Mesh& mesh) {
  std::set<Edge> edges;
  for (const auto& t : mesh.triangles.colwise())
    for (int i = 0; i < 3; ++i)
      edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
  return edges;
}

/// The outer edges of a mesh, with it to the left, and how many lists have each.
std::map<Edge, int> outer_edges(const Mesh& mesh) {
  std::map<Edge, int> edges;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) < 0)
        edges[{mesh.triangles((i + 1) % 3, t), mesh.triangles((i + 2) % 3, t)}] = 0;
  return edges;
}

std::string node(std::int64_t site) { return message("node {}", site + 1); }

/// Requires a triangle at each node, and a boundary that passes it once at most.
/// \param once whether the second rule applies.
void check_nodes(const Mesh& mesh, bool once, Findings& findings) {
  std::vector<int> triangles(static_cast<std::size_t>(mesh.points.cols())), passes = triangles;
  for (const std::int32_t site : mesh.triangles.reshaped())
    ++triangles[static_cast<std::size_t>(site)];
  for (const auto& [edge, lists] : outer_edges(mesh))
    ++passes[static_cast<std::size_t>(edge.first)];
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto site = static_cast<std::int64_t>(i);
    if (triangles[i] == 0)
      findings.add("nodes", "each is in a triangle", node(site) + " is in none", site);
    if (once && passes[i] > 1)
      findings.add("nodes", "the boundary passes each once", "it passes " + node(site) + " again",
                   site);
  }
}

/// What a model demands of lists.
struct ListRules {
  bool outer = false;         ///< they follow outer edges, and not others
  bool land_right = false;    ///< of lists of land
  bool open_unclosed = false; ///< no open list ends where it starts
  bool islands_close = false; ///< an edge leads from the last node of an island to its first
  bool all = false;           ///< each outer edge is in a list
};

class ListCheck {
public:
  ListCheck(const Mesh& mesh, const ListRules& rules, Findings& findings)
      : edges_(outer_edges(mesh)), inner_(rules.outer ? std::set<Edge>() : all_edges(mesh)),
        rules_(rules), findings_(findings) {}

  void check(const NodeList& list) {
    const std::string name = list.kind == BoundaryKind::open ? "open boundary" : "land boundary";
    const std::int64_t n = std::ssize(list.sites);
    if (n < 2)
      findings_.add(name, "a list has two nodes or more",
                    message("the list at line {} has {}", list.line, n), list.line);
    if (n > 1 && list.kind == BoundaryKind::open && rules_.open_unclosed &&
        list.sites.front() == list.sites.back())
      findings_.add(name, "an open list does not end where it starts",
                    message("that at line {} does", list.line), list.line);
    for (std::int64_t k = 0; k + 1 < n; ++k)
      check(list, name, list.sites[static_cast<std::size_t>(k)],
            list.sites[static_cast<std::size_t>(k) + 1]);
    if (n > 2 && list.kind == BoundaryKind::island && rules_.islands_close &&
        list.sites.front() != list.sites.back())
      check(list, name, list.sites.back(), list.sites.front());
  }

  void finish() const {
    if (!rules_.all)
      return;
    for (const auto& [edge, lists] : edges_)
      if (lists != 1)
        findings_.add(
            "boundary", "each outer edge is in one list",
            message("that from {} to {} is in {}", node(edge.first), node(edge.second), lists),
            edge.first);
  }

private:
  void check(const NodeList& list, const std::string& name, std::int32_t from, std::int32_t to) {
    const auto ahead = edges_.find({from, to}), back = edges_.find({to, from});
    if (ahead != edges_.end()) {
      ++ahead->second;
    } else if (back != edges_.end()) {
      ++back->second;
      if (rules_.land_right && list.kind != BoundaryKind::open)
        findings_.add(name, "land is to the right of a list",
                      message("that at line {} has it to the left, from {} to {}", list.line,
                              node(from), node(to)),
                      list.line);
    } else if (!inner_.contains(std::minmax(from, to))) {
      findings_.add(
          name,
          rules_.outer ? "consecutive nodes join an outer edge" : "consecutive nodes join an edge",
          message("in the list at line {}, {} and {} do not", list.line, node(from), node(to)),
          list.line);
    }
  }

  std::map<Edge, int> edges_;
  std::set<Edge> inner_; ///< all edges, where those inside the mesh are allowed, too
  ListRules rules_;
  Findings& findings_;
};

void check_count(const std::string& name, std::int64_t stated, bool open, const NodeLists& boundary,
                 Findings& findings) {
  std::int64_t nodes = 0;
  for (const NodeList& list : boundary.lists)
    nodes += (list.kind == BoundaryKind::open) == open ? std::ssize(list.sites) : 0;
  if (stated >= 0 && stated != nodes)
    findings.add(name, "the number of nodes is that of the lists",
                 message("the file states {}, its lists have {}", stated, nodes), -1);
}

void check_lists(const std::string& path, Format format, const Mesh& mesh, Findings& findings) {
  const NodeLists boundary = read_node_lists(path);
  const bool schism = format == Format::schism, adcirc = format == Format::adcirc;
  if (schism || adcirc)
    check_nodes(mesh, true, findings);
  if (!boundary.given) {
    if (adcirc || std::filesystem::path(path).filename() == "hgrid.gr3")
      findings.add("boundary", "the file has lists of its nodes", "they are missing", -1);
    return;
  }
  const bool barriers =
      std::ranges::any_of(boundary.lists, [](const NodeList& list) { return list.is_barrier; });
  ListCheck lists(mesh,
                  {.outer = schism || adcirc,
                   .land_right = adcirc,
                   .open_unclosed = schism,
                   .islands_close = schism || adcirc,
                   .all = (schism || adcirc) && !barriers},
                  findings);
  for (const NodeList& list : boundary.lists)
    if (!list.is_barrier)
      lists.check(list);
  lists.finish();
  check_count("open boundary", boundary.open_nodes, true, boundary, findings);
  check_count("land boundary", boundary.other_nodes, false, boundary, findings);
}

void check_fesom(const MeshFile& file, Findings& findings) {
  const Mesh& mesh = *file.mesh;
  check_nodes(mesh, false, findings);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    if ((mesh.neighbours.col(t).array() < 0).count() > 1)
      findings.add("triangles", "each has two neighbours or more",
                   message("that of {}, {} and {} has fewer", node(mesh.triangles(0, t)),
                           node(mesh.triangles(1, t)), node(mesh.triangles(2, t))),
                   t);
  const auto flags = std::ranges::find(file.fields, "coast", &MeshField::name);
  if (flags == file.fields.end() || flags->values.isZero(0))
    return;
  std::set<std::int32_t> boundary;
  for (const auto& [edge, lists] : outer_edges(mesh))
    boundary.insert(edge.first);
  for (std::int32_t site = 0; site < flags->values.size(); ++site)
    if ((flags->values[site] != 0) != boundary.contains(site))
      findings.add("coast", "flags other than 0 stand at the boundary",
                   message("{} has {}", node(site), flags->values[site]), site);
}

} // namespace

std::vector<Deviation> check_coast(const std::string& path, const MeshFile& file) {
  const std::optional<Format> format = format_of_name(path);
  if (!file.mesh || !format)
    return {};
  Findings findings;
  if (*format == Format::fesom)
    check_fesom(file, findings);
  else if (*format == Format::schism || *format == Format::adcirc || *format == Format::sms ||
           *format == Format::msh)
    check_lists(path, *format, *file.mesh, findings);
  return findings.result();
}

} // namespace calotte::io_detail
