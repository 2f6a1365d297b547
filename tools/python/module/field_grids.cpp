// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "members.h"
#include "module.h"

#include <calotte/field_grid.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

using Grid = std::shared_ptr<FieldGrid>;

Grid grid_of_boxes(const std::shared_ptr<LonLatBoxes>& boxes) {
  auto grid = std::make_shared<FieldGrid>();
  grid->name = "the raster";
  grid->boxes = *boxes;
  return grid;
}

/// \param cells of the mesh where they are not its Voronoi cells; a mesh may be none.
Grid grid_of_mesh(const std::shared_ptr<Mesh>& mesh, const std::shared_ptr<Polygons>& cells) {
  auto grid = std::make_shared<FieldGrid>();
  grid->name = "the mesh";
  if (mesh)
    grid->mesh.mesh = *mesh;
  if (cells)
    grid->mesh.polygons = *cells;
  return grid;
}

Interpolation kind_of(const std::string& method) {
  return method == "conservative" ? Interpolation::conservative
         : method == "nearest"    ? Interpolation::nearest
         : method == "natural"    ? Interpolation::natural_neighbours
                                  : Interpolation::linear;
}

/// \param points n x 3 directions, or n x 2 of a plane.
Grid grid_of_positions(const Doubles& points, const Surface& surface) {
  auto grid = std::make_shared<FieldGrid>();
  grid->name = "the positions";
  const auto places = columns(points);
  Positions& positions = grid->positions.emplace();
  positions.surface = surface;
  positions.points = Points3::Zero(3, places.cols());
  positions.points.topRows(places.rows()) = places;
  return grid;
}

/// \param values k x n, fields of the positions. \returns k x m, and the number of merged rows.
py::tuple scattered(const FieldGrid& positions, const Doubles& values, const FieldGrid& target,
                    const std::string& method) {
  const auto by_position = columns(values); // n x k, as columns of numpy's rows
  std::int64_t merged = 0;
  Eigen::MatrixXd found = call([&] {
    FieldGrid source = positions;
    for (Eigen::Index k = 0; k < by_position.cols(); ++k) {
      MeshField& field = source.fields.emplace_back();
      field.name = "values[" + std::to_string(k) + "]";
      field.values = by_position.col(k);
    }
    const ScatteredFields at = interpolate_scattered(source, target, kind_of(method));
    merged = at.merged;
    Eigen::MatrixXd out(target.size(), by_position.cols());
    for (Eigen::Index k = 0; k < out.cols(); ++k)
      out.col(k) = at.fields[static_cast<std::size_t>(k)].values;
    return out;
  });
  return py::make_tuple(handed_over(std::move(found)), merged);
}

std::shared_ptr<GridWeights> weights_between(const FieldGrid& source, const FieldGrid& target,
                                             const std::string& method) {
  return call([&] {
    return std::make_shared<GridWeights>(interpolation_weights(source, target, kind_of(method)));
  });
}

/// \param source a mesh or a raster. \param positions on its surface.
template <class Source>
std::shared_ptr<GridWeights> weights_at(const Source& source, const Doubles& positions,
                                        const std::string& method) {
  const auto places = columns(positions);
  return call([&] {
    auto out = std::make_shared<GridWeights>();
    out->weights = interpolation_weights(source, places, kind_of(method));
    out->source_fraction = DoubleVector::Ones(out->weights.cols());
    out->target_fraction.resize(out->weights.rows());
    const int* const begin = out->weights.outerIndexPtr();
    for (Eigen::Index i = 0; i < out->weights.rows(); ++i)
      out->target_fraction[i] = begin[i + 1] > begin[i] ? 1 : 0;
    return out;
  });
}

/// \param values n x fields. \returns k x fields.
py::array apply(const GridWeights& weights, const Doubles& values, double min_cover) {
  const auto by_field = columns(values);
  return handed_over(call([&] {
    MeshField field{.name = "values"};
    field.dimensions = {{"fields", by_field.rows()}};
    field.values = Eigen::Map<const Eigen::VectorXd>(by_field.data(), by_field.size());
    const MeshField found = interpolate(weights, field, min_cover);
    return Eigen::MatrixXd(Eigen::Map<const Eigen::MatrixXd>(found.values.data(), by_field.rows(),
                                                             weights.weights.rows()));
  }));
}

