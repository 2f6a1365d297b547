// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/cut_laws.h"
#include "support/files.h"
#include "support/global_file.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/cut.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

// Ocean grids: fractions of land, seas, and files without their cells of land.

using namespace calotte;
using namespace calotte::test;
using namespace calotte::test::cut_laws;

namespace {

Coast coast_of(const std::vector<Surface>& regions) {
  Coast coast;
  for (const Surface& region : regions) {
    coast.area += region.area();
    coast.rings.insert(coast.rings.end(), region.rings().begin(), region.rings().end());
  }
  return coast;
}

/// A continent around a pole, a wide and a narrow one, and small islands.
Coast world() {
  const Eigen::Vector3d wide = Eigen::Vector3d(1, 0.1, 0.2).normalized(),
                        narrow = Eigen::Vector3d(-1, 0.3, 0.4).normalized();
  std::vector<Surface> regions{channel(-std::numbers::pi / 2, -1.2), circle(wide, 0.5),
                               ellipse(narrow, 0.9, 0.05, 0.3)};
  std::vector<Eigen::Vector3d> islands;
  Random random(7);
  for (int k = 0; k < 400; ++k) {
    const base_detail::Vec3 at = random.direction();
    const Eigen::Vector3d centre(at.x, at.y, at.z);
    bool free = centre.z() > -0.85 && centre.dot(wide) < 0.84 && centre.dot(narrow) < 0.5;
    for (const Eigen::Vector3d& other : islands)
      free = free && (centre - other).norm() > 0.05;
    if (free) {
      islands.push_back(centre);
      regions.push_back(circle(centre, random.real(1e-3, 0.02), 12));
    }
  }
  return coast_of(regions);
}

Voronoi tessellation_of(const Points3& points) { return voronoi(delaunay(points)); }

/// The fraction of a cell by points in it, for a region that is one circle.
double sampled_fraction(const Voronoi& cells, Eigen::Index i, const Surface& region) {
  double all = 0, land = 0;
  const Eigen::Vector3d c = cells.cells.col(i);
  const auto corners = cells.vertices_on_cell[i];
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3d a = cells.vertices.col(corners[k]),
                          b = cells.vertices.col(corners[(k + 1) % corners.size()]);
    constexpr int n = 40;
    for (int s = 0; s < n; ++s)
      for (int t = 0; s + t < n; ++t) {
        const double u = (s + 1 / 3.0) / n, v = (t + 1 / 3.0) / n;
        const Eigen::Vector3d p = c + u * (a - c) + v * (b - c);
        const double weight = (a - c).cross(b - c).norm() / std::pow(p.norm(), 3);
        all += weight;
        land += region.contains(p) ? weight : 0;
      }
  }
  return land / all;
}

} // namespace

TEST_CASE("fractions of land sum to its area, for coasts and cells of any size") {
  const Coast coast = world();
  REQUIRE(coast.rings.size() > 100);
  for (const Points3& points :
       {bisected_icosahedron(0), bisected_icosahedron(2), cubed_sphere(8), fibonacci_sphere(1000),
        fibonacci_sphere(10000), random_sphere(500, 3)}) {
    const Voronoi cells = tessellation_of(points);
    const Eigen::VectorXd fractions = land_fractions(cells, coast);
    CHECK(fractions.minCoeff() >= 0);
    CHECK(fractions.maxCoeff() <= 1);
    CHECK(std::abs(fractions.dot(cells.cell_area) - coast.area) <= 1e-10);
  }
}

TEST_CASE("a fraction is that of points in the cell") {
  const Surface region = circle({0.2, -0.4, 0.5}, 0.7);
  const Voronoi cells = tessellation_of(fibonacci_sphere(60));
  const Eigen::VectorXd fractions = land_fractions(cells, coast_of({region}));
  for (Eigen::Index i = 0; i < cells.cells.cols(); ++i)
    CHECK(fractions[i] ==
          doctest::Approx(sampled_fraction(cells, i, region)).epsilon(0.02).scale(1));
}

