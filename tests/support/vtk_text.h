// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/polyhedra.h"

#include <functional>
#include <string>
#include <vector>

#include <zlib.h>

/// VTK's XML files as VTK, ParaView and meshio write them, made here and not by the library.
namespace calotte::test {

enum class Data { ascii, binary, raw, base64 };

/// How a file stores its arrays.
struct Style {
  Data data = Data::raw;
  bool wide = true; ///< UInt64 lengths
  bool big = false; ///< byte order
  bool compressed = false;
  bool apart = false; ///< base64 of the lengths, then that of the numbers
  std::string points = "Float64", ids = "Int64";
};

inline std::string zipped(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  return out.substr(0, size);
}

/// A VTK XML file, array after array.
class VtkText {
public:
  explicit VtkText(Style style) : style_(std::move(style)) {}

  void line(const std::string& text) { xml_ += text + "\n"; }

  void array(const std::string& type, const std::string& name, const Values& values,
             int components = 1) {
    xml_ += "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
            std::to_string(components) + "\" format=\"" +
            (style_.data == Data::ascii    ? "ascii"
             : style_.data == Data::binary ? "binary"
                                           : "appended") +
            "\"";
    if (style_.data == Data::ascii)
      xml_ += ">\n" + text_of(values);
    else if (style_.data == Data::binary)
      xml_ += ">\n   " + in_base64(type, values) + "\n";
    else
      xml_ += " offset=\"" + std::to_string(appended_.size()) + "\">\n";
    if (style_.data == Data::raw)
      appended_ += header(type, values) + body(type, values);
    else if (style_.data == Data::base64)
      appended_ += in_base64(type, values);
    xml_ += "<InformationKey name=\"L2_NORM_RANGE\"><Value index=\"0\">0.5</Value>"
            "</InformationKey></DataArray>\n";
  }

  std::string file(const std::string& type) const {
    std::string text = "<?xml version=\"1.0\"?>\n<!-- a comment -->\n<VTKFile type=\"" + type +
                       "\" version=\"1.0\" byte_order=\"" +
                       (style_.big ? "BigEndian" : "LittleEndian") + "\"" +
                       (style_.wide ? " header_type=\"UInt64\"" : "") +
                       (style_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n<" +
                       type + ">\n" + xml_ + "</Piece></" + type + ">\n";
    if (style_.data == Data::raw || style_.data == Data::base64)
      text += "<AppendedData encoding=\"" +
              std::string(style_.data == Data::raw ? "raw" : "base64") + "\">\n   _" + appended_ +
              "\n</AppendedData>";
    return text + "</VTKFile>\n";
  }

private:
  static constexpr std::size_t block = 200; ///< bytes, small to have many

  std::string number(std::size_t value) const {
    return bytes_of(style_.wide ? "UInt64" : "UInt32", {double(value)}, style_.big);
  }
  std::vector<std::string> blocks(const std::string& bytes) const {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < bytes.size(); i += block)
      all.push_back(zipped(bytes.substr(i, block)));
    return all;
  }
  std::string header(const std::string& type, const Values& values) const {
    const std::string bytes = bytes_of(type, values, style_.big);
    if (!style_.compressed)
      return number(bytes.size());
    const std::vector<std::string> all = blocks(bytes);
    std::string text = number(all.size()) + number(block) + number(bytes.size() % block);
    for (const std::string& part : all)
      text += number(part.size());
    return text;
  }
  std::string body(const std::string& type, const Values& values) const {
    const std::string bytes = bytes_of(type, values, style_.big);
    std::string text = style_.compressed ? "" : bytes;
    if (style_.compressed)
      for (const std::string& part : blocks(bytes))
        text += part;
    return text;
  }
  std::string in_base64(const std::string& type, const Values& values) const {
    return style_.compressed || style_.apart
               ? base64(header(type, values)) + base64(body(type, values))
               : base64(header(type, values) + body(type, values));
  }

  Style style_;
  std::string xml_, appended_;
};

/// Arrays of a file, with the names of their sections.
using Put = std::function<void(VtkText&)>;

inline std::string vtk_text(const std::string& type, const Faces& faces, const Style& style,
                            const Put& point_data = {}, const Put& cell_data = {}) {
  const bool grid = type == "UnstructuredGrid";
  const std::string section = grid ? "Cells" : "Polys";
  VtkText file(style);
  file.line("<FieldData><Array type=\"String\" Name=\"made by\" format=\"ascii\">1 "
            "2</Array></FieldData>");
  file.line("<Piece NumberOfPoints=\"" + std::to_string(faces.points.cols()) + "\" " +
            (grid ? "NumberOfCells" : "NumberOfVerts=\"0\" NumberOfPolys") + "=\"" +
            std::to_string(faces.ends.size()) + "\">");
  file.line("<PointData>");
  if (point_data)
    point_data(file);
  file.line("</PointData><CellData>");
  if (cell_data)
    cell_data(file);
  file.line("</CellData><Points>");
  file.array(style.points, "Points", values_of(faces.points), 3);
  file.line("</Points><" + section + ">");
  file.array(style.ids, "connectivity", faces.ids);
  file.array(style.ids, "offsets", faces.ends);
  if (grid)
    file.array("UInt8", "types", faces.types());
  file.line("</" + section + ">");
  return file.file(type);
}

/// Every way to store an array.
inline std::vector<Style> styles() {
  std::vector<Style> all{{.data = Data::ascii}};
  for (const Data data : {Data::binary, Data::raw, Data::base64})
    for (const bool wide : {false, true})
      for (const bool big : {false, true})
        for (const bool compressed : {false, true})
          all.push_back({.data = data, .wide = wide, .big = big, .compressed = compressed});
  all.push_back({.data = Data::binary, .apart = true});
  all.push_back({.data = Data::base64, .wide = false, .apart = true});
  return all;
}

inline std::string describe(const Style& style) {
  return "data " + std::to_string(int(style.data)) + (style.wide ? " wide" : "") +
         (style.big ? " big" : "") + (style.compressed ? " compressed" : "");
}

} // namespace calotte::test
