// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view_mesh.h"

#include "draw/plane.h"
#include "draw/shapes.h"
#include "draw/values.h"
#include "options/domain_option.h"
#include "text/text.h"

#include <calotte/check.h>
#include <calotte/quality.h>
#include <calotte/surface.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte::tools {
namespace {

constexpr std::size_t most_fields = 12; // that are shown by default
constexpr const char* mask_name = "bdyMaskCell";

/// Whether the cells are measured as the file has them: those that are not Voronoi cells, and
/// those of a plane that ends at walls, which no domain clips.
bool by_corners(const MeshFile& file) {
  return !file.mesh || (file.plane() && file.polygons && has_walls(*file.mesh));
}

std::int64_t cells_of(const MeshFile& file) {
  return file.mesh ? file.mesh->points.cols() : file.polygons->size();
}

std::int64_t triangles_of(const MeshFile& file) {
  return file.mesh ? file.mesh->triangles.cols() : 0;
}

/// The density of the choice, or that of the file of a closed mesh of the sphere.
Density density_of(const MeshFile& file, const ViewChoice& choice) {
  const bool varies = file.density.size() > 0 && file.density.minCoeff() != file.density.maxCoeff();
  if (!choice.density.uniform() || !varies || !file.sphere() || !file.mesh->closed() ||
      file.density.size() != file.mesh->points.cols())
    return choice.density;
  return interpolated_density(*file.mesh, file.density);
}

/// The values of a field's cells or triangles; empty if they are not of the mesh's.
/// A site with duplicates has the value of the first.
DoubleVector values_of(const MeshField& field, const MeshFile& file) {
  const std::int64_t n = cells_of(file);
  if (field.count() != 1 || field.location == FieldLocation::edges)
    return {};
  if (field.location == FieldLocation::vertices)
    return field.values.size() == triangles_of(file) ? field.values : DoubleVector();
  if (field.values.size() == n)
    return field.values;
  const std::vector<std::int32_t>& site =
      file.mesh ? file.mesh->site_of_input : std::vector<std::int32_t>();
  if (field.values.size() != std::ssize(site))
    return {};
  DoubleVector values(n);
  for (auto cell = std::ssize(site); cell-- > 0;)
    values[site[static_cast<std::size_t>(cell)]] = field.values[cell];
  return values;
}

Quantity shown(const MeshField& field, DoubleVector values) {
  Quantity quantity = quantity_of({.name = field.name,
                                   .long_name = field.long_name,
                                   .units = field.units,
                                   .location = field.location,
                                   .values = std::move(values)});
  if (field.name == mask_name) {
    quantity.name = "region";
    quantity.label = "region";
    quantity.help =
        "0 in the region, 1 to 5 in the relaxation zone, 6 and 7 in the specified zone.";
    quantity.classes = true;
  }
  return quantity;
}

/// Why a field is not among the quantities, a clause; "" if it is.
std::string why_not(const MeshFile& file, const std::string& name) {
  for (const MeshField& field : file.fields)
    if (field.name == name)
      return values_of(field, file).size() > 0        ? ""
             : field.location == FieldLocation::edges ? "it is a field at edges"
                                                      : "it does not have one number for each cell";
  return "the file has no such field, or one with several numbers for each cell, of which --at "
         "chooses one";
}

void require_fields(const MeshFile& file, const ViewChoice& choice) {
  for (const std::string& name : choice.fields)
    if (const std::string reason = why_not(file, name); !reason.empty())
      refuse(message("--field {}: {}; give fields at cells or triangles, or leave --field out",
                     name, reason));
}

/// Adds the fields that are asked for, or the first ones of the file; says which are left out.
void add_fields(const MeshFile& file, const ViewChoice& choice, ViewMesh& mesh) {
  std::size_t added = 0, left = 0;
  for (const MeshField& field : file.fields) {
    const bool asked =
        std::find(choice.fields.begin(), choice.fields.end(), field.name) != choice.fields.end();
    if (!choice.fields.empty() && !asked)
      continue;
    DoubleVector values = values_of(field, file);
    if (values.size() == 0)
      continue;
    if (choice.fields.empty() && field.name != mask_name && added == most_fields) {
      ++left;
      continue;
    }
    mesh.quantities.push_back(shown(field, std::move(values)));
    ++added;
  }
  if (left > 0)
    mesh.notice += message("The page holds {} of {} fields; select others with --field NAME. ",
                           added, added + left);
}

/// The centres of polygons, or the means of their corners.
Points3 centres_of(const Polygons& cells) {
  Points3 centres = cells.centres;
  if (centres.cols() == 0) {
    centres.setZero(3, cells.size());
    for (std::int64_t i = 0; i < cells.size(); ++i)
      for (const std::int32_t corner : cells.ids[i])
        centres.col(i) += cells.corners.col(corner);
  }
  return centres;
}

void set_sphere(const MeshFile& file, ViewMesh& mesh) {
  mesh.points = file.mesh ? file.mesh->points : centres_of(*file.polygons);
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    mesh.points.col(i).stableNormalize();
  if (file.mesh)
    mesh.triangles = file.mesh->triangles;
  if (file.polygons && file.polygons->size() == mesh.cells)
    mesh.shapes = file.polygons;
}

/// Sets the part of the plane that clips the cells: the one that is known, or the box that a
/// picture shows of a plane without an end.
void set_shown_surface(Mesh& mesh, const std::optional<Surface>& known) {
  if (known) {
    set_surface(mesh, *known);
  } else if (mesh.surface == Surface::plane()) {
    const Window window = window_of(mesh);
    mesh.surface = rectangle(window.low, window.high);
  }
}

/// The measures of the cells; of an open mesh of the sphere also of those at its boundary, if the
/// file has them.
CellMeasures measures_of(const MeshFile& file, const ViewChoice& choice) {
  CellMeasures measures = cell_measures(*file.mesh, density_of(file, choice));
  if (file.plane() || !file.polygons || file.polygons->size() != measures.area.size())
    return measures;
  const auto fill = [](DoubleVector& values, const DoubleVector& of_cells) {
    values = values.array().isNaN().select(of_cells, values);
  };
  fill(measures.area, areas(*file.polygons));
  fill(measures.quality, side_ratios(*file.polygons));
  return measures;
}

/// The quantities of the cells and triangles.
std::vector<Quantity> measured(const MeshFile& file, const ViewChoice& choice) {
  const Unit unit = file.plane() ? Unit{"", 1, "", 1} : unit_of(choice.units, choice.radius_km);
  return by_corners(file) ? quantities_of(unwrapped(*file.polygons), unit)
                          : quantities_of(measures_of(file, choice), unit);
}

/// Whether triangles surround a site.
bool has_whole_cell(const Mesh& mesh) {
  std::vector<bool> whole(static_cast<std::size_t>(mesh.points.cols()));
  for (const std::int32_t site : mesh.triangles.reshaped())
    whole[static_cast<std::size_t>(site)] = true;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) < 0)
        for (const int end : {1, 2})
          whole[static_cast<std::size_t>(mesh.triangles((i + end) % 3, t))] = false;
  return std::find(whole.begin(), whole.end(), true) != whole.end();
}