TEST_CASE("fractions: complements, adjoining polygons, islands in a cell, threads") {
  const Voronoi cells = tessellation_of(fibonacci_sphere(2000));
  const Surface cap = circle({0, 0.1, 1}, 0.8);
  const Points3 ring = cap.rings()[0].rowwise().reverse();
  const Surface outside = Surface::sphere().within({ring});
  const Eigen::VectorXd in = land_fractions(cells, coast_of({cap})),
                        out = land_fractions(cells, coast_of({outside}));
  CHECK((in + out - Eigen::VectorXd::Ones(in.size())).cwiseAbs().maxCoeff() <= 1e-10);

  Points3 west(3, 4), east(3, 4); // share the arc from 0 to 1
  west << 1, 0.6, 0.2, 0.8, 0, 0, -0.5, -0.5, 0.1, 0.8, 0.8, 0.1;
  east << 0.6, 1, 0.8, 0.2, 0, 0, 0.5, 0.5, 0.8, 0.1, 0.1, 0.8;
  const Surface a = enclosed_region({west.colwise().normalized()}),
                b = enclosed_region({east.colwise().normalized()});
  const Eigen::VectorXd both = land_fractions(cells, coast_of({a, b}));
  CHECK((both - land_fractions(cells, coast_of({a})) - land_fractions(cells, coast_of({b})))
            .cwiseAbs()
            .maxCoeff() <= 1e-10);

  const Surface island = circle(cells.cells.col(17), 1e-4, 16);
  const Eigen::VectorXd dot = land_fractions(cells, coast_of({island}));
  CHECK(dot[17] * cells.cell_area[17] == doctest::Approx(island.area()).epsilon(1e-9));
  CHECK(dot.sum() == doctest::Approx(dot[17]).epsilon(1e-9));

  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    const Eigen::VectorXd again =
        arena.execute([&] { return land_fractions(cells, coast_of({cap})); });
    CHECK((again.array() == in.array()).all());
  }
}

TEST_CASE("lines cross cells that share edges, from one end to the other") {
  const Voronoi cells = tessellation_of(fibonacci_sphere(2000));
  Points3 line(3, 3);
  line << 1, 0, -0.3, 0, 1, 0.2, 0.1, 0.3, -1;
  line = line.colwise().normalized().eval();
  const std::vector<std::int32_t> found = cells_on_lines(cells, {line});
  CHECK(std::is_sorted(found.begin(), found.end()));
  std::vector<std::uint8_t> land(2000, 1);
  for (const std::int32_t cell : found)
    land[static_cast<std::size_t>(cell)] = 0;
  SeaOptions options;
  options.fill = false;
  CHECK(sea_cells(cells.cells_on_cell, land, options).report.parts == 1);
  for (const Eigen::Index end : {0, 2}) {
    Eigen::Index nearest = 0;
    (cells.cells.colwise() - line.col(end)).colwise().norm().minCoeff(&nearest);
    CHECK(std::binary_search(found.begin(), found.end(), nearest));
  }
}

namespace {

/// Two hemispheres of sea with land between, as wide as several cells.
struct Divided {
  Voronoi cells = tessellation_of(fibonacci_sphere(2000));
  std::vector<std::uint8_t> land;
  Points3 line{3, 2}; ///< from pole to pole, almost

  Divided() {
    for (Eigen::Index i = 0; i < cells.cells.cols(); ++i)
      land.push_back(std::abs(cells.cells(2, i)) < 0.2 ? 1 : 0);
    line << 0.6, 0.6, 0, 0, 0.8, -0.8;
  }
  SeaReport report(const SeaOptions& options, Ids& sea) const {
    SeaCells decided = sea_cells(cells.cells_on_cell, land, options);
    sea = std::move(decided.mask);
    return decided.report;
  }
};

std::int64_t neighbours_in(const Voronoi& cells, const Ids& sea, std::int64_t i) {
  std::int64_t count = 0;
  for (const std::int32_t other : cells.cells_on_cell[i])
    count += sea[other] >= 0;
  return count;
}

} // namespace

