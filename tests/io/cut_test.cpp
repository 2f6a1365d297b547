// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/cut_laws.h"
#include "support/files.h"
#include "support/global_file.h"
#include "support/text.h"

#include <calotte/cut.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/mesh_file.h>
#include <calotte/write.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <string>

// Limited-area files, by the rules that models set for them.

using namespace calotte;
using namespace calotte::test;
using namespace calotte::test::cut_laws;

namespace {

const Eigen::Vector3d centre_of_cut = Eigen::Vector3d(0.3, -0.5, 0.6).normalized();

/// Points within an angle of the centre.
std::function<bool(const Eigen::Vector3d&)> within_angle(double angle) {
  return [angle](const Eigen::Vector3d& p) {
    return p.normalized().dot(centre_of_cut) > std::cos(angle);
  };
}

std::vector<bool> flags_of(const Contents& file,
                           const std::function<bool(const Eigen::Vector3d&)>& inside) {
  std::vector<bool> flags;
  for (std::size_t i = 0; i < file.dimensions.at("nCells"); ++i)
    flags.push_back(inside({file.at("xCell", i), file.at("yCell", i), file.at("zCell", i)}));
  return flags;
}

const std::set<std::string> length_variables{"xCell",   "yCell",  "zCell",   "xEdge",
                                             "yEdge",   "zEdge",  "xVertex", "yVertex",
                                             "zVertex", "dcEdge", "dvEdge",  "gridSpacing"};
const std::set<std::string> area_variables{"areaCell", "areaTriangle", "kiteAreasOnVertex"};

/// Values are those of the source over a power of the ratio of the radii.
void check_scaled(const Pair& pair, const std::set<std::string>& names, double divisor) {
  for (const std::string& name : names) {
    const Content& content = pair.before.variables.at(name);
    const std::size_t width = content.width();
    double worst = 0;
    for (std::size_t i = 0; i < pair.after.dimensions.at(content.dimensions[0]); ++i)
      for (std::size_t k = 0; k < width; ++k) {
        const double expected =
            pair.before.at(name, static_cast<std::size_t>(pair.old.at(content.dimensions[0])[i]),
                           k) /
            divisor;
        worst = std::max(worst, std::abs(pair.after.at(name, i, k) - expected) /
                                    std::max(std::abs(expected), 1e-300));
      }
    CAPTURE(name);
    CHECK(worst <= 4e-16);
  }
}

/// The maximum of the density is 1; the spacing there is the nominal one.
void check_density(const Pair& pair, double ratio) {
  const std::vector<double>& now = pair.after.numbers.at("meshDensity");
  CHECK(*std::max_element(now.begin(), now.end()) == 1);
  double greatest = 0;
  for (const int old : pair.old.at("nCells"))
    greatest = std::max(greatest, pair.before.at("meshDensity", static_cast<std::size_t>(old)));
  for (std::size_t i = 0; i < now.size(); ++i)
    CHECK(now[i] == doctest::Approx(pair.before.at("meshDensity", static_cast<std::size_t>(
                                                                      pair.old.at("nCells")[i])) /
                                    greatest)
                        .epsilon(1e-15));
  CHECK(pair.after.at("nominalMinDc", 0) ==
        doctest::Approx(pair.before.at("nominalMinDc", 0) * std::pow(greatest, -0.25) / ratio)
            .epsilon(1e-14));
}

std::string text(const std::string& value) { return std::to_string(NC_CHAR) + ":" + value; }

double number_in(const std::string& attribute) {
  double value = 0;
  std::memcpy(&value, attribute.data() + attribute.find(':') + 1, sizeof value);
  return value;
}

void check_attributes(const Pair& pair, double radius) {
  const auto& now = pair.after.attributes;
  CHECK(now.at("on_a_sphere") == text("YES"));
  CHECK(now.at("is_periodic") == text("NO"));
  CHECK(now.at("mesh_spec") == text("1.1"));
  CHECK(number_in(now.at("sphere_radius")) == radius);
  CHECK(now.at("history") == text("cut by a test\nmade by a test"));
  CHECK(now.at("parent_id") == pair.before.attributes.at("file_id"));
  CHECK(now.at("file_id") != pair.before.attributes.at("file_id"));
  for (const auto& [name, value] : pair.before.attributes)
    if (name != "history" && name != "sphere_radius" && name != "mesh_spec" && name != "file_id" &&
        name != "parent_id")
      CHECK(now.at(name) == value);
  CHECK(pair.after.unlimited == std::vector<std::string>{"Time"});
}

/// All rules.
void check_cut(const std::string& source, const std::string& target, double angle, int rings,
               double radius) {
  const Pair pair(source, target);
  const double ratio = number_in(pair.before.attributes.at("sphere_radius")) / radius;
  check_masks(pair, flags_of(pair.before, within_angle(angle)), rings);
  for (const Kind& kind : kinds) {
    const std::vector<int>& old = pair.old.at(kind.dimension);
    CHECK(std::is_sorted(old.begin(), old.end()));
  }
  check_ids(pair);
  std::set<std::string> scaled{"meshDensity", "nominalMinDc"};
  if (ratio != 1) {
    scaled.insert(length_variables.begin(), length_variables.end());
    scaled.insert(area_variables.begin(), area_variables.end());
  }
  check_fields(pair, scaled);
  check_scaled(pair, length_variables, ratio);
  check_scaled(pair, area_variables, ratio * ratio);
  check_weights(pair);
  check_boundary(pair.after);
  check_density(pair, ratio);
  check_attributes(pair, radius);
  check_graph(pair.after, std::filesystem::path(target).replace_extension(".graph.info"));
  check_none(target);
}

using Position = std::pair<double, double>;

/// The neighbours of each cell, all by longitude and latitude.
std::map<Position, std::set<Position>> neighbours_of(const Contents& file) {
  const auto position = [&](int i) {
    return Position{file.at("lonCell", static_cast<std::size_t>(i)),
                    file.at("latCell", static_cast<std::size_t>(i))};
  };
  std::map<Position, std::set<Position>> neighbours;
  for (std::size_t i = 0; i < file.dimensions.at("nCells"); ++i)
    for (std::size_t k = 0; k < static_cast<std::size_t>(file.at("nEdgesOnCell", i)); ++k)
      if (const int other = file.id("cellsOnCell", i, k); other >= 0)
        neighbours[position(static_cast<int>(i))].insert(position(other));
  return neighbours;
}

/// The least mask of the cells at each edge or vertex is its own.
void check_least_masks(const Contents& file, const Kind& kind, const std::string& cells_on) {
  int wrong = 0;
  for (std::size_t i = 0; i < file.dimensions.at(kind.dimension); ++i) {
    double least = 100;
    for (std::size_t k = 0; k < file.variables.at(cells_on).width(); ++k)
      if (const int cell = file.id(cells_on, i, k); cell >= 0)
        least = std::min(least, file.at("bdyMaskCell", static_cast<std::size_t>(cell)));
    wrong += file.at("bdyMask" + kind.name, i) != least;
  }
  CHECK(wrong == 0);
}

CutOptions history() {
  CutOptions options;
  options.vertex_order.reset(); // atmosphere_test has both orders
  options.history = "cut by a test";
  return options;
}

} // namespace

