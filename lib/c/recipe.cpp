// SPDX-License-Identifier: GPL-3.0-or-later
#include "c/recipe.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::c_detail {
namespace {

int require_integer(std::int64_t value, const std::string& name) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  require(value >= -most && value <= most, "{} is {}; give at most {}", name, value, most);
  return static_cast<int>(value);
}

/// An integer, or none if the library chooses.
std::optional<int> read_choice(std::int64_t value, const std::string& name) {
  return value == CALOTTE_AUTOMATIC ? std::nullopt : std::optional(require_integer(value, name));
}

bool require_flag(std::int64_t value, const std::string& name) {
  require(value == 0 || value == 1, "{} is {}; give 0 or 1", name, value);
  return value == 1;
}

/// The value for a word of the caller.
/// \param usual value without a word.
template <class Value>
Value require_value(const char* word, std::span<const NamedValue<Value>> words, Value usual,
                    const std::string& name) {
  if (word == nullptr)
    return usual;
  const auto found = std::ranges::find(words, std::string_view(word), &NamedValue<Value>::word);
  if (found != words.end())
    return found->value;
  std::vector<std::string_view> all;
  for (const NamedValue<Value>& known : words)
    all.push_back(known.word);
  base_detail::refuse(
      message("the {} is '{}'; give one of {}", name, word, base_detail::listed(all)));
}

Surface::Rings read_rings(const calotte_surface& surface) {
  require(surface.rings >= 0, "the number of rings is negative; give 0 or more");
  require(surface.corners != nullptr && surface.begin != nullptr,
          "the corners of the rings, or where each begins, are a null pointer; give both");
  const int rows = surface.kind == CALOTTE_SPHERE ? 3 : 2;
  Surface::Rings rings;
  for (std::int64_t i = 0; i < surface.rings; ++i) {
    const std::int64_t begin = surface.begin[i], end = surface.begin[i + 1];
    require(begin >= 0 && end >= begin,
            "ring {} begins at corner {} and ends before {}; give ascending numbers from 0 on", i,
            begin, end);
    rings.emplace_back(points_of(surface.corners + begin * rows, end - begin, rows, "the corners"));
  }
  return rings;
}

// ---- Parts of a recipe

Density make_density(calotte_density function, void* data) {
  Density density;
  if (function == nullptr)
    return density;
  density.kind = Density::Kind::callable;
  density.callable = [function, data](const Eigen::Ref<const Points3>& x,
                                      Eigen::Ref<Eigen::VectorXd> rho) {
    if (function(x.data(), x.cols(), rho.data(), data) != 0)
      throw Error(ErrorCode::cancelled, "the density function ended the run");
  };
  return density;
}

/// Points with three rows; z = 0 in a plane.
Points3 spatial_points(const double* values, std::int64_t n, bool sphere, const std::string& name) {
  if (values == nullptr && n == 0)
    return {};
  const int rows = sphere ? 3 : 2;
  const auto given = points_of(values, n, rows, name);
  Points3 points = Points3::Zero(3, n);
  points.topRows(rows) = given;
  return points;
}

/// \pre recipe.surface and recipe.radius_km are set.
void take_resolution(const calotte_recipe& given, Recipe& recipe) {
  const bool raster = given.widths != nullptr || given.widths_nx != 0 || given.widths_ny != 0,
             file = given.widths_file != nullptr;
  require((given.density != nullptr) + raster + file <= 1,
          "the recipe has several of a density, widths and a file of widths; give one of "
          "them");
  if (file)
    recipe.resolution =
        read_widths(given.widths_file, {.radius_km = recipe.radius_km}, recipe.surface);
  if (!raster) {
    if (!file)
      recipe.resolution = make_density(given.density, given.density_data);
    return;
  }
  constexpr std::int64_t most = 1 << 20;
  require(given.widths != nullptr && given.widths_x != nullptr && given.widths_y != nullptr,
          "the widths, or the coordinates of their nodes, are a null pointer; give widths, "
          "widths_x and widths_y");
  require(std::min(given.widths_nx, given.widths_ny) >= 2 &&
              std::max(given.widths_nx, given.widths_ny) <= most,
          "the widths have {} x {} nodes; give 2 to 1048576 in either direction", given.widths_nx,
          given.widths_ny);
  DoubleVector x = Eigen::Map<const DoubleVector>(given.widths_x, given.widths_nx),
               y = Eigen::Map<const DoubleVector>(given.widths_y, given.widths_ny);
  DoubleMatrix widths =
      Eigen::Map<const DoubleMatrix>(given.widths, given.widths_nx, given.widths_ny);
  recipe.resolution =
      Widths({std::move(x), std::move(y), std::move(widths), !recipe.surface.is_sphere()});
}

CvtStart read_start(const calotte_recipe& given, bool sphere) {
  CvtStart start;
  start.kind = require_value(given.start, start_words(), start.kind, "start");
  start.points =
      spatial_points(given.start_points, given.start_count, sphere, "the start's points");
  start.bisections = read_choice(given.bisections, "the number of bisections");
  start.insertion_rounds = read_choice(given.insertion_rounds, "the number of rounds of insertion");
  return start;
}