TEST_CASE("a passage joins two seas, a barrier parts them again, seeds choose") {
  const Divided divided;
  Ids sea;
  SeaOptions options;
  CHECK(divided.report(options, sea).parts == 2);
  options.opened = cells_on_lines(divided.cells, {divided.line});
  const SeaReport open = divided.report(options, sea);
  CHECK(open.parts == 1);
  CHECK(open.opened > 3);
  CHECK(open.severed == 0);
  CHECK(open.severed_parts.empty());
  for (std::int64_t i = 0; i < sea.size(); ++i)
    CHECK((sea[i] < 0 || neighbours_in(divided.cells, sea, i) >= 2));

  options = {};
  for (const std::int32_t seed : {0, 1999}) { // near the poles
    options.seeds = {seed};
    const SeaReport one = divided.report(options, sea);
    CHECK(sea[seed] == 0);
    CHECK(sea[1999 - seed] == -1);
    CHECK(one.severed > 500);
    REQUIRE(one.severed_parts.size() == 1);
    CHECK(one.severed_parts[0].cells == one.severed);
    const auto middle = one.severed_parts[0].middle; // within a cell or two of the other pole
    CHECK(divided.cells.cells(2, middle) * (seed == 0 ? -1 : 1) > 0.98);
  }
  options.seeds = {0, 1999};
  CHECK(divided.report(options, sea).severed == 0);
  options.seeds = {1000};
  CHECK(message_of([&] { divided.report(options, sea); }) ==
        "seed 0 is on land, in cell 1000; give a place in the sea");
}

TEST_CASE("cells with a single neighbour are filled until none is left; a barrier parts seas") {
  Divided divided;
  SeaOptions options;
  const Voronoi& cells = divided.cells;
  const std::int32_t lone = 1000, other = cells.cells_on_cell[lone].front();
  options.opened = {lone, other}; // a lake of two cells
  Ids sea;
  options.fill = false;
  const SeaReport all = divided.report(options, sea);
  CHECK(all.opened == 2);
  CHECK(all.parts == 3);
  CHECK(all.filled == 0);
  options.fill = true;
  const SeaReport filled = divided.report(options, sea);
  CHECK(filled.parts == 2);
  CHECK(filled.filled >= 2);
  for (std::int64_t i = 0; i < sea.size(); ++i)
    CHECK((sea[i] < 0 || neighbours_in(divided.cells, sea, i) >= 2));

  Divided ocean; // no land but a barrier around the equator
  std::fill(ocean.land.begin(), ocean.land.end(), 0);
  Points3 equator(3, 5);
  equator << 1, 0, -1, 0, 1, 0, 1, 0, -1, 0, 0, 0, 0, 0, 0;
  options = {};
  options.closed = cells_on_lines(ocean.cells, {equator});
  const SeaReport parted = ocean.report(options, sea);
  CHECK(parted.parts == 2);
  CHECK(parted.closed == std::ssize(options.closed));
}

