// SPDX-License-Identifier: GPL-3.0-or-later
// Times writing a full MPAS mesh compared with the triangulation: the triangulation, its numbering
// along the curve, the connectivity alone, the file of the renumbered mesh, including its
// connectivity, on the disk, and the same number of bytes written in the same way without
// computation, which is the limit of the disk. Then reading: the mesh in each binary format, from a
// warm cache on one thread; a row's name gives the size of its file.

#include "clouds.h"
#include "program.h"

#include "base/parallel.h"
#include "io/bytes/file.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <system_error>
#include <utility>

namespace calotte::bench {
namespace {

namespace fs = std::filesystem;

struct Options : RoundOptions {
  std::string folder = ".";
};

/// The data to write, and a folder for the files, which is removed at the end.
struct Workload {
  Workload(const fs::path& parent, std::int64_t n)
      : as_bisected(delaunay(bisected_icosahedron(bisection_level(n)))),
        mesh(renumbered(as_bisected, Numbering::curve)), folder(parent / "files_bench") {
    fs::create_directory(folder);
  }
  Workload(const Workload&) = delete;
  Workload& operator=(const Workload&) = delete;
  ~Workload() {
    std::error_code absent;
    fs::remove_all(folder, absent);
  }

  Mesh as_bisected, mesh; ///< the same, numbered along the curve
  fs::path folder;
  std::int64_t bytes = 0; ///< of the MPAS file and the graph beside it
};

/// Not timed: replacing a file would include the time of its removal.
void remove_written(const Workload& work) {
  for (const char* name : {"written.nc", "written.graph.info", "written.bytes"})
    fs::remove(work.folder / name);
}

void write_mesh(Workload& work) {
  write(work.folder / "written.nc", work.mesh, {.sphere_radius = 6371229});
  work.bytes = static_cast<std::int64_t>(fs::file_size(work.folder / "written.nc") +
                                         fs::file_size(work.folder / "written.graph.info"));
}

/// The same pseudo-random bytes in every block, except for its number, so that a disk cannot
/// compress them as zeros.
void write_bytes(const Workload& work) {
  static const std::vector<std::uint32_t> pattern = [] {
    std::vector<std::uint32_t> words(1 << 22);
    std::generate(words.begin(), words.end(), std::minstd_rand());
    return words;
  }();
  const auto block_bytes = static_cast<std::int64_t>(pattern.size() * sizeof(pattern[0]));
  io_detail::OutputFile file(work.folder / "written.bytes");
  file.reserve(work.bytes);
  base_detail::for_each_task((work.bytes + block_bytes - 1) / block_bytes, [&](std::int64_t k) {
    const std::int64_t offset = k * block_bytes;
    io_detail::OutputBlock block = file.block(offset, std::min(block_bytes, work.bytes - offset));
    std::memcpy(block.begin(), pattern.data(), static_cast<std::size_t>(block.size()));
    std::memcpy(block.begin(), &k, std::min(sizeof k, static_cast<std::size_t>(block.size())));
    file.put(std::move(block));
  });
  file.commit();
}

/// A row that times a body on a number of threads.
Row row_of(const std::shared_ptr<Workload>& work, const std::string& name, int threads,
           const std::function<void(Workload&)>& body) {
  return {name, [=] {
            remove_written(*work);
            Timed timed;
            on_threads(threads, [&] {
              const Stopwatch watch;
              body(*work);
              timed = watch.stop();
            });
            return sample_of(timed);
          }};
}

/// Writes the mesh in a format, and gives a row that reads it.
Row reading_row(const std::shared_ptr<Workload>& work, const std::string& name, Format format) {
  const fs::path file = work->folder / name;
  write(file, work->mesh, {.format = format});
  const auto megabytes = (fs::file_size(file) + 500000) / 1000000;
  return row_of(work, "read " + name + " of " + std::to_string(megabytes) + " MB, one thread", 1,
                [file](Workload&) { benchmark::DoNotOptimize(read_mesh_file(file)); });
}

std::vector<Row> rows(std::int64_t n, const Options& options) {
  const auto work = std::make_shared<Workload>(options.folder, n);
  write_mesh(*work); // counts the bytes
  const auto row = [&](const std::string& name, const std::function<void(Workload&)>& body) {
    return row_of(work, name, options.threads, body);
  };
  std::vector<Row> result = {
      row("delaunay", [](Workload& w) { delaunay(w.mesh.points); }),
      row("renumbered", [](Workload& w) { renumbered(w.as_bisected, Numbering::curve); }),
      row("voronoi", [](Workload& w) { voronoi(w.mesh); }), row("write", write_mesh),
      row("the same bytes", [](Workload& w) { write_bytes(w); })};
  for (const auto& [name, format] :
       std::vector<std::pair<const char*, Format>>{{"mpas.nc", Format::mpas},
                                                   {"mpas-minimal.nc", Format::mpas_minimal},
                                                   {"ugrid.nc", Format::ugrid},
                                                   {"ugrid-triangles.nc", Format::ugrid_triangles},
                                                   {"scrip.nc", Format::scrip},
                                                   {"esmf.nc", Format::esmf},
                                                   {"exodus.g", Format::exodus},
                                                   {"triangles.vtp", Format::vtp},
                                                   {"cells.vtp", Format::vtp_cells},
                                                   {"triangles.ply", Format::ply}})
    result.push_back(reading_row(work, name, format));
  return result;
}

void add_options(CLI::App& app, Options& options) {
  add_list_option(app, "--sizes", options.sizes, "numbers of cells: 42, 162 ... 10 * 4^level + 2",
                  CLI::IsMember(bisected_sizes()));
  add_threads_option(app, options);
  app.add_option("--folder", options.folder,
                 "where the files are written, in a folder files_bench that is removed at the end")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
}

} // namespace
} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  options.sets = {"bisection"};
  options.sizes = {2621442};
  options.rounds = 5;
  return run_program(argc, argv, options,
                     {"Times writing a full MPAS mesh beside the triangulation it is of.",
                      {},
                      [&](CLI::App& app) { add_options(app, options); },
                      [&](const std::string&, std::int64_t n) { return rows(n, options); }});
}