TEST_CASE("a cut file keeps all rules, whatever the source's radius, format and order") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "region.nc";
  for (const double radius : {1.0, 6371229.0})
    for (const int format : {NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
      CAPTURE(radius);
      CAPTURE(format);
      write_global(scratch, source, {.cells = 1500, .radius = radius, .format = format});
      const CutReport report = cut(source, target, within_angle(0.3), history());
      check_cut(source, target, 0.3, 7, 1);
      CHECK(report.left_out.empty());
      CHECK(std::ssize(report.cells_by_mask) == 8);
      std::int64_t sum = 0;
      for (const std::int64_t cells : report.cells_by_mask)
        sum += cells;
      CHECK(sum == report.cells);
    }
}

TEST_CASE("fewer rings, the source's radius, and a region in two parts") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "region.nc";
  write_global(scratch, source, {.cells = 800, .radius = 6371229});
  CutOptions options = history();
  options.sphere_radius.reset();
  for (const int rings : {1, 3}) {
    options.rings = rings;
    cut(source, target, within_angle(0.5), options);
    check_cut(source, target, 0.5, rings, 6371229);
  }
  options.rings = 2;
  const auto two = [](const Eigen::Vector3d& p) {
    return std::abs(p.normalized().dot(centre_of_cut)) > 0.9;
  };
  cut(source, target, two, options);
  const Pair pair(source, target);
  check_masks(pair, flags_of(pair.before, two), 2);
  check_ids(pair);
  check_none(target);
}

