// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/types.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace calotte {

/// Every file is written beside its place, brought to the disk, and renamed when whole: it is there
/// as a whole or not at all. Messages name the file and, where there is one, the 1-based line.

enum class Columns {
  xyz,    ///< x y z: a direction of any norm but 0
  lonlat, ///< longitude (any) and latitude (-90 to 90), in degrees, become unit columns
};

/// Points as text, one a line: three numbers, or two with Columns::lonlat. Blanks or tabs, and at
/// most one of comma, semicolon and bar, separate them; `#` starts a comment; blank lines count for
/// nothing; one header line (it holds no number) may precede the points; further columns are
/// ignored. Lines end in LF, CRLF or CR; a missing final newline loses nothing.
///
/// Longitude and latitude are exact at multiples of 90 degrees, and the same bits on every machine:
/// longitudes that differ by 360 are one place, and so are all longitudes at a pole.
/// \param name stands for the stream in messages.
/// \param lines if not null, the 1-based line of each column.
/// \throws Error parse (index() is the 1-based line): text that is no number, NaN, infinite or the
///         zero vector; too few columns; a latitude out of range; no points at all. Error file.
Points3 read_points(std::istream& in, const std::string& name, Columns columns = Columns::xyz,
                    std::vector<std::int64_t>* lines = nullptr);
Points3 read_points(const std::string& path, Columns columns = Columns::xyz,
                    std::vector<std::int64_t>* lines = nullptr);

/// x y z a line, with the fewest digits (17 at most) that read back to the same bits.
/// \throws Error file.
void write_points(const std::string& path, const Points3& points);
void write_points(std::ostream& out, const Points3& points);

/// Writes in the format of the suffix:
///   .txt .tri   0-based `i j k` a line. The ids are columns of the input of delaunay(), so that
///               the file goes with the points it was made from: a merged duplicate goes by its
///               site's lowest column.
///   .vtp .vtu   VTK XML, points Float64, ids Int64, appended raw binary
///   .off        text, digits as write_points
///   .ply        binary doubles
/// All but the first hold the sites as given and their ids.
/// \throws Error bad_option for an unknown suffix, file.
void write(const std::string& path, const Mesh& mesh);

/// \throws Error bad_option when `write` does not know the path's suffix.
void require_mesh_suffix(const std::string& path);

/// Reads a mesh that `write` wrote (.vtp, .vtu, .off, .ply; coordinates come back bit for bit), or
/// .txt/.tri with the points it refers to. Ids are checked to be in range, geometry is not: check()
/// proves it. Neighbours are rebuilt; an edge of three triangles, or of two that run through it the
/// same way, stays open.
/// \param points the columns that a .txt/.tri file refers to; not used otherwise. A column in no
///        triangle is the duplicate of one that has the same direction, or else stays as a site
///        without triangles.
/// \throws Error bad_option, parse, file.
Mesh read_mesh(const std::string& path, const Points3* points = nullptr);

/// A checkpoint: a run's state as binary, with the configuration that it belongs to in words of the
/// caller's choice. A file that was cut short or damaged is refused, and so is another version's.
/// \throws Error file.
void write_checkpoint(const std::string& path, const CvtState& state,
                      const std::string& configuration);
/// \throws Error file, parse, bad_option (of another configuration).
CvtState read_checkpoint(const std::string& path, const std::string& configuration);

/// Writes bytes in the way of all files here.
/// \throws Error file.
void write_file(const std::string& path, std::string_view bytes);

} // namespace calotte
