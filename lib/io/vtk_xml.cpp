// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk_xml.h"

#include "binary.h"
#include "file.h"

#include <algorithm>

namespace calotte::detail {
namespace {

constexpr const char* tail = "\n  </AppendedData>\n</VTKFile>\n";
constexpr std::uint8_t triangle_type = 5;

/// Sizes of the appended blocks in bytes, in the order of the file.
struct Blocks {
  std::int64_t points, connectivity, offsets, types;
};

Blocks blocks(std::int64_t points, std::int64_t triangles) {
  return {24 * points, 24 * triangles, 8 * triangles, triangles};
}

std::string data_array(const std::string& type, const std::string& name, std::int64_t& offset,
                       std::int64_t size) {
  std::string line = "        <DataArray type=\"" + type + "\" Name=\"" + name + "\"" +
                     (name == "Points" ? " NumberOfComponents=\"3\"" : "") +
                     " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
  offset += 8 + size;
  return line;
}

/// Everything before the first block.
std::string head(const VtkFlavour& flavour, std::int64_t points, std::int64_t triangles) {
  const Blocks size = blocks(points, triangles);
  std::int64_t offset = 0;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + flavour.data_set +
      "\" version=\"1.0\" byte_order=\"" + (little_endian ? "LittleEndian" : "BigEndian") +
      "\" header_type=\"UInt64\">\n  <" + flavour.data_set + ">\n    <Piece NumberOfPoints=\"" +
      std::to_string(points) + "\" " + flavour.cell_counts + std::to_string(triangles) +
      "\">\n      <Points>\n" + data_array("Float64", "Points", offset, size.points) +
      "      </Points>\n      <" + flavour.cells + ">\n";
  text += data_array("Int64", "connectivity", offset, size.connectivity);
  text += data_array("Int64", "offsets", offset, size.offsets);
  if (flavour.types)
    text += data_array("UInt8", "types", offset, size.types);
  return text + "      </" + flavour.cells + ">\n    </Piece>\n  </" + flavour.data_set +
         ">\n  <AppendedData encoding=\"raw\">\n_";
}

std::string_view take_block(Bytes& bytes, std::int64_t size) {
  if (load<std::uint64_t>(bytes.take(8).data()) != static_cast<std::uint64_t>(size))
    bytes.fail("a block's length is not what its head announces; it is damaged, make it again");
  return bytes.take(size);
}

/// Ids beyond an int32 become -1, which read_mesh refuses as it does every id out of range.
Triangles triangles_of(std::string_view connectivity) {
  Triangles triangles(3, static_cast<Eigen::Index>(connectivity.size() / 24));
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    const auto id = load<std::int64_t>(connectivity.data() + 8 * i);
    const auto narrow = static_cast<std::int32_t>(id);
    triangles.data()[i] = narrow == id ? narrow : -1;
  }
  return triangles;
}

void require_triangles(const Bytes& bytes, std::string_view offsets, std::string_view types) {
  for (std::size_t t = 0; t < offsets.size() / 8; ++t)
    if (load<std::int64_t>(offsets.data() + 8 * t) != static_cast<std::int64_t>(3 * (t + 1)) ||
        (!types.empty() && types[t] != triangle_type))
      bytes.fail("cell " + std::to_string(t) + " is no triangle; only triangles are read");
}

} // namespace

void put_vtk(const Sink& sink, const Mesh& mesh, const VtkFlavour& flavour) {
  const std::int64_t points = mesh.points.cols(), triangles = mesh.triangles.cols();
  const Blocks size = blocks(points, triangles);
  Writer out(sink);
  out.text(head(flavour, points, triangles));
  out.raw(size.points).text(bytes_of(mesh.points.data(), mesh.points.size()));
  out.raw(size.connectivity);
  for (std::int64_t i = 0; i < 3 * triangles; ++i)
    out.raw(std::int64_t{mesh.triangles.data()[i]});
  out.raw(size.offsets);
  for (std::int64_t t = 0; t < triangles; ++t)
    out.raw(3 * (t + 1));
  if (flavour.types)
    out.raw(size.types).text(std::string(static_cast<std::size_t>(triangles), triangle_type));
  out.text(tail).flush();
}

Soup get_vtk(std::istream& in, const std::string& name, const VtkFlavour& flavour) {
  const std::string content = read_all(in, name);
  Bytes bytes(content, name);
  const auto points = count_after(content, "NumberOfPoints=\"");
  const auto triangles = count_after(content, flavour.cell_counts);
  const std::string problem = "its head is not that of a VTK " + flavour.data_set +
                              " file of triangles which calotte wrote; convert it to .off";
  if (!points || !triangles)
    bytes.fail(problem);
  bytes.take(head(flavour, *points, *triangles), problem);

  const Blocks size = blocks(*points, *triangles);
  const std::string_view coordinates = take_block(bytes, size.points);
  const std::string_view connectivity = take_block(bytes, size.connectivity);
  const std::string_view offsets = take_block(bytes, size.offsets);
  const std::string_view types = flavour.types ? take_block(bytes, size.types) : std::string_view();
  bytes.take(tail, "the file does not end as it should; it is damaged, make it again");
  bytes.finish();
  require_triangles(bytes, offsets, types);

  Soup soup{Points3(3, *points), triangles_of(connectivity)};
  std::memcpy(soup.points.data(), coordinates.data(), coordinates.size());
  return soup;
}

} // namespace calotte::detail