namespace {

/// What differs from a cut: edges whose first cell is land are reversed.
std::vector<bool> reversed_edges(const Pair& pair) {
  std::vector<bool> reversed;
  for (const int old : pair.old.at("nEdges"))
    reversed.push_back(
        !pair.kept("nCells", pair.before.id("cellsOnEdge", static_cast<std::size_t>(old), 0)));
  return reversed;
}

void check_edges(const Pair& pair) {
  const std::vector<bool> reversed = reversed_edges(pair);
  int wrong = 0;
  for (std::size_t e = 0; e < reversed.size(); ++e) {
    const auto old = static_cast<std::size_t>(pair.old.at("nEdges")[e]);
    const std::size_t first = reversed[e] ? 1 : 0;
    wrong += pair.after.id("cellsOnEdge", e, 0) < 0;
    for (const auto& [name, of] :
         {std::pair{"cellsOnEdge", "nCells"}, std::pair{"verticesOnEdge", "nVertices"}})
      for (const std::size_t k : {0, 1}) {
        const int id = pair.before.id(name, old, k == 0 ? first : 1 - first);
        wrong += pair.after.id(name, e, k) != pair.now.at(of)[static_cast<std::size_t>(id)];
      }
    const double turn = pair.after.at("angleEdge", e) - pair.before.at("angleEdge", old);
    wrong += std::abs(std::cos(turn) - (reversed[e] ? -1 : 1)) > 1e-12 ||
             std::abs(pair.after.at("angleEdge", e)) > std::numbers::pi + 1e-12;
    const std::size_t width = pair.after.variables.at("weightsOnEdge").width();
    for (std::size_t k = 0; k < width; ++k) {
      const int other = pair.after.id("edgesOnEdge", e, k);
      const double sign =
          other >= 0 && reversed[e] != reversed[static_cast<std::size_t>(other)] ? -1 : 1;
      wrong += pair.after.at("weightsOnEdge", e, k) !=
               (other < 0 ? 0 : sign * pair.before.at("weightsOnEdge", old, k));
    }
  }
  CHECK(wrong == 0);
  CHECK(std::count(reversed.begin(), reversed.end(), true) > 10);
}

void check_kites(const Pair& pair) {
  int wrong = 0;
  for (std::size_t v = 0; v < pair.after.dimensions.at("nVertices"); ++v) {
    const auto old = static_cast<std::size_t>(pair.old.at("nVertices")[v]);
    double sum = 0;
    bool all = true;
    for (std::size_t j = 0; j < 3; ++j) {
      const bool kept = pair.after.id("cellsOnVertex", v, j) >= 0;
      const double kite = kept ? pair.before.at("kiteAreasOnVertex", old, j) : 0;
      wrong += pair.after.at("kiteAreasOnVertex", v, j) != kite;
      sum += kite;
      all = all && kept;
    }
    wrong += pair.after.at("areaTriangle", v) != (all ? pair.before.at("areaTriangle", old) : sum);
  }
  CHECK(wrong == 0);
}

void check_maps(const Pair& pair) {
  int wrong = 0;
  for (const Kind& kind : kinds)
    for (std::size_t i = 0; i < pair.after.dimensions.at(kind.dimension); ++i)
      wrong += pair.after.at("mapCulledToBase" + kind.name, i) != pair.old.at(kind.dimension)[i];
  CHECK(wrong == 0);
}

} // namespace

TEST_CASE("a culled file: the sea, edges with a first cell, kites, maps, all fields") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "ocean.nc",
                    mask = scratch / "mask.nc";
  for (const int format : {NC_64BIT_OFFSET, NC_NETCDF4}) {
    write_global(scratch, source, {.cells = 2000, .radius = 6371229, .format = format});
    CullOptions options;
    options.coast = world();
    options.mask_path = mask;
    options.history = "culled by a test";
    const CullReport report = cull(source, target, options);
    const Pair pair(source, target);
    CHECK(report.cells == std::ssize(pair.old.at("nCells")));
    CHECK(report.land > 100);
    check_edges(pair);
    check_kites(pair);
    check_maps(pair);
    check_boundary(pair.after);
    check_fields(pair, {"angleEdge", "kiteAreasOnVertex", "areaTriangle"});
    check_graph(pair.after, scratch / "ocean.graph.info");
    check_none(target);
    const Contents masks = contents_of(mask);
    for (std::size_t i = 0; i < 2000; ++i) {
      const bool culled = !pair.kept("nCells", static_cast<int>(i));
      REQUIRE(masks.at("cullCell", i) == (culled ? 1 : 0));
      REQUIRE(masks.at("regionCellMasks", i) == (culled ? 1 : 0));
      REQUIRE((culled || masks.at("landFraction", i) <= 0.5));
    }
  }
}