/// Values, columns and where the rows begin, over the memory of the weights.
py::tuple rows_of(const py::object& self) {
  const Weights& weights = self.cast<const GridWeights&>().weights;
  return py::make_tuple(py::array_t<double>({weights.nonZeros()}, weights.valuePtr(), self),
                        py::array_t<int>({weights.nonZeros()}, weights.innerIndexPtr(), self),
                        py::array_t<int>({weights.rows() + 1}, weights.outerIndexPtr(), self),
                        py::make_tuple(weights.rows(), weights.cols()));
}

void write(const std::string& path, const GridWeights& weights, const FieldGrid& source,
           const FieldGrid& target, const std::string& method, bool scrip) {
  call([&] {
    write_weights(path, weights, source, target, kind_of(method),
                  scrip ? WeightsFormat::scrip : WeightsFormat::esmf);
    return 0;
  });
}

std::shared_ptr<LonLatBoxes> boxes_of_nodes(const Eigen::VectorXd& longitudes,
                                            const Eigen::VectorXd& latitudes) {
  return std::make_shared<LonLatBoxes>(lon_lat_boxes(longitudes, latitudes));
}

} // namespace

void add_field_grids(py::module_& module) {
  py::class_<LonLatBoxes, std::shared_ptr<LonLatBoxes>> boxes(
      module, "Raster",
      "The boxes of a raster of longitudes and latitudes, of raster(): ny rows of nx boxes.");
  add_members(boxes, Member{"longitudes", &LonLatBoxes::longitudes, "(nx,) degrees, of the nodes."},
              Member{"latitudes", &LonLatBoxes::latitudes, "(ny,) degrees, of the nodes."},
              Member{"meridians", &LonLatBoxes::meridians,
                     "(nx + 1,) degrees, between which the boxes are."},
              Member{"parallels", &LonLatBoxes::parallels,
                     "(ny + 1,) degrees, between which the boxes are."});
  boxes.def_property_readonly(
      "areas", [](const LonLatBoxes& of) { return handed_over(areas(of)); },
      "(ny * nx,) areas in steradians, row after row.");
  boxes.def("__len__", &LonLatBoxes::size);
  py::class_<GridWeights, std::shared_ptr<GridWeights>> weights(module, "_GridWeights");
  add_member(weights, Member{"source_area", &GridWeights::source_area, ""});
  add_member(weights, Member{"target_area", &GridWeights::target_area, ""});
  add_member(weights, Member{"source_fraction", &GridWeights::source_fraction, ""});
  add_member(weights, Member{"target_fraction", &GridWeights::target_fraction, ""});
  weights.def("rows", &rows_of);
  weights.def("apply", &apply);
  py::class_<FieldGrid, Grid>(module, "_FieldGrid").def("__len__", &FieldGrid::size);
  module.def("first_misplaced", [](const FieldGrid& grid, const Doubles& positions) {
    const auto places = columns(positions);
    return call([&] { return first_misplaced(grid.mesh, places); });
  });
  module.def("global_raster", [](std::int64_t columns, std::int64_t rows) {
    return std::make_shared<LonLatBoxes>(lon_lat_boxes(columns, rows));
  });
  module.def("raster_of_nodes", &boxes_of_nodes);
  module.def("grid_of_boxes", &grid_of_boxes);
  module.def("grid_of_mesh", &grid_of_mesh);
  module.def("grid_of_positions", &grid_of_positions);
  module.def("interpolate_scattered", &scattered);
  module.def("grid_weights", &weights_between);
  module.def("weights_at", &weights_at<Mesh>);
  module.def("weights_at", &weights_at<LonLatBoxes>);
  module.def("write_grid_weights", &write);
  module.def("read_grid_weights", [](const std::string& path) {
    return call([&] { return std::make_shared<GridWeights>(read_weights(path)); });
  });
}

} // namespace calotte::python
