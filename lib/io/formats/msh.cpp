// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_error.h"
#include "io/formats/formats.h"
#include "io/formats/gmsh.h"
#include "io/shapes/jigsaw.h"

#include <utility>

namespace calotte::io_detail {

void put_msh(const Sink& sink, const Mesh& mesh) {
  // The tag 0 ends the lines of points, edges and triangles.
  Writer out(sink);
  const bool plane = !mesh.surface.is_sphere();
  const Eigen::Index n = mesh.points.cols();
  out.text("# JIGSAW mesh made by calotte\nMSHID=3;EUCLIDEAN-MESH\n");
  out.text(plane ? "NDIMS=2\nPOINT=" : "NDIMS=3\nPOINT=").number(std::int64_t{n}).text("\n");
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int k = 0; k < (plane ? 2 : 3); ++k)
      out.number(mesh.points(k, i)).text(";");
    out.text("0\n");
  }
  out.text("POWER=").number(std::int64_t{n}).text(";1\n"); // weights of a Voronoi diagram
  for (Eigen::Index i = 0; i < n; ++i)
    out.text("0\n");
  const auto ends_here = [&](Eigen::Index t, int v) { return mesh.neighbours(v, t) < 0; };
  std::int64_t outer = 0;
  for (Eigen::Index t = 0; t < mesh.neighbours.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      outer += ends_here(t, v) ? 1 : 0;
  if (outer > 0)
    out.text("EDGE2=").number(outer).text("\n");
  for (Eigen::Index t = 0; outer > 0 && t < mesh.neighbours.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (ends_here(t, v))
        out.number(std::int64_t{mesh.triangles((v + 1) % 3, t)})
            .text(";")
            .number(std::int64_t{mesh.triangles((v + 2) % 3, t)})
            .text(";0\n");
  out.text("TRIA3=").number(std::int64_t{mesh.triangles.cols()}).text("\n");
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    for (const std::int32_t site : mesh.triangles.col(t))
      out.number(std::int64_t{site}).text(";");
    out.text("0\n");
  }
  out.flush();
}

RawMesh get_msh(std::istream& in, const std::string& name) {
  if (is_gmsh(in))
    return std::move(get_gmsh(in, name).raw);
  const JigsawFile file = read_jigsaw(in, name);
  if (file.points.cols() == 0)
    fail_file(name, "no POINT section; give a mesh of the sphere, with points");
  const double radius =
      file.dimensions == 2 && !is_planar_mesh(file) ? require_sphere_radius(file, name) : 1;
  return {radius * make_columns(file, name), file.triangles};
}

} // namespace calotte::io_detail
