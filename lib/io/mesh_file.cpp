// SPDX-License-Identifier: GPL-3.0-or-later
#include "assemble.h"
#include "file.h"
#include "formats.h"

#include <calotte/error.h>
#include <calotte/io.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <numeric>

namespace calotte {
namespace {

using namespace detail;

/// Triangles as text have no reader here: they need their points.
struct Format {
  std::string_view suffix;
  void (*put)(const Sink&, const Mesh&);
  Soup (*get)(std::istream&, const std::string&);
};

constexpr std::array formats{Format{".txt", put_triangles_text, nullptr},
                             Format{".tri", put_triangles_text, nullptr},
                             Format{".vtp", put_vtp, get_vtp},
                             Format{".vtu", put_vtu, get_vtu},
                             Format{".off", put_off, get_off},
                             Format{".ply", put_ply, get_ply}};

const Format& format_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats)
    if (format.suffix == suffix)
      return format;
  throw Error(ErrorCode::bad_option,
              path + ": " + (suffix.empty() ? "no suffix" : "unknown suffix " + in_quotes(suffix)) +
                  "; a mesh file ends in .txt, .tri, .vtp, .vtu, .off or .ply");
}

void require_directions(const std::string& name, const Points3& points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (!points.col(i).allFinite() || (points.col(i).array() == 0).all())
      throw Error(ErrorCode::parse,
                  name + ": point " + std::to_string(i) +
                      " has no direction (NaN, infinite or zero); make the file again",
                  i);
}

void require_ids(const std::string& name, const Triangles& triangles, std::int64_t points) {
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (triangles(i, t) < 0 || triangles(i, t) >= points)
        throw Error(ErrorCode::parse,
                    name + ": triangle " + std::to_string(t) +
                        " has an id that is not one of the " + std::to_string(points) +
                        " points; make the file again",
                    t);
}

Mesh mesh_of(const std::string& name, Soup soup) {
  require_directions(name, soup.points);
  require_ids(name, soup.triangles, soup.points.cols());
  Mesh mesh{std::move(soup.points), std::move(soup.triangles), {}, {}};
  mesh.neighbours = neighbours_of(mesh.triangles, mesh.points.cols());
  mesh.site_of_input.resize(static_cast<std::size_t>(mesh.points.cols()));
  std::iota(mesh.site_of_input.begin(), mesh.site_of_input.end(), 0);
  return mesh;
}

} // namespace

void write(const std::string& path, const Mesh& mesh) {
  const Format& format = format_of(path);
  OutputFile file(path);
  format.put([&](std::string_view bytes) { file.append(bytes); }, mesh);
  file.commit();
}

void require_mesh_suffix(const std::string& path) { format_of(path); }

Mesh read_mesh(const std::string& path, const Points3* points) {
  const Format& format = format_of(path);
  if (!format.get && !points)
    throw Error(ErrorCode::bad_option,
                path + " holds triangles only; give the points they refer to (--points FILE)");
  std::ifstream in = open_input(path);
  if (format.get)
    return mesh_of(path, format.get(in, path));
  return mesh_of_columns(*points, get_triangles_text(in, path, points->cols()));
}

} // namespace calotte
