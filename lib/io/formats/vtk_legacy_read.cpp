// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/formats/formats.h"
#include "io/formats/poly_data.h"
#include "io/formats/vtk_cell_types.h"
#include "io/formats/vtk_legacy.h"

#include <array>
#include <optional>
#include <utility>

// VTK's legacy files (the VTK User's Guide, "VTK File Formats", "Simple Legacy Formats"), versions
// 1.0 to 5.1: POLYDATA and UNSTRUCTURED_GRID.

namespace calotte::io_detail {
namespace {

Scalar type_of_numbers(LegacyText& text, const std::string& array) {
  const LegacyText::Type type = text.type();
  if (!type.scalar)
    fail_damaged(in_array(text.name(), array), "its type is {}, not one of numbers", type.name);
  return *type.scalar;
}

/// Reads the corners of cells of one kind, as of version 5.1: offsets from 0 on, then points.
IdLists read_offsets(LegacyText& text, const std::string& section, std::int64_t offsets,
                     std::int64_t points) {
  IdLists cells;
  const Scalar of_offsets = type_of_numbers(text, section);
  cells.begin = text.numbers<std::int64_t>(section, of_offsets, offsets);
  if (!text.take("CONNECTIVITY"))
    fail_damaged(in_array(text.name(), section), "no CONNECTIVITY follows its OFFSETS");
  const Scalar of_points = type_of_numbers(text, section);
  cells.items = text.numbers<std::int32_t>(section, of_points, points);
  if (offsets > 0 && cells.begin[0] != 0)
    fail_damaged(in_array(text.name(), section), "its OFFSETS do not start with 0");
  return cells;
}

/// Reads the corners of cells as before version 5.1: the number of points of each cell, then its
/// points.
IdLists read_lists(LegacyText& text, const std::string& section, std::int64_t count,
                   std::int64_t size) {
  const auto list = text.numbers<std::int32_t>(section, Scalar::int32, size);
  if (count > size)
    fail_damaged(in_array(text.name(), section), "its {} numbers cannot hold {} cells", size,
                 count);
  IdLists cells{Offsets::Zero(count + 1), Ids(size - count)};
  std::int64_t offset = 0, end = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t corners = offset < size ? list[offset] : -1;
    if (corners < 0 || corners > size - offset - 1 || end + corners > cells.items.size())
      fail_file(in_array(text.name(), section), i, "cell {} runs beyond the {} numbers{}", i, size,
                damaged);
    cells.items.segment(end, corners) = list.segment(offset + 1, corners);
    offset += corners + 1;
    end += corners;
    cells.begin[i + 1] = end;
  }
  return cells;
}

IdLists read_cells(LegacyText& text, const std::string& section) {
  const std::int64_t first = text.count("cells"), size = text.count("their numbers");
  return text.take("OFFSETS") ? read_offsets(text, section, first, size)
                              : read_lists(text, section, first, size);
}

/// Reads a file keyword by keyword.
class Reader {
public:
  Reader(std::string_view content, const std::string& name) : text_(content, name) {}

  PolyData read() {
    require_data_set();
    for (std::string_view keyword = text_.word(); !keyword.empty(); keyword = text_.word()) {
      std::string lower(keyword);
      for (char& c : lower)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
      if (!read_geometry(lower) && !read_attribute(lower))
        fail_damaged(text_.name(), "{} is not a keyword of {} in a legacy VTK file",
                     in_quotes(keyword), grid_ ? "UNSTRUCTURED_GRID" : "POLYDATA");
    }
    return finish();
  }

private:
  void require_data_set() {
    const bool keyword = text_.take("DATASET");
    grid_ = keyword && text_.take("UNSTRUCTURED_GRID");
    if (!grid_ && !(keyword && text_.take("POLYDATA")))
      fail_file(text_.name(), "it holds {}; only DATASET POLYDATA and UNSTRUCTURED_GRID are read",
                in_quotes(text_.word()));
  }

  // ---- Points and cells

  bool read_geometry(const std::string& keyword) {
    if (keyword == "points")
      read_points();
    else if (keyword == (grid_ ? "cells" : "polygons"))
      poly_data_.ids = read_cells(text_, grid_ ? "CELLS" : "POLYGONS");
    else if (keyword == "cell_types" && grid_)
      read_types();
    else if ((keyword == "vertices" || keyword == "lines") && !grid_)
      before_ += read_cells(text_, keyword).size();
    else if (keyword == "triangle_strips" && !grid_)
      require_no_strips();
    else
      return false;
    return true;
  }

  void read_points() {
    const std::int64_t count = text_.count("points");
    const Scalar type = type_of_numbers(text_, "POINTS");
    const Column<double> numbers = text_.numbers<double>("POINTS", type, 3 * count);
    poly_data_.points = Eigen::Map<const Points3>(numbers.data(), 3, count);
    poly_data_.single = type == Scalar::float32;
  }

  void read_types() {
    const std::int64_t count = text_.count("cell types");
    types_ = text_.numbers<std::int32_t>("CELL_TYPES", Scalar::int32, count);
  }

  void require_no_strips() {
    if (const std::int64_t strips = read_cells(text_, "TRIANGLE_STRIPS").size(); strips > 0)
      refuse_strips(text_.name(), strips);
  }

  // ---- Data

