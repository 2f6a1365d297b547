// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "io/formats/formats.h"
#include "io/formats/gmsh.h"
#include "io/shapes/jigsaw.h"

#include <calotte/error.h>

namespace calotte::io_detail {

void put_msh(const Sink& sink, const Mesh& mesh) {
  Writer out(sink);
  out.text("# JIGSAW mesh made by calotte\nMSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT=");
  out.number(std::int64_t{mesh.points.cols()}).text("\n");
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    for (const double coordinate : mesh.points.col(i))
      out.number(coordinate).text(";");
    out.text("0\n"); // a tag, which JIGSAW expects of points and triangles
  }
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
    return get_gmsh(in, name);
  const JigsawFile file = read_jigsaw(in, name);
  if (file.points.cols() == 0)
    throw Error(ErrorCode::parse,
                name + ": no POINT section; give a mesh of the sphere, with points");
  if (file.dimensions == 2 && file.kind == "euclidean-mesh") // of the plane
    return {with_z(file.points), file.triangles};
  if (file.dimensions == 3)
    return {file.points, file.triangles};
  const auto& [a, b, c] = file.radii;
  if (a != b || b != c)
    throw Error(ErrorCode::parse, name + ": the radii differ; only meshes of a sphere are read");
  return {a * directions_of(file, name), file.triangles};
}

} // namespace calotte::io_detail
