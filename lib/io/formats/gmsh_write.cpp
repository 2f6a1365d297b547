// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/boundary_pieces.h"
#include "io/formats/formats.h"

#include <array>
#include <span>
#include <string>
#include <vector>

// Gmsh 4.1 as text (the format MSH of its manual). Each piece of the boundary is a curve of the
// geometry, and the triangles are its only surface. Physical groups name what they are.

namespace calotte::io_detail {
namespace {

/// The physical groups: of curves in the order of BoundaryKind, of the surface the last.
constexpr std::array<const char*, 4> groups{"open", "land", "island", "mesh"};

/// The sites of a piece, the first again at the end of a closed one.
std::vector<std::int32_t> whole(BoundaryPiece piece) {
  if (piece.closed)
    piece.sites.push_back(piece.sites.front());
  return std::move(piece.sites);
}

/// Writes the least and the greatest coordinates of the sites.
template <class Sites> void put_box(Writer& out, const Mesh& mesh, const Sites& sites) {
  const Points3 points = mesh.points(Eigen::all, sites);
  const Eigen::Vector3d low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  for (const Eigen::Vector3d& end : {low, high})
    for (const double x : end)
      out.text(" ").number(x);
}

void put_geometry(Writer& out, const Mesh& mesh, const std::vector<BoundaryPiece>& pieces) {
  out.text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n");
  for (std::size_t k = 0; k < groups.size(); ++k)
    out.text(k < 3 ? "1 " : "2 ")
        .number(static_cast<std::int64_t>(k + 1))
        .text(std::string(" \"") + groups[k] + "\"\n");
  out.text("$EndPhysicalNames\n$Entities\n0 ").number(std::ssize(pieces)).text(" 1 0\n");
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    out.number(static_cast<std::int64_t>(k + 1));
    put_box(out, mesh, pieces[k].sites);
    out.text(" 1 ").number(static_cast<std::int64_t>(pieces[k].kind) + 1).text(" 0\n");
  }
  out.text("1");
  put_box(out, mesh, Eigen::all);
  out.text(" 1 4 ").number(std::ssize(pieces));
  for (std::size_t k = 0; k < pieces.size(); ++k)
    out.text(" ").number(static_cast<std::int64_t>(k + 1));
  out.text("\n$EndEntities\n");
}

void put_nodes(Writer& out, const Mesh& mesh) {
  const std::int64_t n = mesh.points.cols();
  out.text("$Nodes\n1 ").number(n).text(" 1 ").number(n).text("\n2 1 0 ").number(n).text("\n");
  for (std::int64_t i = 1; i <= n; ++i)
    out.number(i).text("\n");
  for (std::int64_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k)
      out.number(mesh.points(k, i)).text(k < 2 ? " " : "\n");
  out.text("$EndNodes\n");
}

void put_elements(Writer& out, const Mesh& mesh, const std::vector<BoundaryPiece>& pieces) {
  std::int64_t elements = mesh.triangles.cols(), element = 0;
  for (const BoundaryPiece& piece : pieces)
    elements += std::ssize(piece.sites) - (piece.closed ? 0 : 1);
  out.text("$Elements\n").number(std::ssize(pieces) + 1).text(" ").number(elements);
  out.text(" 1 ").number(elements).text("\n");
  const auto put = [&](std::span<const std::int32_t> sites) {
    out.number(++element);
    for (const std::int32_t site : sites)
      out.text(" ").number(std::int64_t{site} + 1);
    out.text("\n");
  };
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const std::vector<std::int32_t> sites = whole(pieces[k]);
    out.text("1 ").number(static_cast<std::int64_t>(k + 1)).text(" 1 ");
    out.number(std::ssize(sites) - 1).text("\n");
    for (std::size_t i = 0; i + 1 < sites.size(); ++i)
      put(std::span(sites).subspan(i, 2));
  }
  out.text("2 1 2 ").number(std::int64_t{mesh.triangles.cols()}).text("\n");
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    put({mesh.triangles.col(t).data(), 3});
  out.text("$EndElements\n");
}

} // namespace

void put_gmsh(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  const std::vector<BoundaryPiece> pieces = boundary_pieces(mesh, options.open_sites);
  Writer out(sink);
  put_geometry(out, mesh, pieces);
  put_nodes(out, mesh);
  put_elements(out, mesh, pieces);
  out.flush();
}

} // namespace calotte::io_detail