/// The errors of operators; none for cells that are not Voronoi cells, nor where none is whole.
std::vector<Quantity> operator_quantities(const MeshFile& file, const ViewChoice& choice) {
  if (!choice.operators || by_corners(file))
    return {};
  if (file.sphere() && (count_edges(*file.mesh).not_delaunay > 0 || !has_whole_cell(*file.mesh)))
    return {};
  return quantities_of(operator_errors(*file.mesh).by_cell);
}

} // namespace

ViewMesh view_mesh(const std::string& name, MeshFile file, const ViewChoice& choice) {
  require_fields(file, choice);
  const bool walled = file.plane() && by_corners(file);
  if (file.plane() && !walled)
    set_shown_surface(*file.mesh, choice.surface ? choice.surface : filled_surface(file));
  ViewMesh mesh{.name = name, .on_sphere = !file.plane(), .radius_km = choice.radius_km};
  mesh.cells = mesh.total = cells_of(file);
  mesh.quantities = measured(file, choice);
  for (Quantity& quantity : operator_quantities(file, choice))
    mesh.quantities.push_back(std::move(quantity));
  add_fields(file, choice, mesh);
  if (walled)
    set_plane(mesh, *file.mesh, *file.polygons);
  else if (file.plane())
    set_plane(mesh, *file.mesh);
  else
    set_sphere(file, mesh);
  if (mesh.on_sphere && choice.view)
    mesh.home = direction_of(*choice.view);
  if (mesh.cells <= choice.most_cells)
    return mesh;
  thin(mesh, choice.most_cells);
  return mesh;
}

} // namespace calotte::tools
