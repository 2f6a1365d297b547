// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/files.h"
#include "support/text.h"

#include <calotte/cut.h>
#include <calotte/grid.h>
#include <calotte/mesh_file.h>
#include <calotte/refine.h>
#include <calotte/remap.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace calotte;
using namespace calotte::test;

namespace {

const Eigen::Vector3d centre_of_refinement = Eigen::Vector3d(0.3, -0.5, 0.6).normalized();

/// A global file with a linear field, one of whole numbers and one at vertices.
MeshFile global_file() {
  MeshFile file;
  file.mesh = make_grid({.cells = 2562}).mesh;
  const Points3& x = file.mesh->points;
  file.fields.push_back({.name = "height", .values = 3 * x.row(0).transpose()});
  file.fields.push_back({.name = "kind",
                         .values = (x.row(2).transpose().array() > 0.6).cast<double>(),
                         .integer = true});
  file.fields.push_back({.name = "pair",
                         .values = DoubleVector::LinSpaced(2 * x.cols(), 0, 1),
                         .dimensions = {{"two", 2}}});
  file.fields.push_back({.name = "corner",
                         .location = FieldLocation::vertices,
                         .values = DoubleVector::Zero(file.mesh->triangles.cols())});
  return file;
}

ChangedMesh finer(const Mesh& mesh) {
  WidthDemand demand;
  demand.region = circle(centre_of_refinement, 0.2);
  demand.factor = 1.8;
  return refine(mesh, demand, {.gradient = 0.1}); // so that it ends before the boundary
}

const MeshField& field(const MeshFile& file, const std::string& name) {
  const auto at = std::ranges::find(file.fields, name, &MeshField::name);
  REQUIRE(at != file.fields.end());
  return *at;
}

std::string problems(const std::string& path) {
  std::string all;
  for (const Deviation& deviation : check_file(path, read_mesh_file(path)))
    all += deviation.text + "\n";
  return all;
}

} // namespace

TEST_CASE("fields and density follow the cells of a mesh that changed") {
  const MeshFile old = global_file();
  const ChangedMesh changed = finer(*old.mesh);
  REQUIRE(changed.patches.size() == 1);
  const ChangedFile out = changed_file(old, changed, {.nearest = {"pair"}});
  CHECK(out.nearest == std::vector<std::string>{"kind", "pair"});
  CHECK(out.left_out == std::vector<std::string>{"corner"});
  CHECK(out.file.mesh->triangles == changed.mesh.triangles);
  const MeshField &height = field(out.file, "height"), &kind = field(out.file, "kind"),
                  &two = field(out.file, "pair"), &map = field(out.file, "mapNewToBase");
  const DoubleVector& density = out.file.density;
  double kept_density = 0;
  for (std::int32_t i = 0; i < changed.old_of_new.size(); ++i) {
    const std::int32_t before = changed.old_of_new[i];
    CHECK(map.values[i] == before + 1);
    CHECK((kind.values[i] == 0 || kind.values[i] == 1));
    if (before < 0) {
      // Linear on flat triangles: below the sphere by at most h^2 / 6.
      CHECK(std::abs(height.values[i] - 3 * changed.mesh.points(0, i)) < 0.01);
      continue;
    }
    CHECK(height.values[i] == field(old, "height").values[before]);
    CHECK(kind.values[i] == field(old, "kind").values[before]);
    CHECK(two.values.segment(2 * i, 2) == field(old, "pair").values.segment(2 * before, 2));
    kept_density = density[i];
  }
  CHECK(density.maxCoeff() == 1);
  CHECK(std::abs(kept_density - std::pow(1.8, -4)) < 0.02);
  CHECK(has(message_of([&] { changed_file(old, changed, {.nearest = {"depth"}}); }),
            "no field \"depth\" at cells"));
}

