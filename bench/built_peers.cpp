// SPDX-License-Identifier: GPL-3.0-or-later
#include "built_peers.h"

#include <Eigen/Geometry>

#include <array>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include <unistd.h>

namespace calotte::bench {
namespace {

using std::filesystem::path;

/// A folder that is removed at the end.
class Folder {
public:
  Folder() {
    std::string name = std::filesystem::temp_directory_path() / "calotte-bench-XXXXXX";
    if (!mkdtemp(name.data()))
      throw std::runtime_error("no folder for temporary files");
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const char* file) const { return path_ / file; }

private:
  path path_;
};

/// One column a line, after the lines of `head`; exact.
template <class Points>
void write_points(const std::string& file, const std::string& head, const Points& points) {
  std::ofstream out(file);
  out << head;
  std::array<char, 32> text{};
  for (const auto& point : points.colwise())
    for (Eigen::Index i = 0; i < point.size(); ++i) {
      const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), point(i));
      out.write(text.data(), end - text.data()).put(i + 1 < point.size() ? ' ' : '\n');
    }
  if (!out.flush())
    throw std::runtime_error("cannot write " + file);
}

/// A path as one word of the shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text)
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// The number behind the last `label` of a file.
std::optional<double> number_behind(const std::string& label, const std::string& file) {
  std::optional<double> number;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (const std::size_t at = line.find(label); at != std::string::npos)
      number = std::strtod(line.c_str() + at + label.size(), nullptr);
  return number;
}

/// Runs a command of the shell, whose seconds stand behind a label in what it prints.
Outcome run_command(const std::string& command, const std::string& label, const Folder& folder) {
  Outcome outcome;
  const std::string printed = folder / "printed";
  if (std::system((command + " > " + quoted(printed) + " 2>&1").c_str()) != 0) {
    outcome.failure = "failed: " + command;
    return outcome;
  }
  const std::optional<double> seconds = number_behind(label, printed);
  if (!seconds)
    outcome.failure = "printed no line with \"" + label + "\": " + command;
  outcome.seconds = seconds.value_or(0);
  return outcome;
}

/// The triangles of the sites, of which the first has the number `first`, at the end of a file;
/// those for which `turn` is true are turned over.
template <class Turn>
void read_triangles(std::istream& in, std::int64_t first, std::int64_t n, const Turn& turn,
                    Outcome& outcome) {
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
    ++outcome.triangles;
  }
  if (!in.eof())
    outcome.failure = "the file of the triangles has a line that holds none";
  outcome.sites = n;
  outcome.digest = digest.value();
}

void skip_lines(std::istream& in, std::int64_t count) {
  for (; count > 0; --count)
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
}

double twice_area(const Points2& points, const std::array<std::int32_t, 3>& t) {
  const Eigen::Vector2d b = points.col(t[1]) - points.col(t[0]),
                        c = points.col(t[2]) - points.col(t[0]);
  return b.x() * c.y() - b.y() * c.x();
}

/// geogram's text: the vertices, one a line, then the triangles, each under a line with their
/// number.
template <class Turn>
Outcome run_geogram(const std::string& program, const std::string& options, std::int64_t n,
                    std::int64_t vertices, const Turn& turn, const Folder& folder) {
  const std::string result = folder / "triangles";
  Outcome outcome = run_command(quoted(program) + " " + options + " " +
                                    quoted(folder / "points.xyz") + " " + quoted(result),
                                "[Delaunay    ] Elapsed:", folder);
  std::ifstream in(result);
  skip_lines(in, vertices + 2);
  if (outcome.failure.empty())
    read_triangles(in, vertices - n, n, turn, outcome);
  return outcome;
}

} // namespace

void add_pbbs_option(CLI::App& app, BuiltPeers& peers) {
  app.add_option("--pbbs", peers.pbbs,
                 "also time this program of your own build: delaunay of PBBS' incrementalDelaunay "
                 "(github.com/cmuparlay/pbbsbench)")
      ->check(CLI::ExistingFile);
}

void add_geogram_option(CLI::App& app, BuiltPeers& peers) {
  app.add_option("--geogram", peers.geogram,
                 "also time this program of your own build: compute_delaunay of geogram's "
                 "Delaunay_psm (github.com/BrunoLevy/geogram)")
      ->check(CLI::ExistingFile);
}

Outcome run_pbbs(const std::string& program, const Points2& points, int threads) {
  const Folder folder;
  const std::string input = folder / "points", result = folder / "triangles";
  write_points(input, "pbbs_sequencePoint2d\n", points);
  Outcome outcome =
      run_command("PARLAY_NUM_THREADS=" + std::to_string(threads) + " " + quoted(program) +
                      " -r 1 -o " + quoted(result) + " " + quoted(input),
                  "Parlay time:", folder);
  if (!outcome.failure.empty())
    return outcome;
  // A word, the numbers of vertices and triangles, the vertices (the ten around the points are the
  // last), the triangles.
  std::ifstream in(result);
  std::string word;
  std::int64_t vertices = 0, triangles = 0;
  in >> word >> vertices >> triangles;
  skip_lines(in, vertices + 1);
  read_triangles(
      in, 0, points.cols(), [&](const auto& t) { return twice_area(points, t) < 0; }, outcome);
  return outcome;
}

Outcome run_geogram(const std::string& program, const Points2& points) {
  const Folder folder;
  write_points(folder / "points.xyz", "", points);
  return run_geogram(
      program, "dimension=2 algo:delaunay=BDEL2d", points.cols(), points.cols(),
      [&](const auto& t) { return twice_area(points, t) < 0; }, folder);
}

Outcome run_geogram(const std::string& program, const Points3& points, int threads) {
  const Folder folder;
  Points3 with_centre(3, points.cols() + 1);
  with_centre << Eigen::Vector3d::Zero(), points; // as the last point it takes seven times as long
  write_points(folder / "points.xyz", "", with_centre);
  const auto turn = [&](const std::array<std::int32_t, 3>& t) {
    const Eigen::Vector3d a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
    return (b - a).cross(c - a).dot(a) < 0;
  };
  const std::string algorithm = threads == 1 ? "BDEL" : "PDEL";
  return run_geogram(program, "dimension=3 convex_hull=true algo:delaunay=" + algorithm,
                     points.cols(), with_centre.cols(), turn, folder);
}

} // namespace calotte::bench