TEST_CASE("the sea by a field, and what is refused") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "ocean.nc";
  write_global(scratch, source, {.cells = 1000});
  CullOptions options;
  options.field = {"", "zCell", 0.1, 0.9};
  const CullReport report = cull(source, target, options);
  const Pair pair(source, target);
  for (const double z : pair.after.numbers.at("zCell"))
    CHECK((z >= 0.1 && z < 0.9));
  CHECK(report.cells > 350);
  check_none(target);
  std::filesystem::remove(target);
  const auto refusal = [&](const CullOptions& wrong) {
    const std::string text = error_of([&] { cull(source, target, wrong); }).what();
    CHECK(!std::filesystem::exists(target));
    return text;
  };
  CHECK(refusal({}) == "there is no land; give a coast, a raster, a field or a barrier");
  options.field.variable = "absent";
  CHECK(has(refusal(options), "absent"));
  options.field = {"", "zCell", 2, 3};
  CHECK(refusal(options) ==
        "no cell is sea; check the polygons, the values of the raster, or the bounds of the field");
  options.field = {"", "zCell", 0, 1};
  options.land_fraction = 1;
  CHECK(has(refusal(options), "fraction of land"));
  options.land_fraction = 0.5;
  options.seeds = Points3(Eigen::Vector3d(0, 0, -1));
  CHECK(refusal(options).starts_with("seed 0 is on land, in cell "));
  options = {};
  options.coast = coast_of({circle({0, 0, 1}, 0.5)});
  Points3 strait(3, 2), inland(3, 2);
  strait << Eigen::Vector3d(0, 0.7, 0.7), Eigen::Vector3d(0, 0, 1);
  inland << Eigen::Vector3d(0, 0.1, 1), Eigen::Vector3d(0, 0, 1);
  options.passages = {strait.colwise().normalized(), inland.colwise().normalized()};
  cull(source, target, options); // the second one continues the first
  std::filesystem::remove(target);
  options.passages = {options.passages[1]};
  CHECK(refusal(options) == "passage 0 lies on land only and reaches no sea; begin and end it in "
                            "the sea, and give longitudes "
                            "first");
  options = {};
  options.coast = coast_of({circle({0, 0, 1}, 0.5), circle({0, 0.1, 1}, 0.5)});
  CHECK(has(refusal(options), "times, as its polygons overlap or cross"));
  Points3 bow(3, 4); // of which one half is to the left, the other to the right
  bow << 1, 1, 1, 1, -0.3, 0.3, 0.3, -0.3, -0.3, 0.3, -0.3, 0.3;
  options.coast = {{bow.colwise().normalized()}, 0};
  CHECK(has(refusal(options), "times, as its polygons overlap or cross"));
}

