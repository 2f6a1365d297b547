// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/mesh_intake.h"
#include "io/cells/model_grid.h"
#include "io/cells/netcdf_fields.h"
#include "io/cells/written_fields.h"
#include "io/formats/formats.h"

// Exodus II (Schoof and Yarberry, Sandia report SAND92-2137, 1994), as TempestRemap and HOMME write
// the cells of grids: one or more blocks of elements, ids from 1, Cartesian coordinates on the unit
// sphere. An element of fewer nodes than its block's others repeats its last one.

namespace calotte::io_detail {
namespace {

std::string block_name(const std::string& stem, std::int64_t block) {
  return stem + std::to_string(block);
}

/// Reads coordinates: one variable for all axes, or one for each.
Points3 read_nodes(const NetcdfReader& file) {
  const bool together = file.has_variable("coord");
  const std::vector<double> all = together ? file.doubles("coord", {3, -1}) : std::vector<double>();
  Points3 nodes;
  for (int row = 0; row < 3; ++row) {
    const std::string name = std::string("coord") + "xyz"[row];
    const std::int64_t known = row == 0 ? -1 : std::int64_t{nodes.cols()};
    const std::vector<double> own = together ? std::vector<double>() : file.doubles(name, {known});
    const auto count = static_cast<Eigen::Index>(together ? all.size() / 3 : own.size());
    nodes.resize(3, count);
    nodes.row(row) = Eigen::Map<const Eigen::RowVectorXd>(
        together ? all.data() + row * count : own.data(), count);
  }
  return nodes;
}

/// Collects the nodes of elements.
class Elements {
public:
  Elements(const NetcdfReader& file, std::int64_t nodes) : file_(file), nodes_(nodes) {}

  /// Reads a table with the same number of nodes for each element.
  void add_block(const std::string& name) {
    const std::vector<std::int32_t> ids = file_.ints(name, {-1, -1});
    const std::vector<std::int64_t> shape = file_.shape_of(name);
    const std::int64_t elements = shape[0], width = shape[1];
    for (std::int64_t e = 0; e < elements; ++e)
      add(name, ids.data() + e * width, width);
  }

  /// Reads elements of any number of nodes ("nsided"). A second variable has the numbers.
  void add_block(const std::string& name, const std::string& counts_name) {
    const std::vector<std::int32_t> ids = file_.ints(name, {-1});
    const std::vector<std::int32_t> counts = file_.ints(counts_name, {-1});
    std::int64_t first = 0;
    for (const std::int32_t count : counts) {
      if (count < 0 || first + count > std::ssize(ids))
        file_.fail("{} counts more nodes than {} has; make the file again", counts_name, name);
      add(name, ids.data() + first, count);
      first += count;
    }
  }

  Polygons polygons(Points3 nodes) const {
    return {std::move(nodes),
            {Eigen::Map<const Offsets>(begin_.data(), std::ssize(begin_)),
             Eigen::Map<const Ids>(ids_.data(), std::ssize(ids_))},
            {}};
  }

private:
  void add(const std::string& name, const std::int32_t* ids, std::int64_t count) {
    const auto first = static_cast<std::ptrdiff_t>(ids_.size());
    for (std::int64_t k = 0; k < count; ++k) {
      if (ids[k] < 1 || ids[k] > nodes_)
        file_.fail("{} has node {} (1-based), but there are {}; make the file again", name, ids[k],
                   nodes_);
      const std::int32_t id = ids[k] - 1;
      if (std::ssize(ids_) == first || ids_.back() != id)
        ids_.push_back(id);
    }
    while (std::ssize(ids_) > first + 1 && ids_.back() == ids_[static_cast<std::size_t>(first)])
      ids_.pop_back();
    if (std::ssize(ids_) < first + 3)
      file_.fail("element {} (0-based) has fewer than three nodes; only faces are read",
                 begin_.size() - 1);
    begin_.push_back(std::ssize(ids_));
  }

