// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/coastal_grid.h"

#include "base/lonlat.h"
#include "base/points.h"
#include "io/bytes/file_error.h"
#include "io/formats/formats.h"
#include "io/formats/write_mesh.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

// SCHISM's hgrid.gr3 and ADCIRC's fort.14 are one format of text (the manuals of both models): a
// title; the numbers of elements and of nodes; a node a line: id, x, y, depth, positive down; an
// element a line: id, 3, three ids; the number of open boundaries and that of their nodes in all,
// and for each the number of its nodes, which follow; then the same for boundaries of land, whose
// number of nodes is followed by a type. Ids count from 1.
//
// In ADCIRC land is to the right of a list. It closes a list of an island itself, and one of the
// mainland where its first node comes again at its end. SCHISM has two lists in place of a closed
// one that is not an island. Neither model reads a boundary that passes a node twice.

namespace calotte::io_detail {
namespace {

/// What differs between the two models.
struct CoastalModel {
  const char* name;
  int land, island; ///< types of boundaries without flow
  bool repeats;     ///< the first node of a closed list of land comes again
};

constexpr CoastalModel schism_model{"SCHISM", 0, 1, false};
constexpr CoastalModel adcirc_model{"ADCIRC", 20, 21, true};

double depth_at(const WriteOptions& options, Eigen::Index site) {
  const double depth = options.site_depth.size() > 0 ? options.site_depth[site] : 0;
  return depth == 0 ? 0 : depth; // no -0
}

void put_node(Writer& out, const Mesh& mesh, Eigen::Index i, double last) {
  const base_detail::LonLat at = base_detail::lonlat_of(column(mesh.points, i));
  out.number(std::int64_t{i + 1}).text(" ").number(at.longitude).text(" ");
  out.number(at.latitude).text(" ").number(last).text("\n");
}

void put_ids(Writer& out, const Triangles& triangles, Eigen::Index t) {
  for (const std::int32_t site : triangles.col(t))
    out.text(" ").number(std::int64_t{site} + 1);
}

std::int64_t count_nodes(const std::vector<BoundaryPiece>& pieces, bool open) {
  std::int64_t nodes = 0;
  for (const BoundaryPiece& piece : pieces)
    nodes += (piece.kind == BoundaryKind::open) == open ? std::ssize(piece.sites) : 0;
  return nodes;
}

void put_lists(Writer& out, const CoastalModel& model, const std::vector<BoundaryPiece>& pieces,
               bool open) {
  const auto belongs = [&](const BoundaryPiece& piece) {
    return (piece.kind == BoundaryKind::open) == open;
  };
  const std::string what = open ? "open boundaries" : "land boundaries";
  out.number(std::int64_t{std::ranges::count_if(pieces, belongs)}).text(" = number of " + what);
  out.text("\n").number(count_nodes(pieces, open)).text(" = number of nodes of " + what + "\n");
  for (const BoundaryPiece& piece : pieces) {
    if (!belongs(piece))
      continue;
    const int type = open ? 0 : piece.kind == BoundaryKind::island ? model.island : model.land;
    out.number(std::ssize(piece.sites)).text(" ").number(std::int64_t{type}).text("\n");
    for (const std::int32_t site : piece.sites)
      out.number(std::int64_t{site} + 1).text("\n");
  }
}

/// The pieces of the boundary in the form that the model takes.
std::vector<BoundaryPiece> lists_for(const CoastalModel& model, const Mesh& mesh,
                                     const WriteOptions& options) {
  std::vector<BoundaryPiece> pieces = boundary_pieces(mesh, options.open_sites);
  if (!model.repeats)
    return halved(std::move(pieces), {BoundaryKind::open, BoundaryKind::land});
  pieces = halved(std::move(pieces), {BoundaryKind::open});
  for (BoundaryPiece& piece : pieces)
    if (piece.closed && piece.kind == BoundaryKind::land)
      piece.sites.push_back(piece.sites.front());
  return pieces;
}

void write_coastal(const std::string& path, const Mesh& mesh, const WriteOptions& options,
                   const CoastalModel& model) {
  require_simple_boundary(path, mesh, model.name);
  put_file(path, options, mesh.points.cols(), [&](const Sink& sink) {
    Writer out(sink);
    out.text("calotte, degrees\n"); // 24 characters at most
    out.number(std::int64_t{mesh.triangles.cols()}).text(" ");
    out.number(std::int64_t{mesh.points.cols()}).text(" = numbers of elements and nodes\n");
    for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
      put_node(out, mesh, i, depth_at(options, i));
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
      out.number(std::int64_t{t + 1}).text(" 3");
      put_ids(out, mesh.triangles, t);
      out.text("\n");
    }
    const std::vector<BoundaryPiece> pieces = lists_for(model, mesh, options);
    for (const bool open : {true, false})
      put_lists(out, model, pieces, open);
    out.flush();
  });
}

/// Writes a string of nodes: lines of ten ids at most, the last one negative, then its number.
void put_string(Writer& out, const std::vector<std::int32_t>& sites, std::int64_t number) {
  constexpr std::size_t per_line = 10;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    out.text(k % per_line == 0 ? "NS " : " ");
    const bool last = k + 1 == sites.size();
    out.number((last ? -1 : 1) * (std::int64_t{sites[k]} + 1));
    if (last)
      out.text(" ").number(number).text("\n");
    else if (k % per_line == per_line - 1)
      out.text("\n");
  }
}

} // namespace

void write_schism(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    if (mesh.points(0, i) == 0 && mesh.points(1, i) == 0 && mesh.points(2, i) < 0)
      refuse_path(path, "site {} is the south pole, which SCHISM refuses; move it", i);
  write_coastal(path, mesh, options, schism_model);
}

void write_adcirc(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  write_coastal(path, mesh, options, adcirc_model);
}

// A file .2dm of SMS (the manual of its formats) has a card a line: E3T id, three ids, material; ND
// id x y z, where z is a height; NS for strings of nodes.
void put_sms(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  Writer out(sink);
  out.text("MESH2D\n");
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    out.text("E3T ").number(std::int64_t{t + 1});
    put_ids(out, mesh.triangles, t);
    out.text(" 1\n");
  }
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    put_node(out.text("ND "), mesh, i, 0 - depth_at(options, i));
  std::int64_t number = 0;
  for (BoundaryPiece& piece : boundary_pieces(mesh, options.open_sites)) {
    if (piece.closed)
      piece.sites.push_back(piece.sites.front());
    put_string(out, piece.sites, ++number);
  }
  out.flush();
}

} // namespace calotte::io_detail
