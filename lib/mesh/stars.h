// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/faces.h"

#include <cstdint>
#include <vector>

namespace calotte::mesh_detail {

/// The triangles around the sites of a mesh, open or closed. A walk starts in the first triangle at
/// a site; at a boundary, in the triangle at which the boundary leaves the site. At a site where
/// the boundary passes more than once, the walk visits one of the fans.
class Stars {
public:
  /// \pre neighbours are -1 or match the triangles.
  explicit Stars(const Faces& faces)
      : faces_(faces), first_(static_cast<std::size_t>(faces.sites()), no_corner),
        size_(first_.size(), 0) {
    for (std::int32_t t = 0; t < faces.triangles(); ++t)
      for (int v = 0; v < 3; ++v) {
        const auto site = static_cast<std::size_t>(faces.vertex(t, v));
        ++size_[site];
        if (!exists(first_[site]) || faces.neighbour(t, previous_vertex(v)) < 0)
          first_[site] = {t, v};
      }
  }

  /// The corner where the walk around a site starts; none for a site in no triangle.
  Corner first(std::int32_t site) const { return first_[static_cast<std::size_t>(site)]; }
  /// The number of triangles at a site, in all its fans.
  std::int32_t size(std::int32_t site) const { return size_[static_cast<std::size_t>(site)]; }

  /// Whether triangles surround a site.
  bool is_closed(std::int32_t site) const {
    const Corner at = first(site);
    return exists(at) && faces_.neighbour(at.triangle, previous_vertex(at.vertex)) >= 0;
  }

  /// Calls body(corner) for the triangles around a site; true if they close.
  template <class Body> bool for_each_corner(std::int32_t site, const Body& body) const {
    return exists(first(site)) && !exists(walk_around(faces_, first(site), body));
  }

  /// Calls body(other) for the neighbours of a site; true if its star closes.
  template <class Body> bool for_each_neighbour(std::int32_t site, const Body& body) const {
    Corner last = no_corner;
    const bool closed = for_each_corner(site, [&](Corner corner) {
      body(following_site(faces_, corner));
      last = corner;
    });
    if (!closed && exists(last))
      body(preceding_site(faces_, last));
    return closed;
  }

private:
  Faces faces_;
  std::vector<Corner> first_;
  std::vector<std::int32_t> size_;
};

} // namespace calotte::mesh_detail