CvtStop read_stop(const calotte_recipe& given) {
  CvtStop stop;
  stop.norm = require_value(given.norm, norm_words(), stop.norm, "norm");
  if (given.tolerance != CALOTTE_AUTOMATIC)
    stop.tolerance = given.tolerance;
  stop.max_iterations = require_integer(given.max_iterations, "max_iterations");
  stop.iterations = read_choice(given.iterations, "the number of iterations");
  if (given.well_centred != CALOTTE_AUTOMATIC)
    stop.well_centred = require_flag(given.well_centred, "well_centred");
  stop.least_spacing = given.least_spacing;
  stop.most_off_midpoint = given.most_off_midpoint;
  return stop;
}

/// Sets the method, and the treatment of equal points.
void take_method(const calotte_recipe& given, Recipe& recipe) {
  recipe.method = require_value(given.method, method_words(), recipe.method, "method");
  if (require_flag(given.refuse_duplicates, "refuse_duplicates"))
    recipe.duplicates = Duplicates::refuse;
  recipe.merge_within = given.merge_within;
}

// ---- The defaults

calotte_recipe usual_recipe() {
  const Recipe usual;
  calotte_recipe recipe{};
  recipe.size = sizeof recipe;
  recipe.earth_radius_km = usual.radius_km;
  recipe.bisections = recipe.insertion_rounds = recipe.iterations = CALOTTE_AUTOMATIC;
  recipe.tolerance = recipe.well_centred = CALOTTE_AUTOMATIC;
  recipe.max_iterations = usual.stop.max_iterations;
  recipe.least_spacing = usual.stop.least_spacing;
  recipe.most_off_midpoint = usual.stop.most_off_midpoint;
  recipe.seed = static_cast<std::int64_t>(usual.seed);
  recipe.merge_within = usual.merge_within;
  recipe.initialised = 1;
  return recipe;
}

/// The recipe of a caller. Members that its struct lacks have their defaults.
calotte_recipe initialised(const calotte_recipe* pointer) {
  const std::string name = "calotte_recipe";
  const calotte_recipe given = known_part(pointer, name, usual_recipe());
  require(given.initialised == 1, "the size of the recipe is set, but not its defaults; {}",
          initialise(name));
  return given;
}

} // namespace

Eigen::Map<const DoubleMatrix> points_of(const double* values, std::int64_t n, int rows,
                                         const std::string& name) {
  base_detail::require_count(n, 0, "the number of points");
  require(values != nullptr || n == 0, "{} are a null pointer; give an array", name);
  return {values, rows, n};
}

Surface surface_of(const calotte_surface* given) {
  if (given == nullptr)
    return {};
  const calotte_surface surface = known_part(given, "calotte_surface");
  require(surface.kind == CALOTTE_SPHERE || surface.kind == CALOTTE_PLANE,
          "the kind of the surface is {}; give CALOTTE_SPHERE or CALOTTE_PLANE", surface.kind);
  const Eigen::Vector2d period(surface.period[0], surface.period[1]);
  const bool repeats = !period.isZero(0), sphere = surface.kind == CALOTTE_SPHERE;
  require(!sphere || !repeats, "a period is that of a plane; give the kind CALOTTE_PLANE");
  const Surface whole =
      sphere ? Surface::sphere() : (repeats ? Surface::periodic(period) : Surface::plane());
  return surface.rings == 0 ? whole : whole.within(read_rings(surface));
}

Recipe recipe_of(const calotte_recipe* pointer) {
  const calotte_recipe given = initialised(pointer);
  Recipe recipe;
  recipe.cells = given.cells;
  recipe.surface = surface_of(given.surface);
  const bool sphere = recipe.surface.is_sphere();
  recipe.radius_km = given.earth_radius_km;
  take_resolution(given, recipe);
  recipe.limited_area = require_flag(given.limited_area, "limited_area");
  recipe.walls = {require_flag(given.walls_x, "walls_x"), require_flag(given.walls_y, "walls_y")};
  if (require_flag(given.boundary_generators, "boundary_generators"))
    recipe.boundary = Boundary::generators;
  recipe.fixed = spatial_points(given.fixed, given.fixed_count, sphere, "the fixed points");
  recipe.start = read_start(given, sphere);
  recipe.stop = read_stop(given);
  recipe.seed = static_cast<std::uint64_t>(given.seed);
  take_method(given, recipe);
  return recipe;
}

} // namespace calotte::c_detail

void calotte_recipe_init_sized(calotte_recipe* recipe, size_t size) {
  using namespace calotte::c_detail;
  if (recipe == nullptr || size < sizeof recipe->size)
    return;
  std::memset(recipe, 0, size);
  const calotte_recipe usual = usual_recipe();
  std::memcpy(recipe, &usual, std::min(size, sizeof usual));
  recipe->size = size;
}
