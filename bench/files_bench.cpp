// SPDX-License-Identifier: GPL-3.0-or-later
// Times writing a full MPAS mesh compared with the triangulation, in rounds: the triangulation, its
// numbering along the curve, the connectivity alone, the file of the renumbered mesh, including its
// connectivity, on the disk, and the same number of bytes written in the same way without
// computation, which is the limit of the disk. Then reading: the mesh in each binary format, from a
// warm cache on one thread; a row's name gives the size of its file.

#include "base/parallel.h"
#include "delaunay/delaunay.h"
#include "io/bytes/file.h"
#include "program.h"
#include "stopwatch.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/io.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace calotte::bench {
namespace {

struct Options : RoundOptions {
  int level = 9; ///< of the bisected icosahedron
  std::string folder = ".";
};

using Body = std::function<void()>;

/// A row that times a body once per round, after a preparation that is not timed.
RoundRow row_of(
    const std::string& name, const Body& body, const Body& prepare = [] {}) {
  return {name, [=](benchmark::State& state) {
            for (auto _ : state) {
              prepare();
              const Stopwatch watch;
              body();
              Timed timed;
              watch.stop(timed);
              state.SetIterationTime(timed.seconds);
              state.counters["cpu"] = timed.cpu_seconds;
            }
          }};
}

/// The files of the mesh, and another one with the same number of bytes.
struct Files {
  Files() = default;
  explicit Files(const std::filesystem::path& folder)
      : mesh(folder / "files_bench.nc"), graph(folder / "files_bench.graph.info"),
        other(folder / "files_bench.bytes") {}

  /// Called before a write is timed: replacing a file would include the time of its removal.
  void remove() const {
    std::error_code absent;
    for (const std::filesystem::path& file : {mesh, graph, other})
      std::filesystem::remove(file, absent);
  }

  std::filesystem::path mesh, graph, other;
  std::int64_t bytes = 0; ///< of mesh and graph
};

/// The data to write and their paths; computed after the options are read.
struct Workload {
  Workload() = default;
  Workload(const Workload&) = delete;
  Workload& operator=(const Workload&) = delete;
  ~Workload() {
    files.remove();
    std::error_code absent;
    if (!read_folder.empty())
      std::filesystem::remove_all(read_folder, absent);
  }

  std::optional<tbb::global_control> limit;
  Mesh as_bisected, mesh; ///< the same, numbered along the curve
  Files files;
  std::filesystem::path read_folder; ///< made for the files to read
};

void write_mesh(Files& files, const Mesh& mesh) {
  write(files.mesh, mesh, {.sphere_radius = 6371229});
  files.bytes = static_cast<std::int64_t>(std::filesystem::file_size(files.mesh) +
                                          std::filesystem::file_size(files.graph));
}

/// The same pseudo-random bytes in every block, except for its number, so that a disk cannot
/// compress them as zeros.
void write_bytes(const Files& files) {
  static const std::vector<std::uint32_t> pattern = [] {
    std::vector<std::uint32_t> words(1 << 22);
    std::generate(words.begin(), words.end(), std::minstd_rand());
    return words;
  }();
  const auto block_bytes = static_cast<std::int64_t>(pattern.size() * sizeof(pattern[0]));
  io_detail::OutputFile file(files.other);
  file.reserve(files.bytes);
  base_detail::for_each_task((files.bytes + block_bytes - 1) / block_bytes, [&](std::int64_t k) {
    const std::int64_t offset = k * block_bytes;
    io_detail::OutputBlock block = file.block(offset, std::min(block_bytes, files.bytes - offset));
    std::memcpy(block.begin(), pattern.data(), static_cast<std::size_t>(block.size()));
    std::memcpy(block.begin(), &k, std::min(sizeof k, static_cast<std::size_t>(block.size())));
    file.put(std::move(block));
  });
  file.commit();
}

/// The files to read: of each a name, by which its row goes, and its format.
struct ReadFile {
  const char* name;
  Format format;
};
constexpr std::array<ReadFile, 10> read_files{{{"mpas.nc", Format::mpas},
                                               {"mpas-minimal.nc", Format::mpas_minimal},
                                               {"ugrid.nc", Format::ugrid},
                                               {"ugrid-triangles.nc", Format::ugrid_triangles},
                                               {"scrip.nc", Format::scrip},
                                               {"esmf.nc", Format::esmf},
                                               {"exodus.g", Format::exodus},
                                               {"triangles.vtp", Format::vtp},
                                               {"cells.vtp", Format::vtp_cells},
                                               {"triangles.ply", Format::ply}}};

/// Writes the files to a folder, and gives a row that reads it for each.
std::vector<RoundRow> reading_rows(const std::filesystem::path& folder, const Mesh& mesh) {
  std::vector<RoundRow> rows;
  std::filesystem::create_directory(folder);
  for (const ReadFile& file : read_files) {
    const std::string path = folder / file.name;
    write(path, mesh, {.format = file.format});
    const auto megabytes = (std::filesystem::file_size(path) + 500000) / 1000000;
    rows.push_back(row_of(
        "read " + std::string(file.name) + " of " + std::to_string(megabytes) + " MB, one thread",
        [path] {
          const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
          benchmark::DoNotOptimize(read_mesh_file(path));
        }));
  }
  return rows;
}

void register_all(const Options& options, Workload& work) {
  work.limit.emplace(tbb::global_control::max_allowed_parallelism,
                     static_cast<std::size_t>(options.threads));
  work.as_bisected = delaunay(bisected_icosahedron(options.level));
  work.mesh = renumbered(work.as_bisected, Numbering::curve);
  work.files = Files(options.folder);
  write_mesh(work.files, work.mesh); // reports the number of bytes
  const auto remove = [&work] { work.files.remove(); };
  std::vector<RoundRow> rows = {
      row_of("delaunay", [&work] { delaunay(work.mesh.points); }),
      row_of("renumbered", [&work] { renumbered(work.as_bisected, Numbering::curve); }),
      row_of("voronoi", [&work] { voronoi(work.mesh); }),
      row_of(
          "write", [&work] { write_mesh(work.files, work.mesh); }, remove),
      row_of(
          "the same bytes", [&work] { write_bytes(work.files); }, remove)};
  for (RoundRow& row : reading_rows(
           work.read_folder = work.files.mesh.parent_path() / "files_bench_read", work.mesh))
    rows.push_back(std::move(row));
  for (int round = 0; round < options.rounds; ++round)
    register_round("bisection", work.mesh.points.cols(), round, rows);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--level", options.level, "of the bisected icosahedron: 10 x 4^level + 2 cells")
      ->check(CLI::Range(0, 12))
      ->capture_default_str();
  app.add_option("--folder", options.folder, "where the file is written, and removed at the end")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  add_round_options(app, options);
}

} // namespace
} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  options.rounds = 5;
  Workload work;
  return run_program(argc, argv,
                     {"Times writing a full MPAS mesh beside the triangulation it is of.",
                      {},
                      [&](CLI::App& app) { add_options(app, options); },
                      [&] { register_all(options, work); }});
}
