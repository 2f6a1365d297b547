// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/text.h"
#include "io/shapes/jigsaw.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace calotte::io_detail {
namespace {

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// Writes a section with one number on each line.
/// \param head text after the number of lines.
void put_section(Writer& out, const std::string& name, const std::vector<double>& values,
                 const std::string& head = "") {
  if (values.empty())
    return;
  out.text(name).number(std::int64_t{std::ssize(values)}).text(head + "\n");
  for (const double value : values)
    out.number(value).text("\n");
}

} // namespace

void write_jigsaw_grid(const std::string& path, const JigsawFile& grid) {
  OutputFile file(path);
  Writer out([&](std::string_view bytes) { file.append(bytes); });
  out.text("MSHID=3;" + upper(grid.kind) + "\nNDIMS=2\n");
  if (grid.radii) {
    out.text("RADII=").number((*grid.radii)[0]).text(";").number((*grid.radii)[1]);
    out.text(";").number((*grid.radii)[2]).text("\n");
  }
  put_section(out, "COORD=1;", grid.x_grid);
  put_section(out, "COORD=2;", grid.y_grid);
  put_section(out, "VALUE=", grid.values, ";1");
  put_section(out, "SLOPE=", grid.slopes, ";1");
  out.flush();
  file.commit();
}

} // namespace calotte::io_detail
