// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/vtk_xml.h"

#include "io/bytes/binary.h"

#include <algorithm>

namespace calotte::io_detail {
namespace {

constexpr std::string_view tail = "\n  </AppendedData>\n</VTKFile>\n";

/// The name of an element without its attributes, as in its end tag.
std::string tag_name(const std::string& element) { return element.substr(0, element.find(' ')); }

/// Escapes text for an attribute.
std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

/// The text before the first block.
std::string make_head(const VtkHead& head) {
  const VtkFlavour& flavour = head.flavour;
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + flavour.data_set +
                     "\" version=\"1.0\" byte_order=\"" +
                     (little_endian ? "LittleEndian" : "BigEndian") +
                     "\" header_type=\"UInt64\">\n  <" + flavour.data_set +
                     ">\n    <Piece NumberOfPoints=\"" + std::to_string(head.points) + "\" " +
                     flavour.cell_counts + std::to_string(head.cells) + "\">\n";
  std::int64_t offset = 0;
  std::string open;
  const auto close = [&] { text += open.empty() ? "" : "      </" + tag_name(open) + ">\n"; };
  for (const VtkArray& array : head.arrays) {
    if (array.element != open) {
      close();
      open = array.element;
      text += "      <" + open + ">\n";
    }
    text += "        <DataArray type=\"" + array.type + "\" Name=\"" + array.name + "\"";
    if (array.components > 1)
      text += " NumberOfComponents=\"" + std::to_string(array.components) + "\"";
    text += " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    offset += 8 + array.bytes();
  }
  close();
  return text + "    </Piece>\n  </" + flavour.data_set + ">\n  <AppendedData encoding=\"raw\">\n_";
}

} // namespace

std::int64_t VtkArray::bytes() const {
  const std::int64_t size = type == "UInt8" ? 1 : type == "Int32" ? 4 : 8;
  return size * components * tuples;
}

void put_vtk(const Sink& sink, const VtkHead& head, const std::vector<VtkContent>& contents) {
  Writer out(sink);
  out.text(make_head(head));
  for (std::size_t i = 0; i < contents.size(); ++i) {
    out.raw(head.arrays[i].bytes());
    contents[i](out);
  }
  out.text(tail).flush();
}

void add_field_arrays(const std::string& element, std::int64_t cells, VtkHead& head) {
  // ParaView colours by the scalars that are named here.
  for (const char* name : {"area", "density", "spacing", "quality"})
    head.arrays.push_back({element + " Scalars=\"spacing\"", "Float64", name, cells});
  head.arrays.push_back({element + " Scalars=\"spacing\"", "Int32", "degree", cells});
}

void add_field_contents(const CellFields& fields, std::vector<VtkContent>& contents) {
  for (const DoubleVector* field :
       {&fields.area, &fields.density, &fields.spacing, &fields.quality})
    contents.emplace_back(
        [field](Writer& out) { out.text(bytes_of(field->data(), field->size())); });
  contents.emplace_back(
      [&fields](Writer& out) { out.text(bytes_of(fields.degree.data(), fields.degree.size())); });
}

void add_fields(const std::string& element, const std::vector<MeshField>& fields,
                FieldLocation location, VtkHead& head, std::vector<VtkContent>& contents) {
  const auto is_taken = [&head](const std::string& name) {
    return std::any_of(head.arrays.begin(), head.arrays.end(),
                       [&](const VtkArray& array) { return array.name == name; });
  };
  for (const MeshField& field : fields) {
    if (field.location != location || is_taken(field.name))
      continue;
    const DoubleVector& values = field.values;
    head.arrays.push_back({element, "Float64", xml_text(field.name), values.size()});
    contents.emplace_back(
        [&values](Writer& out) { out.text(bytes_of(values.data(), values.size())); });
  }
}

void add_points(std::int64_t points, VtkHead& head) {
  head.arrays.push_back({"Points", "Float64", "Points", points, 3});
}

VtkContent make_content(const Points3& points) {
  return [&points](Writer& out) { out.text(bytes_of(points.data(), points.size())); };
}

void add_cells(std::int64_t corners, VtkHead& head) {
  const std::string& element = head.flavour.cells;
  head.arrays.push_back({element, "Int64", "connectivity", corners});
  head.arrays.push_back({element, "Int64", "offsets", head.cells});
  if (head.flavour.types)
    head.arrays.push_back({element, "UInt8", "types", head.cells});
}

} // namespace calotte::io_detail
