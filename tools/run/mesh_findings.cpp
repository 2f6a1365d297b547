// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/mesh_findings.h"

#include "run/shapes.h"
#include "text/text.h"

namespace calotte::tools {

Findings findings_of(const Mesh& mesh, const ProgressCallback& progress) {
  Findings found;
  found.check = check(mesh, progress);
  found.delaunay = found.check.passed();
  if (found.delaunay)
    return found;
  const std::string strict = found.check.failure;
  found.check = check_surface(mesh, progress);
  found.failure = found.check.failure;
  if (!found.failure.empty())
    return found;
  const EdgeCounts& edges = found.edges.emplace(count_edges(mesh));
  if (edges.not_delaunay > 0)
    found.failure = message("{} of {} edges are not Delaunay; the first is from site {} to {}",
                            edges.not_delaunay, edges.edges, edges.first[0], edges.first[1]);
  else if (edges.boundary == 0 && edges.cocircular == 0)
    found.failure = strict;
  return found;
}

bool has_own_triangles(const MeshFile& file) {
  return file.plane() ? !file.polygons || file.mesh->surface.period().maxCoeff() > 0
                      : file.mesh && !(file.polygons && file.mesh->closed());
}

std::string failure_of(const MeshFile& file, const ProgressCallback& progress) {
  const std::string failure =
      has_own_triangles(file) ? findings_of(*file.mesh, progress).failure : "";
  return failure.empty() && file.polygons ? without_area(shapes(*file.polygons)) : failure;
}

} // namespace calotte::tools
