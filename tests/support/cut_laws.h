// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/netcdf_content.h"

#include <cmath>
#include <deque>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// The rules of a limited-area file, read from it and from the file that it was cut from.
namespace calotte::test::cut_laws {

/// Cells, edges or vertices.
struct Kind {
  std::string name, dimension;
};
inline const std::vector<Kind> kinds{
    {"Cell", "nCells"}, {"Edge", "nEdges"}, {"Vertex", "nVertices"}};

/// Two files, and the things of the source that the new file has, by longitude and latitude.
struct Pair {
  Contents before, after;
  std::map<std::string, std::vector<int>> old; ///< by dimension: of each new id
  std::map<std::string, std::vector<int>> now; ///< of each old id; -1 if it is left out

  Pair(const std::string& source, const std::string& target)
      : before(contents_of(source)), after(contents_of(target)) {
    for (const Kind& kind : kinds)
      match(kind);
  }
  void match(const Kind& kind) {
    std::map<std::pair<double, double>, int> places;
    const std::string lat = "lat" + kind.name, lon = "lon" + kind.name;
    for (std::size_t i = 0; i < before.dimensions.at(kind.dimension); ++i)
      places[{before.at(lat, i), before.at(lon, i)}] = static_cast<int>(i);
    now[kind.dimension].assign(before.dimensions.at(kind.dimension), -1);
    for (std::size_t i = 0; i < after.dimensions.at(kind.dimension); ++i) {
      const auto found = places.find({after.at(lat, i), after.at(lon, i)});
      REQUIRE(found != places.end());
      old[kind.dimension].push_back(found->second);
      now[kind.dimension][static_cast<std::size_t>(found->second)] = static_cast<int>(i);
    }
  }
  bool kept(const std::string& dimension, int id) const {
    return id >= 0 && now.at(dimension)[static_cast<std::size_t>(id)] >= 0;
  }
};

/// Distances from the region, in cells, of the source's cells.
inline std::vector<int> distances(const Contents& file, const std::vector<bool>& inside) {
  std::vector<int> distance(inside.size(), -1);
  std::deque<int> queue;
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i]) {
      distance[i] = 0;
      queue.push_back(static_cast<int>(i));
    }
  for (; !queue.empty(); queue.pop_front()) {
    const auto cell = static_cast<std::size_t>(queue.front());
    for (std::size_t k = 0; k < static_cast<std::size_t>(file.at("nEdgesOnCell", cell)); ++k)
      if (const int other = file.id("cellsOnCell", cell, k);
          other >= 0 && distance[static_cast<std::size_t>(other)] < 0) {
        distance[static_cast<std::size_t>(other)] = distance[cell] + 1;
        queue.push_back(other);
      }
  }
  return distance;
}

/// Cells are those within `rings` of the region, with that distance as mask; edges and vertices are
/// those that touch one, with the least mask of these.
inline void check_masks(const Pair& pair, const std::vector<bool>& inside, int rings) {
  const std::vector<int> distance = distances(pair.before, inside);
  const auto mask_of = [&](int cell) {
    const int d = cell < 0 ? -1 : distance[static_cast<std::size_t>(cell)];
    return d <= rings ? d : -1;
  };
  const auto check = [&](const Kind& kind, const std::string& cells_on) {
    int wrong = 0;
    for (std::size_t i = 0; i < pair.before.dimensions.at(kind.dimension); ++i) {
      int mask = -1;
      const std::size_t width = cells_on.empty() ? 1 : pair.before.variables.at(cells_on).width();
      for (std::size_t k = 0; k < width; ++k) {
        const int cell = cells_on.empty() ? static_cast<int>(i) : pair.before.id(cells_on, i, k);
        if (const int of = mask_of(cell); of >= 0)
          mask = mask < 0 ? of : std::min(mask, of);
      }
      const int now = pair.now.at(kind.dimension)[i];
      wrong += (mask >= 0) != (now >= 0) ||
               (now >= 0 && pair.after.at("bdyMask" + kind.name, static_cast<std::size_t>(now)) !=
                                static_cast<double>(mask));
    }
    CHECK(wrong == 0);
  };
  check(kinds[0], "");
  check(kinds[1], "cellsOnEdge");
  check(kinds[2], "cellsOnVertex");
}

/// By variable: the dimension that its ids stand for.
inline const std::map<std::string, std::string>& ids_of() {
  static const std::map<std::string, std::string> all{
      {"cellsOnCell", "nCells"},       {"cellsOnEdge", "nCells"},      {"cellsOnVertex", "nCells"},
      {"edgesOnCell", "nEdges"},       {"edgesOnEdge", "nEdges"},      {"edgesOnVertex", "nEdges"},
      {"verticesOnCell", "nVertices"}, {"verticesOnEdge", "nVertices"}};
  return all;
}

