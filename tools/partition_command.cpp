// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/config_option.h"
#include "options/delaunay_options.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/part_counts.h"
#include "run/exit_code.h"
#include "run/interruption.h"
#include "run/memory_use.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>
#include <calotte/partition.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <CLI/App.hpp>

#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

struct PartitionRequest {
  std::string mesh, output, weights, report;
  std::vector<std::string> parts;
  std::optional<int> threads;
  std::shared_ptr<std::string> config;
};

/// What a file of parts holds.
struct Row {
  std::string path;
  CellParts parts; ///< without the part of each cell
};

/// The result for all files.
struct PartitionOutcome {
  std::int64_t cells = 0, edges = 0;
  std::vector<std::int64_t> components; ///< their numbers of cells
  std::vector<Row> rows;                ///< by number of parts
  int threads = 1;
  double read_seconds = 0, seconds = 0;
};

// ---- Names

/// What the names of the files have before the number of parts: NAME.graph.info.part. of NAME.nc.
std::string prefix_of(const PartitionRequest& request) {
  const std::string name =
      request.output.empty()
          ? std::filesystem::path(request.mesh).replace_extension(".graph.info").string()
          : request.output;
  return name.ends_with(".") || name.ends_with("/") ? name : name + ".part.";
}

std::string path_of(const PartitionRequest& request, std::int64_t parts) {
  return prefix_of(request) + std::to_string(parts);
}

void require_files(const PartitionRequest& request, const std::vector<std::int64_t>& counts) {
  std::vector<Output> outputs{{"report", request.report}};
  for (const std::int64_t parts : counts)
    outputs.push_back({message("{} parts", parts), path_of(request, parts)});
  require_outputs(outputs, {request.mesh, *request.config});
}

// ---- Input

[[noreturn]] void refuse_triangles(const std::string& path) {
  refuse(message("{} holds triangles or points, and no cells; give a file of cells, such as the "
                 "MPAS file that calotte convert makes of it",
                 path));
}

MeshFile read_cells(const PartitionRequest& request) {
  if (holds_triangles(request.mesh))
    refuse_triangles(request.mesh);
  MeshFile file = read_mesh_file(
      request.mesh, nullptr, request.weights.empty() ? FieldChoice::none : FieldChoice::scalars);
  if (!file.has_cells)
    refuse_triangles(request.mesh);
  if (const Mesh* const mesh = file.mesh ? &*file.mesh : nullptr;
      mesh && !file.polygons && std::ssize(mesh->site_of_input) != mesh->points.cols())
    refuse_path(request.mesh, "two of its cells have one centre; make the file again");
  return file;
}

/// A field of the file, or a variable that describes the mesh itself, such as areaCell.
DoubleVector weights_of(const PartitionRequest& request, const MeshFile& file, std::int64_t cells) {
  if (request.weights.empty())
    return {};
  std::vector<std::string> names;
  for (const MeshField& field : file.fields)
    if (field.location == FieldLocation::cells && field.values.size() == cells) {
      if (field.name == request.weights)
        return field.values;
      names.push_back(field.name);
    }
  if (is_netcdf(file))
    return read_cell_field(request.mesh, request.weights, cells).values;
  refuse_path(request.mesh, "no field {} with one value for each cell; {}", request.weights,
              names.empty() ? "the file has none" : "there are " + listed(names));
}

// ---- Output

std::string describe_partition(const Row& row) {
  const std::int64_t unconnected = row.parts.unconnected;
  return message("{}: {} cut, imbalance {}{}\n", row.path, counted(row.parts.edge_cut, "edge"),
                 formatted("%.4f", row.parts.imbalance),
                 unconnected == 0 ? ""
                                  : message(", {} {} not connected", counted(unconnected, "part"),
                                            unconnected == 1 ? "is" : "are"));
}

/// A line on a mesh that is not connected.
std::string describe_components(const PartitionRequest& request, const PartitionOutcome& outcome) {
  const std::vector<std::int64_t>& sizes = outcome.components;
  if (sizes.size() < 2)
    return "";
  return message("{}: the cells are not connected: {} components, the largest of {} cells and the "
                 "smallest of {}; a part may have cells of several\n",
                 request.mesh, sizes.size(), sizes.front(), sizes.back());
}

std::string to_json(const PartitionRequest& request, const PartitionOutcome& outcome) {
  nlohmann::ordered_json json;
  json["mesh"] = request.mesh;
  json["cells"] = outcome.cells;
  json["edges"] = outcome.edges;
  json["components"] = outcome.components;
  if (!request.weights.empty())
    json["weights"] = request.weights;
  json["threads"] = outcome.threads;
  json["seconds"] = {{"read", outcome.read_seconds}, {"partition", outcome.seconds}};
  json["memory"] = memory_use();
  for (const Row& row : outcome.rows)
    json["partitions"].push_back({{"parts", row.parts.parts},
                                  {"file", row.path},
                                  {"edge_cut", row.parts.edge_cut},
                                  {"imbalance", row.parts.imbalance},
                                  {"balanced", row.parts.balanced},
                                  {"unconnected", row.parts.unconnected}});
  return json.dump(2) + "\n";
}

