// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "text.h"

#include <calotte/types.h>

#include <iosfwd>
#include <string>

/// What the formats have in common: a pair of functions each, from a mesh to bytes and from bytes
/// to points and triangles. Readers check that the file is whole and leave the rest to read_mesh.
namespace calotte::detail {

/// Points and triangles as a file holds them.
struct Soup {
  Points3 points;
  Triangles triangles;
};

void put_vtp(const Sink& sink, const Mesh& mesh);
void put_vtu(const Sink& sink, const Mesh& mesh);
void put_off(const Sink& sink, const Mesh& mesh);
void put_ply(const Sink& sink, const Mesh& mesh);
void put_triangles_text(const Sink& sink, const Mesh& mesh);

/// \throws Error parse, file.
Soup get_vtp(std::istream& in, const std::string& name);
Soup get_vtu(std::istream& in, const std::string& name);
Soup get_off(std::istream& in, const std::string& name);
Soup get_ply(std::istream& in, const std::string& name);

/// Triangles of `points` columns.
Triangles get_triangles_text(std::istream& in, const std::string& name, std::int64_t points);

/// Three ids, each 0 <= id < points, from one line of text. \throws Error parse.
void parse_ids(const LineReader& reader, const std::int64_t* ids, std::int64_t points,
               std::vector<std::int32_t>& triangles);

/// An array's bytes.
template <class T> std::string_view bytes_of(const T* data, Eigen::Index count) {
  return {reinterpret_cast<const char*>(data), sizeof(T) * static_cast<std::size_t>(count)};
}

} // namespace calotte::detail