  const NetcdfReader& file_;
  std::int64_t nodes_;
  std::vector<std::int64_t> begin_ = {0};
  std::vector<std::int32_t> ids_;
};

bool all_triangles(const Polygons& polygons) {
  for (std::int64_t i = 0; i < polygons.size(); ++i)
    if (polygons.ids.count(i) != 3)
      return false;
  return true;
}

} // namespace

const NetcdfMeshNames& exodus_names() {
  static const NetcdfMeshNames names{
      .cells = "num_elem",
      .vertices = "num_nodes",
      .variables = {"coord", "coordx", "coordy", "coordz", "coor_names", "time_whole", "qa_records",
                    "info_records", "elem_map", "eb_status", "eb_prop1", "eb_names", "node_num_map",
                    "elem_num_map"},
      .derived = {"connect1"}};
  return names;
}

void write_exodus(const std::string& path, const CellGrid& grid, const WriteOptions& options) {
  const Polygons& cells = grid.polygons;
  NetcdfGridFile file(path, options, "CF-1.8");
  NetcdfWriter& netcdf = file.netcdf();
  netcdf.attribute({"title", std::string("cells of a grid on the unit sphere")});
  netcdf.attribute({"api_version", 5.0});
  netcdf.attribute({"version", 5.0});
  netcdf.attribute({"floating_point_word_size", std::int32_t{8}});
  netcdf.attribute({"file_size", std::int32_t{1}});
  netcdf.dimension("num_dim", 3);
  const int nodes = netcdf.dimension("num_nodes", cells.corners.cols());
  const int elements = netcdf.dimension("num_elem", cells.size());
  const int blocks = netcdf.dimension("num_el_blk", 1);
  const std::int64_t most = most_corners(cells);
  const int in_block = netcdf.dimension("num_el_in_blk1", cells.size());
  const int width = netcdf.dimension("num_nod_per_el1", most);
  for (int row = 0; row < 3; ++row)
    file.doubles(
        std::string("coord") + "xyz" [row], { nodes }, {}, coordinate_row(cells.corners, row));
  file.ints("eb_prop1", {blocks}, {{"name", std::string("ID")}}, constant(1));
  file.ints("eb_status", {blocks}, {}, constant(1));
  file.ints("connect1", {in_block, width},
            {{"elem_type", std::string(most == 3 ? "TRI3" : "SHELL" + std::to_string(most))}},
            table<std::int32_t>(most, [&cells](std::int64_t cell, std::int64_t k) {
              return corner_or_last(cells, cell, k) + 1;
            }));
  add_fields(file, options, {.cells = {elements}, .vertices = {nodes}}, exodus_names());
  file.commit();
}

bool is_exodus(const NetcdfReader& file) {
  return file.dimension("num_el_blk") > 0 && file.dimension("num_nodes") >= 0;
}

RawMesh read_exodus(const NetcdfReader& file, FieldChoice choice) {
  Points3 nodes = read_nodes(file);
  require_directions(file.path(), nodes);
  Elements elements(file, nodes.cols());
  NetcdfMeshNames names = exodus_names();
  for (std::int64_t block = 1; block <= file.dimension("num_el_blk"); ++block) {
    const std::string connect = block_name("connect", block),
                      counts = block_name("ebepecnt", block);
    for (const char* stem :
         {"connect", "ebepecnt", "global_id", "edge_type", "parent_a", "parent_b"})
      names.variables.insert(block_name(stem, block));
    file.has_variable(counts) ? elements.add_block(connect, counts) : elements.add_block(connect);
  }
  RawMesh raw;
  raw.polygons = elements.polygons(std::move(nodes));
  if (all_triangles(raw.polygons)) {
    raw.points = std::move(raw.polygons.corners);
    raw.triangles = raw.polygons.ids.items.reshaped(3, raw.polygons.size());
    raw.polygons = {};
    std::swap(names.cells, names.vertices);
  } else {
    raw.polygons.corners = on_sphere(raw.polygons.corners, 1);
  }
  read_fields(file, names, choice, raw);
  return raw;
}

} // namespace calotte::io_detail