TEST_CASE("without rings, cells with a single neighbour are left out") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "region.nc";
  write_global(scratch, source, {.cells = 800});
  CutOptions options;
  options.rings = 0;
  const auto ragged = [](const Eigen::Vector3d& p) {
    return p.dot(centre_of_cut) > 0.7 &&
           (std::abs(p.z() - centre_of_cut.z()) < 0.3 || std::abs(p.x()) < 0.02);
  };
  cut(source, target, ragged, options);
  const Pair pair(source, target);
  check_boundary(pair.after);
  const std::vector<bool> inside = flags_of(pair.before, ragged);
  for (const int old : pair.old.at("nCells"))
    CHECK(inside[static_cast<std::size_t>(old)]);
  CHECK(std::count(inside.begin(), inside.end(), true) > std::ssize(pair.old.at("nCells")));
}

TEST_CASE("a file that was cut can be cut again") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", middle = scratch / "middle.nc",
                    direct = scratch / "direct.nc", target = scratch / "region.nc";
  write_global(scratch, source, {.cells = 3000});
  CutOptions options;
  options.rings = 3;
  cut(source, middle, within_angle(1.0), options);
  cut(middle, target, within_angle(0.3), options);
  cut(source, direct, within_angle(0.3), options);
  const Contents a = contents_of(target), b = contents_of(direct);
  for (const auto& [name, content] : b.variables) {
    CAPTURE(name);
    if (name != "meshDensity" && name != "nominalMinDc")
      CHECK((a.variables.at(name).bytes == content.bytes));
  }
}

TEST_CASE("all cells of an open file may be kept: it has its boundary") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", middle = scratch / "middle.nc",
                    target = scratch / "region.nc";
  write_global(scratch, source, {.cells = 3000});
  CutOptions options;
  options.rings = 2;
  const CutReport part = cut(source, middle, within_angle(0.4), options);
  const CutReport all = cut(middle, target, within_angle(1.0), options);
  CHECK(all.cells == part.cells);
  CHECK(all.cells_by_mask == std::vector<std::int64_t>{part.cells, 0, 0});
}

TEST_CASE("the bits do not depend on the number of threads") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc";
  write_global(scratch, source, {.cells = 3000, .radius = 6371229});
  std::string first;
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { cut(source, scratch / "region.nc", within_angle(0.5), {}); });
    const std::string bytes = test::read_file(scratch / "region.nc");
    CHECK((first.empty() || first == bytes));
    first = bytes;
  }
}

TEST_CASE("regions that leave no grid are refused, and no file is left") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "region.nc";
  write_global(scratch, source, {.cells = 400});
  const std::ptrdiff_t files = scratch.files();
  const auto refusal = [&](double angle, const CutOptions& options) {
    const std::string text = refusal_of([&] { cut(source, target, within_angle(angle), options); });
    CHECK(scratch.files() == files);
    return text;
  };
  CHECK(refusal(1e-6, {}) == "none of the 400 cells has its generator in the region; give a larger "
                             "region or a finer mesh");
  CHECK(refusal(4, {}) == "the region and its 7 rings hold all 400 cells, so that there is no "
                          "boundary; give a smaller region, fewer rings or a finer mesh");
  CHECK(refusal(2.5, {}).starts_with("the region and its 7 rings hold all 400 cells"));
  CutOptions options;
  options.rings = 8;
  CHECK(refusal(0.5, options) == "the number of rings is 8; give one from 0 to 7");
  options.rings = 0;
  CHECK(refusal(0.1, options) == "no cell of the region has two neighbours in it; give a larger "
                                 "region or a finer mesh");
  options.sphere_radius = -1;
  CHECK(refusal(0.5, options) ==
        "the radius of the sphere is not positive and finite; give another");
}

