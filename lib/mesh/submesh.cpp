// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/submesh.h"

#include "base/points.h"
#include "base/triangle.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace calotte::mesh_detail {
namespace {

using Rim = std::vector<Submesh::RimEdge>;

/// Replaces numbers of sites by those of a table.
void renumber_sites(Submesh& part, const auto& own) {
  for (std::int32_t& site : part.faces.triangles.reshaped())
    site = own(site);
  for (Submesh::RimEdge& edge : part.rim)
    edge.from = own(edge.from), edge.to = own(edge.to);
  std::sort(part.rim.begin(), part.rim.end(), [](const auto& a, const auto& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
}

/// Copies the triangles, from their lowest sites on, with neighbours by their own numbers.
void take_triangles(const Triangles& triangles, const Triangles& neighbours, Submesh& out) {
  std::vector<std::pair<std::int32_t, std::int32_t>> own; // by number in the mesh
  for (const std::int32_t t : out.triangles)
    own.emplace_back(t, static_cast<std::int32_t>(own.size()));
  std::sort(own.begin(), own.end());
  out.faces.triangles.resize(3, std::ssize(own));
  out.faces.neighbours.resize(3, std::ssize(own));
  for (std::int64_t k = 0; k < std::ssize(own); ++k) {
    const std::int32_t t = out.triangles[static_cast<std::size_t>(k)];
    int w = 0;
    triangles.col(t).minCoeff(&w);
    for (int v = 0; v < 3; ++v, w = next_vertex(w)) {
      const std::int32_t u = neighbours(w, t);
      const auto at = std::lower_bound(own.begin(), own.end(), std::pair{u, 0});
      const bool inside = at != own.end() && at->first == u;
      out.faces.triangles(v, k) = triangles(w, t);
      out.faces.neighbours(v, k) = inside ? at->second : -1;
      if (!inside)
        out.rim.push_back({t, w, triangles(next_vertex(w), t), triangles(previous_vertex(w), t)});
    }
  }
}

/// The index of an edge in the list of the rim.
std::size_t index_in(const Rim& rim, std::int32_t from, std::int32_t to) {
  const auto at = std::lower_bound(
      rim.begin(), rim.end(), std::pair{from, to}, [](const auto& edge, const auto& ends) {
        return std::tie(edge.from, edge.to) < std::tie(ends.first, ends.second);
      });
  return static_cast<std::size_t>(at - rim.begin());
}

} // namespace

Submesh extract(const Triangles& triangles, const Triangles& neighbours,
                std::vector<std::int32_t> part) {
  Submesh out{.triangles = std::move(part)};
  take_triangles(triangles, neighbours, out);
  const auto corners = out.faces.triangles.reshaped();
  std::vector<std::int32_t>& sites = out.sites;
  sites.assign(corners.begin(), corners.end());
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  renumber_sites(out, [&](std::int32_t site) {
    return static_cast<std::int32_t>(std::lower_bound(sites.begin(), sites.end(), site) -
                                     sites.begin());
  });
  return out;
}

std::int32_t put_first(Submesh& part, const std::vector<std::uint8_t>& marks) {
  std::vector<std::int32_t> order = themselves(std::ssize(part.sites)), own(order.size()), sites;
  const auto rest = std::stable_partition(order.begin(), order.end(), [&](std::int32_t site) {
    return marks[static_cast<std::size_t>(site)] != 0;
  });
  for (const std::int32_t site : order) {
    own[static_cast<std::size_t>(site)] = static_cast<std::int32_t>(sites.size());
    sites.push_back(part.sites[static_cast<std::size_t>(site)]);
  }
  part.sites = std::move(sites);
  renumber_sites(part, [&](std::int32_t site) { return own[static_cast<std::size_t>(site)]; });
  return static_cast<std::int32_t>(rest - order.begin());
}

void splice(const Submesh& part, Connectivity& mesh) {
  std::vector<std::int32_t> beyond; // by edge of the rim
  for (const Submesh::RimEdge& edge : part.rim)
    beyond.push_back(mesh.neighbours(edge.across, edge.triangle));
  const auto site = [&](int v, std::int64_t k) {
    return part.sites[static_cast<std::size_t>(part.faces.triangles(v, k))];
  };
  for (std::int64_t k = 0; k < part.faces.triangles.cols(); ++k) {
    const std::int32_t t = part.triangles[static_cast<std::size_t>(k)];
    for (int v = 0; v < 3; ++v) {
      mesh.triangles(v, t) = site(v, k);
      if (const std::int32_t own = part.faces.neighbours(v, k); own >= 0) {
        mesh.neighbours(v, t) = part.triangles[static_cast<std::size_t>(own)];
        continue;
      }
      const int a = next_vertex(v), b = previous_vertex(v);
      const std::int32_t out =
          beyond[index_in(part.rim, part.faces.triangles(a, k), part.faces.triangles(b, k))];
      mesh.neighbours(v, t) = out;
      for (int w = 0; out >= 0 && w < 3; ++w)
        if (mesh.triangles(next_vertex(w), out) == site(b, k) &&
            mesh.triangles(previous_vertex(w), out) == site(a, k))
          mesh.neighbours(w, out) = t;
    }
  }
}

Mesh as_mesh(const Submesh& part, const Mesh& whole) {
  return {whole.points(Eigen::all, part.sites), part.faces.triangles, part.faces.neighbours,
          themselves(std::ssize(part.sites)), whole.surface};
}

} // namespace calotte::mesh_detail
