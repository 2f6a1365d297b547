// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/mpas.h"
#include "io/mpas/vertex_order.h"

#include "base/parallel.h"

#include <calotte/version.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <filesystem>
#include <numeric>

namespace calotte::io_detail {
namespace {

/// The finaliser of SplitMix64. Every bit of the result depends on all bits of the word.
std::uint64_t mixed(std::uint64_t word) {
  std::uint64_t z = word + 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

/// A hash of word(0) to word(n - 1) and of their order, the same for any number of threads.
template <class Word> std::uint64_t mixed_words(std::int64_t n, const Word& word) {
  std::vector<std::uint64_t> of_block(static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::uint64_t sum = 0; // the terms do not depend on each other
    for (std::int64_t i = begin; i != end; ++i)
      sum += mixed(word(i) ^ mixed(static_cast<std::uint64_t>(i)));
    of_block[static_cast<std::size_t>(block)] = sum;
  });
  return std::accumulate(of_block.begin(), of_block.end(), static_cast<std::uint64_t>(n));
}

std::string hexadecimal(std::uint64_t number) {
  char digits[16];
  const char* const end = std::to_chars(digits, digits + sizeof digits, number, 16).ptr;
  return std::string(static_cast<std::size_t>(digits + sizeof digits - end), '0') +
         std::string(static_cast<const char*>(digits), end);
}

struct Lines {
  Array<char> room; ///< of which `size` bytes are used
  std::int64_t size = 0;
  std::string_view text() const { return {room.begin(), static_cast<std::size_t>(size)}; }
};

/// One line of neighbours for each cell; empty for a cell without neighbours.
Lines neighbour_lines(const IdLists& cells_on_cell, std::int64_t begin, std::int64_t end) {
  constexpr std::int64_t longest = 11; // a blank or line end, and ten digits
  const std::int64_t numbers = cells_on_cell.begin[end] - cells_on_cell.begin[begin];
  Lines lines{Array<char>(longest * numbers + end - begin)};
  char* out = lines.room.begin();
  for (std::int64_t i = begin; i != end; ++i) {
    const char* const start = out;
    for (const std::int32_t cell : cells_on_cell[i]) {
      if (cell < 0)
        continue;
      if (out != start)
        *out++ = ' ';
      out = std::to_chars(out, out + longest - 1, cell + 1).ptr;
    }
    *out++ = '\n';
  }
  lines.size = out - lines.room.begin();
  return lines;
}

} // namespace

MpasFile::MpasFile(const std::string& path, const MpasMesh& mesh, const WriteOptions& options)
    : NetcdfGridFile(path, mesh.voronoi.surface.is_sphere() ? options : of_plane(options),
                     "CF-1.8 MPAS"),
      vertex_order_(options.vertex_order.value_or(VertexOrder::after_edges)) {
  const bool on_sphere = mesh.voronoi.surface.is_sphere(),
             periodic = mesh.voronoi.surface.period().maxCoeff() > 0;
  netcdf().attribute({"on_a_sphere", std::string(on_sphere ? "YES" : "NO")});
  netcdf().attribute({"is_periodic", std::string(periodic ? "YES" : "NO")});
  netcdf().attribute({"x_period", mesh.voronoi.surface.period()[0]});
  netcdf().attribute({"y_period", mesh.voronoi.surface.period()[1]});
  netcdf().attribute({"mesh_spec", std::string("1.0")});
  netcdf().attribute({"file_id", fingerprint(mesh)});
  netcdf().attribute({"parent_id", std::string()});
  netcdf().attribute({"source", std::string("calotte " CALOTTE_VERSION)});
}

void MpasFile::define(MpasDimension dimension, std::int64_t size) {
  ids_[dimension] = netcdf().dimension(name_of(dimension), size);
}

NetcdfGridFile::Announced MpasFile::announced(const std::string& name) const {
  const MpasVariable& row = mpas_variable(name);
  std::vector<int> dimensions;
  for (const MpasDimension dimension : {row.rows, row.columns})
    if (dimension != MpasDimension::none)
      dimensions.push_back(id_of(dimension));
  const std::string long_name =
      name == mpas::vertices_on_cell ? described(vertex_order_) : row.long_name;
  NetcdfAttributes attributes{{"units", row.units}, {"long_name", long_name}};
  if (!row.standard_name.empty())
    attributes.push_back({"standard_name", row.standard_name});
  return {row.name, dimensions, attributes, row.integer};
}

MpasSink MpasFile::sink() {
  return [this](const std::vector<std::string>& names, const NetcdfWriter::GroupFill& contents) {
    std::vector<Announced> variables;
    for (const std::string& name : names)
      variables.push_back(announced(name));
    together(variables, contents);
  };
}

void put_values(const MpasSink& sink, const MpasMesh& mesh) {
  for (const MpasVariable& row : mpas_variables()) {
    if (row.values == nullptr)
      continue;
    const double factor = radius_factor(row, mesh.radius);
    const auto fill = [&voronoi = mesh.voronoi, values = row.values,
                       factor](std::int64_t begin, std::int64_t end, double* out) {
      values(voronoi, begin, end, out);
      for (std::int64_t k = 0; k < end - begin; ++k)
        out[k] *= factor;
    };
    if (row.integer)
      sink({row.name},
           [fill](std::int64_t begin, std::int64_t end, std::int32_t* const* ints, double* const*) {
             Array<double> values(end - begin);
             fill(begin, end, values.begin());
             std::transform(values.begin(), values.end(), ints[0],
                            [](double value) { return static_cast<std::int32_t>(value); });
           });
    else
      put(sink, row.name, NetcdfWriter::Fill<double>(fill));
  }
}

std::string fingerprint(const MpasMesh& mesh) {
  const double* const coordinates = mesh.sites().data();
  const std::int32_t* const ids = mesh.voronoi.cells_on_vertex.data();
  const std::uint64_t points = mixed_words(mesh.sites().size(), [=](std::int64_t i) {
    return std::bit_cast<std::uint64_t>(coordinates[i]);
  });
  const std::uint64_t triangles =
      mixed_words(mesh.voronoi.cells_on_vertex.size(),
                  [=](std::int64_t i) { return static_cast<std::uint64_t>(ids[i]); });
  return hexadecimal(mixed(points ^ mixed(triangles)));
}

std::string fingerprint(const Array<std::int32_t>& kept, const std::string& parent) {
  std::uint64_t word =
      mixed_words(kept.size(), [&](std::int64_t i) { return static_cast<std::uint64_t>(kept[i]); });
  for (const char c : parent)
    word = mixed(word ^ static_cast<unsigned char>(c));
  return hexadecimal(word);
}

std::string graph_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".graph.info");
}

void put_graph(const Sink& sink, const Voronoi& voronoi) {
  put_graph(sink, voronoi.cells_on_cell, (voronoi.cells_on_edge.row(1).array() >= 0).count());
}

void put_graph(const Sink& sink, const IdLists& cells_on_cell, std::int64_t edges) {
  const std::int64_t cells = cells_on_cell.size(), blocks = block_count(cells);
  sink(std::to_string(cells) + " " + std::to_string(edges) + "\n");
  constexpr std::int64_t at_once = 32; // number of blocks, which limits the text in memory
  std::vector<Lines> texts(at_once);
  for (std::int64_t first = 0; first < blocks; first += at_once) {
    const std::int64_t count = std::min(at_once, blocks - first);
    for_each_task(count, [&](std::int64_t k) {
      const std::int64_t block = first + k;
      texts[static_cast<std::size_t>(k)] =
          neighbour_lines(cells_on_cell, cells * block / blocks, cells * (block + 1) / blocks);
    });
    for (std::int64_t k = 0; k < count; ++k)
      sink(texts[static_cast<std::size_t>(k)].text());
  }
}

} // namespace calotte::io_detail
