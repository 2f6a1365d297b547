// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/binary.h"
#include "io/file.h"
#include "io/formats.h"

#include <calotte/error.h>

#include <array>

// The Stanford polygon format (Turk, 1994), binary in this machine's order of bytes.

namespace calotte::io_detail {
namespace {

constexpr std::int64_t face_size = 1 + 3 * sizeof(std::int32_t);

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

Soup get_ply(std::istream& in, const std::string& name) {
  const std::string content = read_all(in, name);
  Bytes bytes(content, name);
  const auto points = count_after(content, "element vertex ");
  const auto triangles = count_after(content, "element face ");
  const std::string problem = "its head is not that of a .ply file which calotte wrote (binary, "
                              "double x y z, triangles of int); convert it to .off";
  if (!points || !triangles)
    bytes.fail(problem);
  bytes.take(head(*points, *triangles), problem);

  const std::string_view coordinates = bytes.take(24 * *points);
  const std::string_view faces = bytes.take(face_size * *triangles);
  bytes.finish();
  Soup soup{Points3(3, *points), Triangles(3, *triangles)};
  std::memcpy(soup.points.data(), coordinates.data(), coordinates.size());
  for (std::int64_t t = 0; t < *triangles; ++t) {
    const char* const face = faces.data() + face_size * t;
    if (*face != 3)
      bytes.fail("face " + std::to_string(t) + " is not a triangle; only triangles are read");
    std::memcpy(soup.triangles.col(t).data(), face + 1, 3 * sizeof(std::int32_t));
  }
  return soup;
}

} // namespace calotte::io_detail