/// Why partitions are not as balanced as their cells allow; empty if they are.
std::string fault_of(const PartitionOutcome& outcome) {
  const auto unbalanced = [](const Row& row) { return !row.parts.balanced; };
  const auto first = std::find_if(outcome.rows.begin(), outcome.rows.end(), unbalanced);
  if (first == outcome.rows.end())
    return "";
  return message("{} of {} partitions have a part of more than 1.03 times the mean weight; the "
                 "first is {}, imbalance {}",
                 std::count_if(first, outcome.rows.end(), unbalanced), outcome.rows.size(),
                 first->path, formatted("%.4f", first->parts.imbalance));
}

// ---- The run

/// Partitions the cells for each number of parts, and writes the files.
std::vector<Row> write_all(const PartitionRequest& request, const IdLists& neighbours,
                           const std::vector<std::int64_t>& counts,
                           const PartitionOptions& options) {
  std::mutex mutex;
  std::vector<Row> rows;
  const auto write = [&](CellParts parts) {
    Row row{path_of(request, parts.parts), {}};
    write_parts(row.path, std::exchange(parts.part, {}));
    row.parts = std::move(parts);
    const std::lock_guard lock(mutex);
    rows.push_back(std::move(row));
  };
  try {
    partition(neighbours, counts, options, write);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_argument)
      throw;
    throw Error(error.code(), message("{}: {}", request.mesh, error.what()), error.index());
  }
  std::sort(rows.begin(), rows.end(),
            [](const Row& a, const Row& b) { return a.parts.parts < b.parts.parts; });
  return rows;
}

PartitionOutcome partition_file(const PartitionRequest& request,
                                const std::vector<PartCounts>& asked) {
  Progress progress;
  PartitionOutcome outcome;
  MeshFile file;
  IdLists neighbours;
  progress.stage("reading " + request.mesh);
  outcome.read_seconds = seconds_of([&] {
    file = read_cells(request);
    neighbours = cell_neighbours(file);
  });
  outcome.cells = neighbours.size();
  outcome.edges = neighbours.items.size() / 2;
  const std::vector<std::int64_t> counts = counts_of(asked, outcome.cells, request.mesh);
  require_files(request, counts);
  PartitionOptions options;
  options.weights = weights_of(request, file, outcome.cells);
  options.progress = [&, bar = progress.bar()](const calotte::Progress& so_far) {
    const auto done = static_cast<std::int64_t>(so_far.fraction * std::ssize(counts) + 0.5);
    progress.stage(message("partitioning {}, {} of {}", request.mesh, done, counts.size()),
                   std::to_string(std::floor(10 * so_far.fraction)));
    return bar ? bar(so_far) : ProgressReply::proceed;
  };
  file = {};
  announce_files();
  with_threads(request.threads, [&] {
    outcome.threads = tbb::this_task_arena::max_concurrency();
    outcome.components = component_sizes(neighbours);
    outcome.seconds =
        seconds_of([&] { outcome.rows = write_all(request, neighbours, counts, options); });
  });
  if (!request.report.empty())
    write_file(request.report, to_json(request, outcome));
  return outcome;
}

void run(const PartitionRequest& request) {
  const std::vector<PartCounts> asked = part_counts(request.parts);
  require_input(request.mesh); // before what is named after it
  require_files(request, {asked.front().first});
  const PartitionOutcome outcome = partition_file(request, asked);
  std::cout << describe_components(request, outcome);
  for (const Row& row : outcome.rows)
    std::cout << describe_partition(row);
  const std::string fault = fault_of(outcome);
  if (!fault.empty())
    finish(not_converged, message("{}: {}", request.mesh, fault));
}

} // namespace

void add_partition(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "partition", "Partitions the cells of a mesh for many numbers of processes, with METIS. It "
                   "writes graph.info.part.N for each, as gpmetis does and MPAS reads it.");
  auto request = std::make_shared<PartitionRequest>();
  command
      ->add_option("MESH,--input", request->mesh,
                   "Mesh file with cells: MPAS, UGRID, SCRIP, ESMF, Exodus, GeoJSON or others; the "
                   "parts stand in the order of its cells")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("PARTS,--parts", request->parts,
                   "Numbers of parts, from 1 to the number of cells, or ranges FIRST:LAST:STEP, "
                   "which include both ends; STEP is 1 by default")
      ->type_name("N|RANGE")
      ->required();
  command
      ->add_option("-o,--output", request->output,
                   "Name of the files without .part.N. A name that ends in a point or a slash is "
                   "all that stands before N. Default: NAME.graph.info for NAME.nc")
      ->type_name("FILE");
  command
      ->add_option("--weights", request->weights,
                   "Field of the file with the work of each cell, >= 0. Default: all are equal")
      ->type_name("FIELD");
  add_threads(*command, request->threads, "Number of threads, 1 to 4096; default: all");
  command
      ->add_option("--report", request->report,
                   "Write edge cuts, imbalances and times to this JSON file")
      ->type_name("FILE");
  request->config = add_config(*command);
  set_help(*command,
           {.common = {},
            .examples = {"calotte partition grid.nc 16 32 64",
                         "calotte partition ocean.nc 128:8192:128 -o ocean.graph.info.261128"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