  bool read_attribute(const std::string& keyword) {
    if (keyword == "point_data" || keyword == "cell_data") {
      of_cells_ = keyword == "cell_data";
      tuples_ = text_.count("values");
    } else if (keyword == "metadata") {
      text_.skip_metadata();
    } else if (keyword == "field") {
      read_field();
    } else if (keyword == "scalars") {
      read_scalars();
    } else if (keyword == "lookup_table") {
      const std::string name = text_.decoded_name();
      text_.skip(name, colours(), 4 * text_.count("colours"));
    } else if (keyword == "color_scalars") {
      const std::string name = text_.decoded_name();
      const std::int64_t components = text_.count("components");
      ignore(name, colours(), components * tuples_);
    } else if (keyword == "texture_coordinates") {
      const std::string name = text_.decoded_name();
      const std::int64_t components = text_.count("components");
      read_array(name, text_.type(), components, tuples_);
    } else {
      return read_plain(keyword);
    }
    return true;
  }

  /// Reads attributes with a name and a type. The keyword determines the number of components.
  bool read_plain(const std::string& keyword) {
    constexpr std::array<std::pair<std::string_view, int>, 7> plain{{{"vectors", 3},
                                                                     {"normals", 3},
                                                                     {"tensors", 9},
                                                                     {"tensors6", 6},
                                                                     {"global_ids", 1},
                                                                     {"pedigree_ids", 1},
                                                                     {"edge_flags", 1}}};
    for (const auto& [name, components] : plain)
      if (name == keyword) {
        const std::string array = text_.decoded_name();
        read_array(array, text_.type(), components, tuples_);
        return true;
      }
    return false;
  }

  /// The type of colours: bytes in binary files, fractions in text files.
  static LegacyText::Type colours() { return {"unsigned_char", Scalar::uint8}; }

  void read_scalars() {
    const std::string name = text_.decoded_name();
    const LegacyText::Type type = text_.type();
    std::int64_t components = 1;
    if (const std::string_view word = text_.word_of_line();
        !word.empty() && (!parse_number(word, Scalar::int64, components) || components < 0))
      fail_damaged(in_array(text_.name(), name), "{} is not its number of components",
                   in_quotes(word));
    if (text_.take("LOOKUP_TABLE"))
      text_.word();
    read_array(name, type, components, tuples_);
  }

  /// Reads arrays, each with its own size. Arrays before the data of points and cells belong to the
  /// file.
  void read_field() {
    text_.word();
    const std::int64_t count = text_.count("arrays");
    for (std::int64_t i = 0; i < count; ++i) {
      while (text_.take("METADATA"))
        text_.skip_metadata();
      const std::string name = text_.decoded_name();
      const std::int64_t components = text_.count("components"), tuples = text_.count("values");
      const LegacyText::Type type = text_.type();
      if (of_cells_.has_value())
        read_array(name, type, components, tuples);
      else
        ignore(name, type, components * tuples);
    }
  }

  void ignore(const std::string& name, const LegacyText::Type& type, std::int64_t count) {
    text_.skip(name, type, count);
    poly_data_.ignored.push_back(name);
  }

  void read_array(const std::string& name, const LegacyText::Type& type, std::int64_t components,
                  std::int64_t tuples) {
    if (!of_cells_.has_value() || tuples != tuples_)
      fail_damaged(in_array(text_.name(), name), "it has {} values, but POINT_DATA or CELL_DATA {}",
                   tuples, of_cells_.has_value() ? message("announces {}", tuples_) : "is missing");
    if (components > most_components)
      fail_damaged(in_array(text_.name(), name), "it has {} components", components);
    if (!type.scalar || !is_read(name, *of_cells_, components))
      return ignore(name, type, components * tuples);
    poly_data_.arrays.push_back({name, *of_cells_, static_cast<int>(components),
                                 text_.numbers<double>(name, *type.scalar, components * tuples)});
  }

  // ---- The whole

  PolyData finish() {
    if (grid_) {
      if (types_.size() != poly_data_.size())
        fail_damaged(in_array(text_.name(), "CELL_TYPES"), "it has {} types for {} cells",
                     types_.size(), poly_data_.size());
      require_cell_types(text_.name(), poly_data_, types_, "CELL_TYPES");
    }
    const std::string section = grid_ ? "CELLS" : "POLYGONS";
    require_polygons(text_.name(), poly_data_, {section, section});
    for (DataArray& array : poly_data_.arrays)
      keep_values_of_faces(array);
    return std::move(poly_data_);
  }

  /// Removes the values of vertices and lines, which come first.
  void keep_values_of_faces(DataArray& array) const {
    const std::int64_t skipped = array.of_polygons ? before_ : 0,
                       used = array.of_polygons ? poly_data_.size() : poly_data_.points.cols();
    if (array.values.size() != array.components * (skipped + used))
      fail_damaged(in_array(text_.name(), array.name), "it has {} values for {} {}",
                   array.values.size() / array.components, skipped + used,
                   array.of_polygons ? "cells" : "points");
    if (skipped > 0)
      array.values = Column<double>(array.values.tail(array.components * used));
  }

  static constexpr std::int64_t most_components = 1 << 20;

  LegacyText text_;
  bool grid_ = false;
  PolyData poly_data_;
  Ids types_;
  std::int64_t before_ = 0;      ///< number of vertices and lines
  std::optional<bool> of_cells_; ///< whether data of cells follow; none before any data
  std::int64_t tuples_ = 0;      ///< number of tuples, as announced
};

} // namespace

RawMesh get_vtk_legacy(std::istream& in, const std::string& name) {
  const std::string content = read_all(in, name, require_legacy_vtk);
  return make_raw_mesh(name, Reader(content, name).read());
}

} // namespace calotte::io_detail
