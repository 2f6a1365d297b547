// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/types.h>

#include <iosfwd>
#include <string>

namespace calotte {

enum class Columns {
  xyz,    ///< x y z
  lonlat, ///< longitude and latitude in degrees
};

/// Points as text, one a line: three numbers, or two with Columns::lonlat; any of blank, tab, comma, semicolon
/// separates; `#` starts a comment; one header line may precede the numbers; further columns are
/// ignored; a missing final newline loses nothing.
/// \param name stands for the stream in messages.
/// \throws Error parse (index() is the 1-based line), file.
Points3 read_points(std::istream& in, const std::string& name, Columns columns = Columns::xyz);
Points3 read_points(const std::string& path, Columns columns = Columns::xyz);

/// x y z a line, 17 significant digits: reading them back gives the same bits.
void write_points(const std::string& path, const Points3& points);

/// Writes in the format of the suffix: .txt or .tri (0-based `i j k` a line), .vtp, .vtu, .off, .ply.
/// The file is written beside its place and renamed when whole.
/// \throws Error bad_option for an unknown suffix, file.
void write(const std::string& path, const Mesh& mesh);

/// Reads a mesh that `write` wrote (.vtp, .vtu, .off, .ply; coordinates come back bit for bit), or .txt/.tri
/// with the sites it refers to. Neighbours are rebuilt; ids are checked, geometry is not.
/// \param points the sites of a .txt/.tri file; not used otherwise.
/// \throws Error bad_option, parse, file.
Mesh read_mesh(const std::string& path, const Points3* points = nullptr);

} // namespace calotte