TEST_CASE("coasts of GeoJSON: orientation does not matter, holes, a cut along the date line") {
  const Scratch scratch;
  const std::string path = scratch / "land.geojson";
  const auto area_of = [&](const std::string& coordinates) {
    write_text(path, R"({"type":"Polygon","coordinates":)" + coordinates + "}");
    return read_coast(path).area;
  };
  const std::string outer = "[[0,0],[20,0],[20,20],[0,20],[0,0]]",
                    hole = "[[5,5],[10,5],[10,10],[5,10],[5,5]]",
                    turned = "[[0,0],[0,20],[20,20],[20,0],[0,0]]";
  const double whole = area_of("[" + outer + "]"), small = area_of("[" + hole + "]");
  CHECK(whole == doctest::Approx(0.1194).epsilon(0.01));
  CHECK(area_of("[" + turned + "]") == doctest::Approx(whole).epsilon(1e-14));
  CHECK(area_of("[" + turned + "," + hole + "]") == doctest::Approx(whole - small).epsilon(1e-14));
  const std::string absent = scratch / "binned_GSHHS_h.nc";
  CHECK(message_of([&] { read_coast(absent); }) ==
        "cannot read " + absent +
            ": No such file; it comes with Debian's package gmt-gshhg-high, in "
            "/usr/share/gmt-gshhg; install it, or give other polygons of land");
  const auto area_around = [&](const std::string& inside) {
    write_text(path, R"({"type":"Feature","properties":{"inside":)" + inside +
                         R"(},"geometry":{"type":"Polygon","coordinates":[)" + turned + "," + hole +
                         "]}}");
    return read_coast(path).area;
  };
  CHECK(area_around("[2,3]") == doctest::Approx(whole - small).epsilon(1e-14));
  CHECK(area_around("[7,8]") ==
        doctest::Approx(4 * std::numbers::pi - whole + small).epsilon(1e-14));
  write_text(path, R"({"type":"MultiPolygon","coordinates":[
      [[[170,-5],[180,-5],[180,5],[170,5],[170,-5]]],
      [[[-180,-5],[-170,-5],[-170,5],[-180,5],[-180,-5]]],
      [[[-180,-80],[-90,-80],[0,-80],[90,-80],[180,-80],[180,-90],[-180,-90],[-180,-80]]]]})");
  const Coast coast = read_coast(path);
  const Voronoi cells = tessellation_of(bisected_icosahedron(3));
  const Eigen::VectorXd fractions = land_fractions(cells, coast);
  CHECK(std::abs(fractions.dot(cells.cell_area) - coast.area) <= 1e-10);
  Eigen::Index south = 0, date_line = 0;
  cells.cells.row(2).minCoeff(&south);
  cells.cells.row(0).minCoeff(&date_line);
  CHECK(fractions[south] == doctest::Approx(1).epsilon(1e-12));
  CHECK(fractions[date_line] == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("coasts of GSHHG: segments of bins join to polygons; only land counts") {
  const Scratch scratch;
  const std::string path = scratch / "binned.nc";
  // Bins of 90 degrees. A square of 20 degrees at 90 E 0 N lies in four of them; an island in one;
  // a lake in another.
  constexpr int bins = 4, rows = 2, unit = 65535;
  struct Segment {
    int bin, level, entry;
    std::vector<std::pair<double, double>> points; ///< degrees from the bin's south-west corner
  };
  const std::vector<Segment> segments{{0, 1, 1, {{90, 10}, {80, 10}, {80, 0}}},
                                      {1, 1, 0, {{10, 0}, {10, 10}, {0, 10}}},
                                      {1, 1, 4, {{40, 40}, {50, 40}, {50, 50}, {40, 50}, {40, 40}}},
                                      {4, 1, 2, {{80, 90}, {80, 80}, {90, 80}}},
                                      {5, 1, 3, {{0, 80}, {10, 80}, {10, 90}}},
                                      {5, 2, 4, {{1, 81}, {2, 81}, {2, 82}, {1, 81}}}};
  std::vector<int> first_segment(8, 0), facts, first_point, polygon, x, y, count(8, 0);
  for (const Segment& segment : segments) {
    const auto bin = static_cast<std::size_t>(segment.bin);
    if (count[bin]++ == 0)
      first_segment[bin] = static_cast<int>(facts.size());
    first_point.push_back(static_cast<int>(x.size()));
    facts.push_back(static_cast<int>(segment.points.size()) << 9 | segment.level << 6 |
                    segment.entry << 3 | segment.entry);
    polygon.push_back(segment.entry < 4 ? 7 : static_cast<int>(facts.size()) + 20);
    for (const auto& [east, north] : segment.points) {
      x.push_back(static_cast<int>(std::lround(east / 90 * unit)));
      y.push_back(static_cast<int>(std::lround(north / 90 * unit)));
    }
  }
  Mpas file;
  const auto add = [&](const std::string& name, const std::vector<int>& values) {
    file.variables[name] = {
        name, {values.size()}, {"of " + name}, true, {values.begin(), values.end()}};
  };
  add("N_bins_in_360_longitude_range", {bins});
  add("N_bins_in_180_degree_latitude_range", {rows});
  add("Id_of_first_segment_in_a_bin", first_segment);
  add("N_segments_in_a_bin", count);
  add("Embedded_npts_levels_exit_entry_for_a_segment", facts);
  add("Id_of_first_point_in_a_segment", first_point);
  add("Id_of_GSHHS_ID", polygon);
  add("Relative_longitude_from_SW_corner_of_bin", x);
  add("Relative_latitude_from_SW_corner_of_bin", y);
  file.create(path, NC_DOUBLE, [](int) {});
  const Coast coast = read_coast(path);
  CHECK(coast.rings.size() == 2);
  const double degree = std::numbers::pi / 180;
  CHECK(coast.area == doctest::Approx(20 * degree * 2 * std::sin(10 * degree) +
                                      10 * degree * (std::sin(50 * degree) - std::sin(40 * degree)))
                          .epsilon(0.02));
  Variable spoilt = Patch(path).get("Id_of_first_point_in_a_segment");
  spoilt.values[2] = 1000;
  Patch(path).put(spoilt);
  CHECK(has(message_of([&] { read_coast(path); }), "GSHHG"));
  Mpas raster;
  raster.variables["z"] = {"z", {1}, {"of z"}, true, {1}};
  raster.create(path, NC_DOUBLE, [](int) {});
  CHECK(has(message_of([&] { read_coast(path); }), "give it as a raster"));
}

TEST_CASE("cells that need an open vertex have one, to the last, but for passages") {
  const Voronoi cells = tessellation_of(fibonacci_sphere(4000));
  std::vector<std::uint8_t> land, flags;
  for (Eigen::Index i = 0; i < cells.cells.cols(); ++i) {
    const auto at = cells.cells.col(i);
    const double ridge = std::sin(9 * at.x()) * std::sin(11 * at.y() + 7 * at.z()) + 0.3 * at.z();
    land.push_back(ridge > 0.12 ? 1 : 0);
    flags.push_back(std::abs(at.z()) > 0.5 ? 1 : 0);
  }
  const auto locked = [&](const Ids& sea, std::int64_t i) {
    const auto around = cells.cells_on_cell[i];
    for (std::size_t k = 0; k < around.size(); ++k)
      if (sea[around[k]] >= 0 && sea[around[(k + 1) % around.size()]] >= 0)
        return false;
    return true;
  };
  const auto count = [&](const Ids& sea) {
    std::int64_t found = 0;
    for (std::int64_t i = 0; i < sea.size(); ++i)
      found += sea[i] >= 0 && flags[static_cast<std::size_t>(i)] != 0 && locked(sea, i) ? 1 : 0;
    return found;
  };
  SeaOptions options;
  const SeaCells before = sea_cells(cells.cells_on_cell, land, options);
  CHECK(before.report.locked == 0);
  REQUIRE(count(before.mask) > 0);
  options.need_open_vertex = flags;
  const SeaCells after = sea_cells(cells.cells_on_cell, land, options);
  CHECK(count(after.mask) == 0);
  CHECK(after.report.locked >= count(before.mask));
  for (std::int64_t i = 0; i < after.mask.size(); ++i)
    CHECK((after.mask[i] < 0 || neighbours_in(cells, after.mask, i) >= 2));
  Points3 line(3, 2);
  line << 0.6, -0.6, 0, 0, 0.8, 0.8; // over the pole
  options.opened = cells_on_lines(cells, {line});
  const SeaCells open = sea_cells(cells.cells_on_cell, std::vector<std::uint8_t>(4000, 1), options);
  CHECK(open.report.locked == 0);
  options.need_open_vertex.pop_back();
  CHECK(message_of([&] { sea_cells(cells.cells_on_cell, land, options); }) ==
        "need_open_vertex has 3999 flags for 4000 cells; give one for each");
}
