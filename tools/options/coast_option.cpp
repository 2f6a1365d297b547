// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/coast_option.h"

#include "io/command.h"
#include "options/mesh_source.h"
#include "text/text.h"

#include <calotte/boundary.h>
#include <calotte/generators.h>
#include <calotte/read.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  return CLI::detail::lexical_cast(text, value) ? std::optional(value) : std::nullopt;
}

/// The text of the option, or that of the file which it names.
std::string levels_text(const std::string& word) {
  if (word.find(',') != std::string::npos)
    return word;
  return read_file(word);
}

DoubleVector levels_of(const std::string& word) {
  std::string text = levels_text(word);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream in(text);
  std::vector<double> levels;
  for (std::string item; in >> item;) {
    const std::optional<double> level = parse_number(item);
    if (!level)
      refuse(message("--depth-levels {}: \"{}\" is not a number; give metres", word, item));
    levels.push_back(*level);
  }
  return Eigen::Map<const Eigen::VectorXd>(levels.data(), std::ssize(levels));
}

/// The depths of a field of depths, or of heights, of which those of the sea are below 0; 0 on
/// land. No number stays none.
DoubleVector depths_of(const DoubleVector& values) {
  const double sign = values.sum() < 0 ? -1 : 1;
  return (sign * values).unaryExpr([](double depth) { return depth <= 0 ? 0.0 : depth; });
}

/// Depths by a raster of heights, at the sites. \throws Error as set_coast().
DoubleVector depths_of_raster(const std::string& path, const Points3& sites) {
  const DoubleVector heights =
      evaluate(read_raster(path, {.quantity = RasterQuantity::height, .points = sites}), sites);
  for (Eigen::Index i = 0; i < heights.size(); ++i)
    if (std::isnan(heights[i])) {
      const Eigen::Vector2d at = to_lonlat(sites.col(i));
      refuse(
          message("--depth {}: there is no height at {}, {}, the place of site {}; give a raster "
                  "of land and sea",
                  path, at[0], at[1], i),
          i);
    }
  return (-heights).cwiseMax(0.0);
}

/// Whether the format has a depth at each node, and lists of those of the boundary.
bool is_coastal(Format format) {
  return format == Format::schism || format == Format::adcirc || format == Format::sms;
}

bool is_raster(const std::string& word) { return word.ends_with(".nc") || word.ends_with(".grd"); }

DoubleVector bottom_of(const std::string& name, const MeshFile& file) {
  const std::int64_t sites = file.mesh ? file.mesh->points.cols() : 0;
  if (const std::optional<double> flat = parse_number(name))
    return DoubleVector::Constant(sites, *flat);
  if (const MeshField* const field = find_cell_field(file, name, sites))
    return depths_of(field->values);
  if (is_raster(name) && file.sphere())
    return depths_of_raster(name, file.mesh->points);
  refuse(
      message("--depth {}: the input has no field of that name with a number for each cell; give "
              "another, a raster of heights (.nc), or metres for a flat bottom",
              name));
}

/// Whether an outer edge lies between two of the sites.
bool opens_an_edge(const Mesh& mesh, const Ids& sites) {
  const std::set<std::int32_t> open(sites.begin(), sites.end());
  const IdLists loops = boundary_loops(mesh);
  for (std::int64_t k = 0; k < loops.size(); ++k) {
    std::int32_t before = loops[k].back();
    for (const std::int32_t site : loops[k])
      if (open.contains(std::exchange(before, site)) && open.contains(site))
        return true;
  }
  return false;
}

Ids open_sites_of(const std::string& word, const Mesh& mesh) {
  const std::string path = region_file(word);
  const std::vector<Points3> lines =
      path.empty() ? std::vector<Points3>{} : lines_in(path, mesh.surface);
  const Ids sites =
      lines.empty() ? boundary_sites(mesh, read_region(word)) : boundary_sites(mesh, lines);
  if (!opens_an_edge(mesh, sites))
    refuse(message("--open {}: no edge of the boundary lies {}; {}", word,
                   lines.empty() ? "in it" : "along the lines, within half its length",
                   lines.empty() ? "give a larger region" : "draw the lines along the boundary"));
  return sites;
}

} // namespace