TEST_CASE("sources without a mesh of the sphere with connectivity are refused") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "region.nc";
  CutOptions options;
  options.rings = 1;
  const auto refusal = [&] {
    const std::ptrdiff_t files = scratch.files();
    const Error error = error_of([&] { cut(source, target, within_angle(0.5), options); });
    CHECK(scratch.files() == files);
    return std::string(error.what());
  };
  CHECK(refusal().starts_with("cannot read " + source));
  const Mesh mesh = delaunay(fibonacci_sphere(100));
  write(source, mesh, {.format = Format::mpas_minimal});
  CHECK(refusal() == source + " holds no nEdgesOnCell; complete it with calotte convert IN OUT.nc");
  write(source, mesh, {.format = Format::ugrid});
  CHECK(refusal() == source + " holds no MPAS mesh; convert it with calotte convert");
  write(source, hexagonal_box(10, 12, 0.1), {.format = Format::mpas});
  CHECK(refusal() == source + " holds a mesh of the plane, not of the sphere; give another");
  write(source, mesh, {.format = Format::mpas});
  Patch(source).attribute("", "sphere_radius", 2);
  CHECK(has(refusal(), "sphere_radius is 2"));
  Patch(source).attribute("", "sphere_radius", 1);
  Variable ids = Patch(source).get("edgesOnCell");
  std::fill(ids.values.begin(), ids.values.end(), 1000.0);
  Patch(source).put(ids);
  CHECK(has(refusal(), "edgesOnCell has the id 1000 at cell "));
}

TEST_CASE("a cancelled run leaves no file") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "region.nc";
  write_global(scratch, source, {.cells = 800});
  const std::ptrdiff_t files = scratch.files();
  CutOptions options;
  options.progress = [](const Progress& progress) {
    return progress.fraction > 0.3 ? ProgressReply::cancel : ProgressReply::proceed;
  };
  options.rings = 3;
  const Error error = error_of([&] { cut(source, target, within_angle(0.5), options); });
  CHECK(error.code() == ErrorCode::cancelled);
  CHECK(scratch.files() == files);
}

TEST_CASE("a grid made in a region keeps all rules, and is that cut from a global mesh") {
  const Scratch scratch;
  const Surface region = circle(centre_of_cut, 0.14), meshed = widened(region, 11 * 0.012);
  const Mesh mesh = make_grid({.surface = meshed,
                               .start = {.points = random_points(1900, meshed)},
                               .stop = {.max_iterations = 60}})
                        .mesh;
  const Points3& generators = mesh.points;
  const std::string made = scratch / "made.nc", global = scratch / "global.nc",
                    cut_out = scratch / "cut.nc";
  write_limited_area(made, mesh, region);
  const Contents file = contents_of(made);
  const std::vector<int> distance =
      distances(file, flags_of(file, [&](const auto& x) { return region.contains(x); }));
  for (std::size_t i = 0; i < distance.size(); ++i)
    REQUIRE(file.at("bdyMaskCell", i) == distance[i]);
  CHECK(*std::max_element(distance.begin(), distance.end()) == 7);
  check_least_masks(file, kinds[1], "cellsOnEdge");
  check_least_masks(file, kinds[2], "cellsOnVertex");
  check_boundary(file);
  check_graph(file, scratch / "made.graph.info");
  check_none(made);
  for (std::size_t e = 0; e < file.dimensions.at("nEdges"); ++e)
    CHECK(file.at("dvEdge", e) < 0.02); // whole cells, none that reaches beyond the meshed region
  Points3 all(3, generators.cols() + 300);
  all.leftCols(generators.cols()) = generators;
  const Surface far = widened(meshed, 0.1);
  Eigen::Index next = generators.cols();
  const Points3 others = random_sphere(400, 7);
  for (const auto& x : others.colwise())
    if (next < all.cols() && !far.contains(x))
      all.col(next++) = x;
  write(global, delaunay(Points3(all.leftCols(next))));
  cut(global, cut_out, region);
  CHECK((neighbours_of(file) == neighbours_of(contents_of(cut_out))));
}