TEST_CASE("conservative fields are means over new cells, also without values somewhere") {
  MeshFile old = global_file();
  const auto sites = old.mesh->points.cols();
  DoubleVector gap = old.fields[0].values;
  for (Eigen::Index i = 0; i < sites; ++i)
    if (old.mesh->points(0, i) > centre_of_refinement.x())
      gap[i] = std::numeric_limits<double>::quiet_NaN();
  old.fields.push_back({.name = "gap", .values = gap});
  const ChangedMesh changed = finer(*old.mesh);
  const ChangedFile out = changed_file(old, changed, {.conservative = {"height", "kind"}});
  CHECK(out.nearest.empty());
  const Voronoi before = voronoi(*old.mesh), after = voronoi(changed.mesh);
  const GridWeights all = conservative_weights(polygons_of(before), polygons_of(after));
  const DoubleVector height = all.weights * field(old, "height").values,
                     share = all.weights * field(old, "kind").values;
  std::int64_t without = 0;
  for (std::int32_t i = 0; i < changed.old_of_new.size(); ++i) {
    if (changed.old_of_new[i] >= 0)
      continue;
    CHECK(std::abs(field(out.file, "height").values[i] - height[i]) < 1e-13);
    if (std::abs(share[i] - 0.5) > 1e-9)
      CHECK(field(out.file, "kind").values[i] == (share[i] > 0.5 ? 1 : 0));
    const double x = changed.mesh.points(0, i), filled = field(out.file, "gap").values[i];
    without += std::isnan(filled) ? 1 : 0;
    if (x < centre_of_refinement.x() - 0.1 || x > centre_of_refinement.x() + 0.1)
      CHECK(std::isnan(filled) == (x > centre_of_refinement.x()));
  }
  CHECK(without > 0);
  const auto problem = [&](const FieldMethods& methods) {
    return message_of([&] { changed_file(old, changed, methods); });
  };
  CHECK(has(problem({.conservative = {"depth"}}), "no field \"depth\""));
  CHECK(has(problem({.nearest = {"height"}, .conservative = {"height"}}),
            "both nearest and conservative"));
}

TEST_CASE("conservative fields where nothing changes") {
  MeshFile old = global_file();
  const ChangedMesh same = refine(*old.mesh, {.widths = Widths(1e4)});
  REQUIRE(same.patches.empty());
  const ChangedFile out = changed_file(old, same, {.conservative = {"height"}});
  CHECK(field(out.file, "height").values == field(old, "height").values);
}

TEST_CASE("cells at the boundary of a limited area keep their corners [slow]") {
  const Scratch scratch;
  const std::string global = scratch / "global.nc", area = scratch / "area.nc",
                    result = scratch / "result.nc";
  write(global, *global_file().mesh);
  cut(global, area, circle(centre_of_refinement, 0.55));
  MeshFile old = read_mesh_file(area);
  REQUIRE(old.polygons);
  old.fields.push_back({.name = "one", .values = DoubleVector::Ones(old.polygons->size())});
  const ChangedMesh changed = finer(*old.mesh);
  CHECK(changed.held == 0);
  const ChangedFile out = changed_file(old, changed, {.conservative = {"one"}});
  CHECK((field(out.file, "one").values.array() - 1).abs().maxCoeff() < 1e-12);
  REQUIRE(out.file.polygons);
  const Polygons &before = *old.polygons, &after = *out.file.polygons;
  std::int64_t whole = 0;
  for (std::int32_t i = 0; i < changed.old_of_new.size(); ++i) {
    if (changed.old_of_new[i] < 0)
      continue;
    const auto was = before.ids[changed.old_of_new[i]], is = after.ids[i];
    bool same = was.size() == is.size();
    for (std::size_t k = 0; same && k < is.size(); ++k) // the first corner is free
      same = std::ranges::any_of(was, [&](std::int32_t corner) {
        return before.corners.col(corner) == after.corners.col(is[k]);
      });
    whole += same ? 1 : 0;
    if (field(old, "bdyMaskCell").values[changed.old_of_new[i]] > 5)
      CHECK(same);
  }
  CHECK(whole > 250);
  WriteOptions options;
  options.numbering = Numbering::input;
  write(result, out.file, options);
  CHECK(problems(result).empty()); // with the masks of edges and vertices
  CHECK(out.left_out.empty());
  CHECK(write(scratch / "cells.ugrid.nc", out.file, {.format = Format::ugrid}).dropped ==
        std::vector<std::string>{"bdyMaskEdge", "bdyMaskVertex"});
  const MeshFile again = read_mesh_file(result);
  CHECK(again.polygons->size() == after.size());
  CHECK(field(again, "bdyMaskCell").values == field(out.file, "bdyMaskCell").values);
}