void add_coast(CLI::App& command, CoastWords& words) {
  CLI::Option* const levels =
      command
          .add_option("--depth-levels", words.levels,
                      "Bounds of the layers for FESOM's aux3d.out, metres, 0 first: numbers such "
                      "as 0,10,30,100, at least 3, or a file of them. Default: none, no aux3d.out")
          ->type_name("LEVELS");
  CLI::Option* const bottom =
      command
          .add_option("--depth", words.bottom,
                      "Depth of the bottom at the sites, for SCHISM, ADCIRC, SMS, and with "
                      "--depth-levels for FESOM: a field with a number for each cell, a raster of "
                      "heights (.nc), or metres for a flat bottom. A field whose sum is below 0 is "
                      "of heights, others are of depths; land has the depth 0")
          ->type_name("NAME|FILE|METRES");
  levels->needs(bottom);
  command
      .add_option("--least-depth", words.least,
                  "Least depth of the bottom at the sites, metres: what is shallower becomes as "
                  "deep, also on land")
      ->check(CLI::Range(0.0, 12000.0))
      ->capture_default_str()
      ->needs(bottom);
  command
      .add_option("--open", words.open,
                  "The open boundary, for SCHISM, ADCIRC, SMS and Gmsh: a region such as "
                  "box=-20,30,40,60 or a file of one, in which both ends of an edge lie, or lines "
                  "(.geojson of LineString) within half an edge of both. Default: that of the "
                  "input; all others are coasts")
      ->type_name("SHAPE|FILE");
}

std::vector<std::string> files_of(const CoastWords& words) {
  std::vector<std::string> files;
  if (words.bottom && is_raster(*words.bottom))
    files.push_back(*words.bottom);
  if (!words.open.empty())
    files.push_back(region_file(words.open));
  return files;
}

void require_coast(const CoastWords& words, const std::string& output, Format format) {
  const bool fesom = format == Format::fesom, coastal = is_coastal(format);
  if (words.levels && !fesom)
    refuse_path(output, "--depth-levels applies to FESOM's nod2d.out; leave it out");
  if (fesom && words.bottom && !words.levels)
    refuse_path(output, "FESOM's depths need layers; give --depth-levels, too");
  if (words.bottom && !fesom && !coastal)
    refuse_path(output, "--depth applies to SCHISM (.gr3), ADCIRC (.14), SMS (.2dm) and FESOM "
                        "(nod2d.out); leave it out");
  if (!words.open.empty() && !coastal && format != Format::gmsh)
    refuse_path(output, "--open applies to SCHISM (.gr3), ADCIRC (.14), SMS (.2dm) and Gmsh "
                        "(--format gmsh); leave it out");
}

void set_coast(const CoastWords& words, const MeshFile& file, WriteOptions& options) {
  if (words.levels)
    options.depth_levels = levels_of(*words.levels);
  if (words.bottom)
    options.site_depth = bottom_of(*words.bottom, file).unaryExpr([&](double depth) {
      return depth < words.least ? words.least : depth; // no number stays none
    });
  if (!words.open.empty() && file.mesh)
    options.open_sites = open_sites_of(words.open, *file.mesh);
}

std::string missing_depths(const std::string& output, const WriteOptions& options,
                           const MeshFile& file) {
  const bool known =
      options.site_depth.size() > 0 ||
      std::ranges::find(file.fields, depth_field, &MeshField::name) != file.fields.end();
  return is_coastal(options.format) && !known
             ? output + ": no depths are given, so that each is 0; give --depth\n"
             : "";
}

std::string remove_ears(const std::string& output, Format format, MeshFile& file) {
  if (!file.sphere() || file.mesh->closed() || format != Format::fesom)
    return "";
  WithoutEars rest = without_ears(std::move(file));
  file = std::move(rest.file);
  const EarReport& ears = rest.removed;
  if (ears.triangles == 0 && ears.sites == 0)
    return "";
  return message("{}: without {} triangles of fewer than two neighbours, and without the {} nodes "
                 "that no triangle has then: FESOM refuses them\n",
                 output, ears.triangles, ears.sites);
}

} // namespace calotte::tools
