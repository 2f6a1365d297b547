// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/binary.h"
#include "io/formats/formats.h"

#include <span>

// The Stanford polygon format (Turk, 1994), written in binary in this machine's order of bytes.

namespace calotte::io_detail {
namespace {

/// \param count the type of the number of corners of a face.
std::string ply_head(std::int64_t points, std::int64_t faces, const std::string& count) {
  return "ply\nformat " +
         std::string(little_endian ? "binary_little_endian" : "binary_big_endian") +
         " 1.0\nelement vertex " + std::to_string(points) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(faces) + "\nproperty list " + count + " int vertex_indices\nend_header\n";
}

} // namespace

void put_ply(const Sink& sink, const Mesh& mesh) {
  Writer out(sink);
  out.text(ply_head(mesh.points.cols(), mesh.triangles.cols(), "uchar"));
  out.text(bytes_of(mesh.points.data(), mesh.points.size()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    out.raw(std::uint8_t{3}).text(bytes_of(mesh.triangles.col(t).data(), 3));
  out.flush();
}

void put_ply(const Sink& sink, const Polygons& polygons) {
  Writer out(sink);
  out.text(ply_head(polygons.corners.cols(), polygons.size(), "int"));
  out.text(bytes_of(polygons.corners.data(), polygons.corners.size()));
  for (std::int64_t i = 0; i < polygons.size(); ++i) {
    const std::span<const std::int32_t> ids = polygons.ids[i];
    out.raw(static_cast<std::int32_t>(ids.size())).text(bytes_of(ids.data(), std::ssize(ids)));
  }
  out.flush();
}

} // namespace calotte::io_detail