/// Each id is that of the same thing, at its place; 0 if it is left out. Numbers run from 1 on.
inline void check_ids(const Pair& pair) {
  for (const auto& [name, of] : ids_of()) {
    const Content& content = pair.after.variables.at(name);
    const std::vector<int>& rows = pair.old.at(content.dimensions[0]);
    int wrong = 0;
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t k = 0; k < content.width(); ++k) {
        const int old = pair.before.id(name, static_cast<std::size_t>(rows[row]), k);
        const int now = old < 0 ? -1 : pair.now.at(of)[static_cast<std::size_t>(old)];
        wrong += pair.after.id(name, row, k) != now;
      }
    CAPTURE(name);
    CHECK(wrong == 0);
  }
  for (const Kind& kind : kinds)
    for (std::size_t i = 0; i < pair.after.dimensions.at(kind.dimension); ++i)
      REQUIRE(pair.after.id("indexTo" + kind.name + "ID", i) == static_cast<int>(i));
}

/// Whether the values of a variable may differ from the source's.
inline bool is_special(const std::string& name, const std::set<std::string>& scaled) {
  return ids_of().contains(name) || name.starts_with("indexTo") || name.starts_with("bdyMask") ||
         name == "boundaryVertex" || name == "weightsOnEdge" || scaled.contains(name);
}

/// The dimension with rows left out; the number of dimensions if there is none.
inline std::size_t axis_of(const Content& content) {
  std::size_t axis = 0;
  while (axis < content.shape.size() && content.dimensions[axis] != "nCells" &&
         content.dimensions[axis] != "nEdges" && content.dimensions[axis] != "nVertices")
    ++axis;
  return axis;
}

/// Whether each row has the bytes of the source's.
inline bool same_rows(const Pair& pair, const Content& before, const Content& after) {
  const std::size_t axis = axis_of(before);
  if (axis == before.shape.size())
    return before.bytes == after.bytes;
  const std::vector<int>& old = pair.old.at(before.dimensions[axis]);
  const std::size_t row = before.row_bytes(axis), of_slab = row * before.shape[axis];
  std::string expected;
  for (std::size_t slab = 0; slab < before.bytes.size(); slab += of_slab)
    for (const int i : old)
      expected += before.bytes.substr(slab + static_cast<std::size_t>(i) * row, row);
  return expected == after.bytes;
}

/// Fields, and the attributes of all variables, are those of the source.
inline void check_fields(const Pair& pair, const std::set<std::string>& scaled) {
  for (const auto& [name, before] : pair.before.variables) {
    CAPTURE(name);
    REQUIRE(pair.after.variables.contains(name));
    const Content& after = pair.after.variables.at(name);
    CHECK(after.type == before.type);
    CHECK(after.dimensions == before.dimensions);
    CHECK(after.attributes == before.attributes);
    CHECK((is_special(name, scaled) || same_rows(pair, before, after)));
  }
  for (const auto& [name, size] : pair.before.dimensions)
    if (!pair.old.contains(name))
      CHECK(pair.after.dimensions.at(name) == size);
}

/// Weights are those of the source; those of missing edges are 0.
inline void check_weights(const Pair& pair) {
  const std::size_t width = pair.after.variables.at("weightsOnEdge").width();
  int wrong = 0;
  for (std::size_t e = 0; e < pair.after.dimensions.at("nEdges"); ++e)
    for (std::size_t k = 0; k < width; ++k) {
      const auto old = static_cast<std::size_t>(pair.old.at("nEdges")[e]);
      const bool lost = pair.after.id("edgesOnEdge", e, k) < 0;
      wrong += pair.after.at("weightsOnEdge", e, k) !=
               (lost ? 0.0 : pair.before.at("weightsOnEdge", old, k));
    }
  CHECK(wrong == 0);
}

/// Each cell has two neighbours or more; vertices that lack a cell say so.
inline void check_boundary(const Contents& file) {
  for (std::size_t i = 0; i < file.dimensions.at("nCells"); ++i) {
    int neighbours = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(file.at("nEdgesOnCell", i)); ++k)
      neighbours += file.id("cellsOnCell", i, k) >= 0;
    REQUIRE(neighbours >= 2);
  }
  for (std::size_t v = 0; v < file.dimensions.at("nVertices"); ++v) {
    bool all = true;
    for (std::size_t j = 0; j < 3; ++j)
      all = all && file.id("cellsOnVertex", v, j) >= 0;
    REQUIRE(file.at("boundaryVertex", v) == (all ? 0 : 1));
  }
}

/// "nCells nInteriorEdges", then the 1-based neighbours of each cell.
inline void check_graph(const Contents& file, const std::string& path) {
  std::size_t inner = 0;
  for (std::size_t e = 0; e < file.dimensions.at("nEdges"); ++e)
    inner += file.id("cellsOnEdge", e, 0) >= 0 && file.id("cellsOnEdge", e, 1) >= 0;
  std::ostringstream expected;
  expected << file.dimensions.at("nCells") << " " << inner << "\n";
  for (std::size_t i = 0; i < file.dimensions.at("nCells"); ++i) {
    std::string line;
    for (std::size_t k = 0; k < static_cast<std::size_t>(file.at("nEdgesOnCell", i)); ++k)
      if (const int other = file.id("cellsOnCell", i, k); other >= 0)
        line.append(line.empty() ? "" : " ").append(std::to_string(other + 1));
    expected << line << "\n";
  }
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  CHECK((text.str() == expected.str()));
}

} // namespace calotte::test::cut_laws
