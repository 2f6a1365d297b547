// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_error.h"
#include "io/formats/formats.h"

#include <algorithm>
#include <span>
#include <vector>

namespace calotte::io_detail {
namespace {

/// The lowest input column of each site; empty if the mesh does not have the columns.
std::vector<std::int32_t> input_of_site(const Mesh& mesh) {
  std::vector<std::int32_t> inputs;
  if (!mesh.site_of_input.empty())
    inputs.resize(static_cast<std::size_t>(mesh.points.cols()), -1);
  for (std::size_t i = 0; i < mesh.site_of_input.size(); ++i) {
    std::int32_t& input = inputs[static_cast<std::size_t>(mesh.site_of_input[i])];
    if (input < 0)
      input = static_cast<std::int32_t>(i);
  }
  return inputs;
}

} // namespace

void put_triangle_lines(const Sink& sink, const Triangles& triangles,
                        std::span<const std::int32_t> id_of) {
  Writer out(sink);
  constexpr std::int64_t block = 1024; // ids are looked up many at a time, as most are not in cache
  Triangles ids;
  for (std::int64_t begin = 0; begin < triangles.cols(); begin += block) {
    ids = triangles.middleCols(begin, std::min(block, triangles.cols() - begin));
    if (!id_of.empty())
      for (std::int32_t& id : ids.reshaped())
        id = id_of[static_cast<std::size_t>(id)];
    for (const auto& triangle : ids.colwise())
      out.number(std::int64_t{triangle(0)})
          .text(" ")
          .number(std::int64_t{triangle(1)})
          .text(" ")
          .number(std::int64_t{triangle(2)})
          .text("\n");
  }
  out.flush();
}

void put_triangles_text(const Sink& sink, const Mesh& mesh) {
  put_triangle_lines(sink, mesh.triangles, input_of_site(mesh));
}

Triangles get_triangles_text(std::istream& in, const std::string& name, std::int64_t points) {
  LineReader reader(in, name);
  std::vector<std::int32_t> triangles;
  for (std::string_view line; reader.next_content(line);) {
    std::int64_t ids[3];
    const Columned read = parse_columns(line, 3, ids);
    if (read.outcome != Outcome::ok)
      reader.fail("{}; write three ids i j k on each line, counted from 0", describe(read));
    parse_ids(reader, ids, points, triangles);
  }
  if (triangles.empty())
    fail_file(name, "no triangles; write three ids i j k on each line");
  return Eigen::Map<const Triangles>(triangles.data(), 3,
                                     static_cast<Eigen::Index>(triangles.size() / 3));
}

} // namespace calotte::io_detail
