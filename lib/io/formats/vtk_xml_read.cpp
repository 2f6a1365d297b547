// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/scalars.h"
#include "io/bytes/xml.h"
#include "io/formats/formats.h"
#include "io/formats/poly_data.h"
#include "io/formats/vtk_cell_types.h"
#include "io/formats/vtk_storage.h"

#include <utility>

// VTK's XML files (the VTK User's Guide, "VTK File Formats"): PolyData and UnstructuredGrid.

namespace calotte::io_detail {
namespace {

// ---- The XML and the appended data

/// The XML of a file, in two parts, and the appended data between them, which need not be XML.
struct Parts {
  std::vector<std::string_view> xml;
  std::optional<std::string_view> appended;
};

/// \throws Error parse for a file that does not start as XML.
void require_xml(std::string_view start, const std::string& name) {
  if (start.find('<') == std::string_view::npos)
    fail_damaged(name, "it does not start with XML, so it is no VTK file of XML");
}

Parts split(std::string_view content, const std::string& name) {
  constexpr std::string_view start_tag = "<AppendedData", end_tag = "</AppendedData>";
  const std::size_t tag = content.find(start_tag);
  const std::size_t close = content.find('>', tag);
  if (tag == std::string_view::npos || close == std::string_view::npos || content[close - 1] == '/')
    return {{content}, std::nullopt};
  const std::size_t end = content.rfind(end_tag);
  std::size_t begin = close + 1;
  while (begin < content.size() && is_space(content[begin]))
    ++begin;
  if (end == std::string_view::npos || end <= begin || content[begin] != '_')
    fail_damaged(name, "its AppendedData do not start with _ and end with {}", end_tag);
  return {{content.substr(0, close + 1), content.substr(end)},
          content.substr(begin + 1, end - begin - 1)};
}

/// A file whose XML is parsed.
struct VtkFile {
  XmlDocument document;
  std::string type; ///< of the data set
  VtkStorage storage;

