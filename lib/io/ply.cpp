// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/binary.h"
#include "io/formats.h"

// The Stanford polygon format (Turk, 1994), written in binary in this machine's order of bytes.

namespace calotte::io_detail {
namespace {

std::string head(std::int64_t points, std::int64_t triangles) {
  return "ply\nformat " +
         std::string(little_endian ? "binary_little_endian" : "binary_big_endian") +
         " 1.0\nelement vertex " + std::to_string(points) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(triangles) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

} // namespace

void put_ply(const Sink& sink, const Mesh& mesh) {
  Writer out(sink);
  out.text(head(mesh.points.cols(), mesh.triangles.cols()));
  out.text(bytes_of(mesh.points.data(), mesh.points.size()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    out.raw(std::uint8_t{3}).text(bytes_of(mesh.triangles.col(t).data(), 3));
  out.flush();
}

} // namespace calotte::io_detail
