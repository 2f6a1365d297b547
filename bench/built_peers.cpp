// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

#include <unistd.h>

namespace calotte::bench {
namespace {

/// A folder for the files of one run, which is removed at the end.
class Folder {
public:
  Folder() {
    if (!mkdtemp(path_.data()))
      throw std::runtime_error("no folder for temporary files");
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& file) const { return path_ + "/" + file; }

private:
  std::string path_ = std::filesystem::temp_directory_path() / "calotte-bench-XXXXXX";
};

/// The first `rows` coordinates of one column a line, after the lines of `head`; exact.
void write_points(const std::string& file, const std::string& head, const Points3& points,
                  Eigen::Index rows) {
  std::ofstream out(file);
  const Eigen::IOFormat exact(std::numeric_limits<double>::max_digits10, Eigen::DontAlignCols);
  out << head << points.topRows(rows).transpose().format(exact) << '\n';
  if (!out.flush())
    throw std::runtime_error("cannot write " + file);
}

/// Runs a command of the shell; the number behind the last `label` of what it prints.
double run_command(const std::string& command, const std::string& label, const Folder& folder) {
  const std::string printed = folder / "printed";
  if (std::system((command + " > " + printed + " 2>&1").c_str()) != 0)
    throw std::runtime_error("failed: " + command);
  double seconds = -1;
  std::ifstream in(printed);
  for (std::string line; std::getline(in, line);)
    if (const std::size_t at = line.find(label); at != std::string::npos)
      seconds = std::strtod(line.c_str() + at + label.size(), nullptr);
  if (seconds < 0)
    throw std::runtime_error("printed no line with \"" + label + "\": " + command);
  return seconds;
}

/// The triangles at the end of a file that have only sites for corners; the first site has the
/// number `first`. Those for which `turn` is true are turned over.
template <class Turn>
Digest read_triangles(std::istream& in, std::int64_t first, std::int64_t n, const Turn& turn) {
  Digest digest;
  for (std::array<std::int64_t, 3> corner{}; in >> corner[0] >> corner[1] >> corner[2];) {
    std::array<std::int32_t, 3> ids{};
    bool all = true;
    for (std::size_t i = 0; i < 3; ++i) {
      all &= corner[i] >= first && corner[i] < first + n;
      ids[i] = static_cast<std::int32_t>(corner[i] - first);
    }
    if (!all)
      continue;
    if (turn(ids))
      std::swap(ids[1], ids[2]);
    digest.add(ids[0], ids[1], ids[2]);
  }
  if (!in.eof())
    throw std::runtime_error("the file of the triangles has a line that holds none");
  return digest;
}

void skip_lines(std::istream& in, std::int64_t count) {
  for (; count > 0; --count)
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
}

/// Whether a triangle is clockwise, on the sphere seen from outside.
auto clockwise(const Points3& points, bool plane) {
  return [&points, plane](const std::array<std::int32_t, 3>& t) {
    const Eigen::Vector3d a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
    const Eigen::Vector3d up = plane ? Eigen::Vector3d::UnitZ() : a;
    return (b - a).cross(c - a).dot(up) < 0;
  };
}

/// A path as one word of the shell; none of the user's programs has a quote in its path.
std::string quoted(const std::string& path) { return "'" + path + "'"; }

} // namespace

Outcome run_pbbs(const std::string& program, const Points3& points, int threads) {
  const Folder folder;
  const std::string input = folder / "points", result = folder / "triangles";
  write_points(input, "pbbs_sequencePoint2d\n", points, 2);
  const double seconds = run_command("PARLAY_NUM_THREADS=" + std::to_string(threads) + " " +
                                         quoted(program) + " -r 1 -o " + result + " " + input,
                                     "Parlay time:", folder);
  // A word, the numbers of vertices and triangles, the vertices (the ten around the points are the
  // last), the triangles.
  std::ifstream in(result);
  std::string word;
  std::int64_t vertices = 0, triangles = 0;
  in >> word >> vertices >> triangles;
  skip_lines(in, vertices + 1);
  return {{seconds}, read_triangles(in, 0, points.cols(), clockwise(points, true))};
}

Outcome run_geogram(const std::string& program, const Points3& points, bool plane, int threads) {
  const Folder folder;
  const std::string input = folder / "points.xyz", result = folder / "triangles";
  std::string options = "dimension=2 algo:delaunay=BDEL2d ";
  Points3 vertices = points;
  if (!plane) {
    options = std::string("dimension=3 convex_hull=true algo:delaunay=") +
              (threads == 1 ? "BDEL " : "PDEL ");
    vertices.resize(3, points.cols() + 1);
    vertices << Eigen::Vector3d::Zero(), points; // as the last point it takes seven times as long
  }
  write_points(input, "", vertices, plane ? 2 : 3);
  const double seconds = run_command(quoted(program) + " " + options + input + " " + result,
                                     "[Delaunay    ] Elapsed:", folder);
  // The vertices, one a line, then the triangles, each under a line with their number.
  std::ifstream in(result);
  skip_lines(in, vertices.cols() + 2);
  return {
      {seconds},
      read_triangles(in, vertices.cols() - points.cols(), points.cols(), clockwise(points, plane))};
}

} // namespace calotte::bench