  const XmlElement* child(const XmlElement& parent, std::string_view name) const {
    const std::vector<const XmlElement*> found = children(document, parent, name);
    return found.empty() ? nullptr : found.front();
  }
};

Scalar length_type(const XmlElement& root, const std::string& name) {
  const std::string type = root.attribute("header_type", "UInt32");
  if (type != "UInt32" && type != "UInt64")
    fail_damaged(name, "its header_type {} is not UInt32 or UInt64", in_quotes(type));
  return type == "UInt64" ? Scalar::uint64 : Scalar::uint32;
}

bool is_swapped(const XmlElement& root, const std::string& name) {
  const std::string order = root.attribute("byte_order", "LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    fail_damaged(name, "its byte_order {} is not LittleEndian or BigEndian", in_quotes(order));
  return (order == "LittleEndian") != (std::endian::native == std::endian::little);
}

bool is_compressed(const XmlElement& root, const std::string& name) {
  const std::string compressor = root.attribute("compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    fail_file(name,
              "it is compressed by {}, which is not read; write it with vtkZLibDataCompressor or "
              "without compression",
              in_quotes(compressor));
  return !compressor.empty();
}

VtkFile parse_file(std::string_view content, const std::string& name) {
  const Parts parts = split(content, name);
  VtkFile file{.document = parse_xml(parts.xml, name), .type = {}, .storage = {}};
  const XmlElement& root = file.document.front();
  file.type = root.attribute("type");
  if (root.name != "VTKFile" || (file.type != "PolyData" && file.type != "UnstructuredGrid"))
    fail_file(name,
              "it holds {} of type {}; only VTKFile of type PolyData or UnstructuredGrid is read",
              in_quotes(root.name), in_quotes(file.type));
  file.storage = {.name = name,
                  .swapped = is_swapped(root, name),
                  .length_type = length_type(root, name),
                  .compressed = is_compressed(root, name),
                  .appended = parts.appended,
                  .appended_base64 = false};
  if (const XmlElement* appended = file.child(root, "AppendedData")) {
    const std::string encoding = appended->attribute("encoding", "base64");
    if (encoding != "raw" && encoding != "base64")
      fail_damaged(name, "the encoding {} of its AppendedData is not raw or base64",
                   in_quotes(encoding));
    file.storage.appended_base64 = encoding == "base64";
  }
  return file;
}

// ---- The piece

/// Reads a count from the attributes of a piece; 0 without it.
std::int64_t read_count(const XmlElement& piece, const std::string& key, const std::string& name) {
  const std::string text = piece.attribute(key, "0");
  std::int32_t count = -1;
  if (!parse_number(text, Scalar::int64, count) || count < 0)
    fail_damaged(name, "its {} is {}, not a number from 0 to 2147483647", key, in_quotes(text));
  return count;
}

/// The numbers in the attributes of a piece.
struct Counts {
  std::int64_t points = 0;
  std::int64_t before = 0;   ///< vertices and lines, which come before the polygons in cell data
  std::int64_t polygons = 0; ///< polygons, or cells of an UnstructuredGrid
  std::int64_t strips = 0;

  bool empty() const { return points == 0 && before == 0 && polygons == 0 && strips == 0; }
};

Counts read_counts(const VtkFile& file, const XmlElement& piece) {
  const std::string& name = file.storage.name;
  if (file.type == "UnstructuredGrid")
    return {.points = read_count(piece, "NumberOfPoints", name),
            .polygons = read_count(piece, "NumberOfCells", name)};
  return {.points = read_count(piece, "NumberOfPoints", name),
          .before =
              read_count(piece, "NumberOfVerts", name) + read_count(piece, "NumberOfLines", name),
          .polygons = read_count(piece, "NumberOfPolys", name),
          .strips = read_count(piece, "NumberOfStrips", name)};
}

/// The only piece that is not empty, or else the first.
const XmlElement& find_piece(const VtkFile& file) {
  const std::string& name = file.storage.name;
  const XmlElement* const data = file.child(file.document.front(), file.type);
  const std::vector<const XmlElement*> pieces =
      data != nullptr ? children(file.document, *data, "Piece") : std::vector<const XmlElement*>{};
  if (pieces.empty())
    fail_damaged(name, "it has no Piece of {}", file.type);
  std::vector<const XmlElement*> full;
  for (const XmlElement* const piece : pieces)
    if (!read_counts(file, *piece).empty())
      full.push_back(piece);
  if (full.size() > 1)
    fail_file(name,
              "it has {} pieces, whose points on common borders are double; write it as one piece "
              "without double points (vtkCleanPolyData, vtkStaticCleanUnstructuredGrid)",
              full.size());
  return full.empty() ? *pieces.front() : *full.front();
}

/// An array of a section of the piece, the first one for "". Null if there is none.
const XmlElement* find_array(const VtkFile& file, const XmlElement& piece,
                             const std::string& section, const std::string& array) {
  if (const XmlElement* const parent = file.child(piece, section))
    for (const XmlElement* const element : children(file.document, *parent, "DataArray"))
      if (array.empty() || element->attribute("Name") == array)
        return element;
  return nullptr;
}

const XmlElement& array_of(const VtkFile& file, const XmlElement& piece, const std::string& section,
                           const std::string& array) {
  if (const XmlElement* const found = find_array(file, piece, section, array))
    return *found;
  fail_damaged(in_array(file.storage.name, array.empty() ? section : array),
               "it is not among the DataArrays of {}", section);
}

void read_points(const VtkFile& file, const XmlElement& piece, std::int64_t count,
                 PolyData& poly_data) {
  if (count == 0 && find_array(file, piece, "Points", "") == nullptr)
    return;
  const XmlElement& array = array_of(file, piece, "Points", "");
  if (const std::string components = array.attribute("NumberOfComponents"); components != "3")
    fail_damaged(in_array(file.storage.name, array.attribute("Name", "Points")),
                 "its NumberOfComponents is {}, not 3", in_quotes(components));
  read_vtk_numbers<double>(file.storage, array, 3 * count, [&](std::int64_t size) {
    poly_data.points.resize(3, size / 3);
    return poly_data.points.data();
  });
  poly_data.single = array.attribute("type") == "Float32";
}

void read_polygons(const VtkFile& file, const XmlElement& piece, std::int64_t count,
                   PolyData& poly_data) {
  const std::string section = file.type == "PolyData" ? "Polys" : "Cells";
  if (count == 0 && find_array(file, piece, section, "connectivity") == nullptr)
    return;
  const VtkStorage& storage = file.storage;
  read_vtk_numbers<std::int64_t>(storage, array_of(file, piece, section, "offsets"), count,
                                 [&](std::int64_t size) {
                                   poly_data.ids.begin.resize(size + 1);
                                   poly_data.ids.begin[0] = 0;
                                   return poly_data.ids.begin.data() + 1;
                                 });
  poly_data.ids.items =
      vtk_numbers<std::int32_t>(storage, array_of(file, piece, section, "connectivity"), -1);
  if (file.type == "UnstructuredGrid")
    require_cell_types(
        storage.name, poly_data,
        vtk_numbers<std::int32_t>(storage, array_of(file, piece, section, "types"), count));
}

// ---- Data

void read_array(const VtkFile& file, const XmlElement& element, const Counts& counts,
                bool of_polygons, PolyData& poly_data) {
  const std::string name = element.attribute("Name");
  const std::string text = element.attribute("NumberOfComponents", "1");
  std::int32_t components = 0;
  if (!parse_number(text, Scalar::int64, components) || components < 0)
    fail_damaged(in_array(file.storage.name, name), "its NumberOfComponents is {}",
                 in_quotes(text));
  const bool numbers = element.name == "DataArray" && vtk_type(element.attribute("type"));
  if (name.empty() || !numbers || !is_read(name, of_polygons, components)) {
    poly_data.ignored.push_back(name);
    return;
  }
  const std::int64_t skipped = of_polygons ? components * counts.before : 0,
                     used = components * (of_polygons ? counts.polygons : counts.points);
  Column<double> values = vtk_numbers<double>(file.storage, element, skipped + used);
  if (skipped > 0)
    values = Column<double>(values.tail(used));
  poly_data.arrays.push_back({name, of_polygons, components, std::move(values)});
}

void read_data(const VtkFile& file, const XmlElement& piece, const Counts& counts,
               PolyData& poly_data) {
  for (const bool of_polygons : {false, true})
    if (const XmlElement* const data = file.child(piece, of_polygons ? "CellData" : "PointData"))
      for (const XmlElement* const element : children(file.document, *data))
        read_array(file, *element, counts, of_polygons, poly_data);
}

/// Names of data of the whole file.
void ignore_field_data(const VtkFile& file, PolyData& poly_data) {
  const XmlElement* const data = file.child(file.document.front(), file.type);
  if (const XmlElement* const fields = file.child(*data, "FieldData"))
    for (const XmlElement* const element : children(file.document, *fields))
      poly_data.ignored.push_back(element->attribute("Name"));
}

} // namespace

RawMesh get_vtk_xml(std::istream& in, const std::string& name) {
  const std::string content = read_all(in, name, require_xml);
  const VtkFile file = parse_file(content, name);
  const XmlElement& piece = find_piece(file);
  const Counts counts = read_counts(file, piece);
  if (counts.strips > 0)
    refuse_strips(name, counts.strips);
  PolyData poly_data;
  read_points(file, piece, counts.points, poly_data);
  read_polygons(file, piece, counts.polygons, poly_data);
  require_polygons(name, poly_data);
  ignore_field_data(file, poly_data);
  read_data(file, piece, counts, poly_data);
  return make_raw_mesh(name, std::move(poly_data));
}

} // namespace calotte::io_detail
