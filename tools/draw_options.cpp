// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_options.h"

#include "draw/history.h"
#include "draw/scale.h"
#include "help/help.h"
#include "options/choice.h"
#include "options/coastlines_option.h"
#include "options/numbers.h"
#include "options/region_option.h"
#include "options/sphere_radius_option.h"
#include "options/units_option.h"
#include "run/operator_measures.h"
#include "text/text.h"
#include "view_option.h"

#include <CLI/App.hpp>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace calotte::tools {

namespace {

constexpr std::string_view field_prefix = "field:", error_prefix = "error:";

bool is_error(std::string_view text) {
  return text.starts_with(error_prefix) &&
         std::any_of(operator_names.begin(), operator_names.end(), [&](const OperatorName& name) {
           return text.substr(error_prefix.size()) == name.word;
         });
}

/// --colour: a word, field:NAME or error:OPERATOR.
void add_colour(CLI::App& command, DrawArguments& arguments) {
  static const std::map<std::string, Colouring> words = {
      {"spacing", Colouring::spacing}, {"angle", Colouring::angle},
      {"valence", Colouring::valence}, {"degree", Colouring::valence},
      {"area", Colouring::area},       {"quality", Colouring::quality},
      {"density", Colouring::density}, {"region", Colouring::region},
      {"none", Colouring::none}};
  const auto check = [](const std::string& text) -> std::string {
    const bool field = text.starts_with(field_prefix) && text != field_prefix;
    if (field || is_error(text) || words.contains(text))
      return "";
    if (text.starts_with(error_prefix))
      return message("\"{}\" is not error: with one of divergence, gradient, laplacian, curl, "
                     "tangential, kinetic_energy",
                     text);
    return message(
        "\"{}\" is not one of spacing, angle, valence (or degree), area, quality, density, "
        "region, field:NAME, error:OPERATOR, none",
        text);
  };
  DrawOptions& options = arguments.options;
  const auto choose = [&options, &error_of = arguments.error_of](const std::string& text) {
    const auto word = words.find(text);
    options.colouring = word == words.end() ? Colouring::field : word->second;
    options.field_name = text.starts_with(field_prefix) ? text.substr(field_prefix.size()) : "";
    error_of = text.starts_with(error_prefix) ? text.substr(error_prefix.size()) : "";
  };
  arguments.colour =
      command
          .add_option_function<std::string>(
              "--colour,--color", choose,
              "Quantity that determines the colour: spacing, angle, valence (or degree), area, "
              "quality, density, region, none, field:NAME or error:OPERATOR. spacing is the mean "
              "distance to the "
              "neighbours, angle the smallest angle, valence the number of neighbours; quality of "
              "a cell is its shortest side over the longest, of a triangle 1 if equilateral; "
              "density is that of --density; region shows the region, relaxation and specified "
              "zone of "
              "a limited-area grid (bdyMaskCell), and is the default for its cells; field:NAME is "
              "a "
              "variable of a NetCDF mesh with one number for each cell; error:OPERATOR is the "
              "error of divergence, gradient, laplacian, curl, tangential or kinetic_energy, as "
              "calotte info --operators measures them")
          ->check(check)
          ->type_name("WORD")
          ->default_str("spacing");
}

/// --zoom: auto, whole or a number.
void add_zoom(CLI::App& command, std::optional<double>& zoom) {
  const auto choose = [&zoom](const std::string& word) {
    const auto number = numbers_of<1>(word == "whole" ? "1" : word);
    if (word == "auto") {
      zoom.reset();
    } else if (number && (*number)[0] >= 1 && (*number)[0] <= most_zoom) {
      zoom = (*number)[0];
    } else {
      refuse(
          message("--zoom {} is no enlargement; give auto, whole or a number from 1 to {}, as in "
                  "--zoom 5",
                  word, most_zoom));
    }
  };
  command
      .add_option_function<std::string>(
          "--zoom", choose,
          "Enlargement of the map: auto, whole or a number from 1 to 2000. auto: an open mesh that "
          "covers a small part of the map fills the picture; whole, or 1: the whole map")
      ->type_name("WORD")
      ->default_str("auto");
}

/// --range: two numbers.
void add_range(CLI::App& command, std::optional<ColourRange>& range) {
  const auto set = [&range](const std::string& text) {
    const auto ends = numbers_of<2>(text);
    require(
        ends && (*ends)[0] < (*ends)[1],
        "--range {} is no range of a colour bar; give its lower and its upper end, as in --range "
        "30,120",
        text);
    range = {(*ends)[0], (*ends)[1]};
  };
  command
      .add_option_function<std::string>(
          "--range", set,
          "Ends of the colour bar, in the unit that it has, so that pictures can be compared. "
          "Values beyond an end have its colour. Default: the range of the values, without a few "
          "outliers")
      ->type_name("LOW,HIGH");
}

void add_look(CLI::App& command, DrawArguments& arguments) {
  const OptionGroup group(command, "Map");
  Look& look = arguments.options.look;
  add_choice<Projection>(command, "--projection", look.projection,
                         {{"globe", Projection::globe}, {"plate-carree", Projection::plate_carree}},
                         "Map projection: globe (the visible hemisphere) or plate-carree (the "
                         "whole sphere, longitude and latitude as x and y)");
  add_view(command, look.view,
           "Centre of the map in degrees; latitude from -90 to 90. Default of globe: 15,25, or the "
           "centre of an open mesh. plate-carree uses the latitude only where enlarged; default: "
           "0,0");
  add_zoom(command, look.zoom);
  command.add_flag(
      "--graticule", look.graticule,
      "Draw meridians and parallels: every 30 degrees, or closer on an enlarged map. An "
      "enlarged globe has them also without this option where they are bent");
  command
      .add_option("--region", arguments.region,
                  "Draw the boundary of a region: a shape such as circle=-105,40,1000km or "
                  "box=-20,30,40,60, or "
                  "a file; see calotte help region")
      ->type_name("SHAPE|FILE");
  add_inside(command, arguments.inside);
  add_coastlines(command, arguments.coastlines);
  command.add_option("--size", look.size, "Width in pixels (points in SVG and PDF), 64 to 16384")
      ->check(CLI::Range(64, 16384))
      ->capture_default_str();
  DrawOptions& options = arguments.options;
  add_choice<Shapes>(
      command, "--what", options.shapes,
      {{"triangles", Shapes::triangles},
       {"cells", Shapes::cells},
       {"both", Shapes::both},
       {"points", Shapes::points}},
      "Shapes: triangles (Delaunay), cells (Voronoi), both (edges of the triangles on the cells), "
      "or points (a dot for each site, black without --colour)");
  arguments.what = command.get_option("--what");
  add_colour(command, arguments);
  add_sphere_radius(command, arguments.sphere_radius,
                    "Radius of the sphere, for distances in km: metres, > 0, or earth (6371229 m); "
                    "default: the planet's that the file names, or --earth-radius with "
                    "--cell-width");
  add_units(command, arguments.units);
  add_range(command, look.range);
  add_choice<ScaleKind>(command, "--scale", look.scale,
                        {{"auto", ScaleKind::automatic},
                         {"linear", ScaleKind::linear},
                         {"log", ScaleKind::logarithmic}},
                        "Steps of the colour bar: linear, log or auto. auto: log for values above "
                        "0 of a wide range, which is a factor above 4 of spacing, area and "
                        "density, and of a field one above 1000 between its quantiles of 1% and "
                        "99%; else linear");
  add_choice<Palette>(
      command, "--palette", look.palette, palette_names(),
      "Colours of the colour bar: viridis, cividis, magma, or diverging (blue, grey, red)");
  command
      .add_option("--title", look.title,
                  "Title of the picture. Default: the name of the file, its cells and their "
                  "spacing")
      ->type_name("TEXT");
}

void add_density_options(CLI::App& command, DrawArguments& arguments) {
  const std::vector<const CLI::Option*> others = std::as_const(command).get_options();
  arguments.density = add_density(command);
  for (const CLI::Option* option : std::as_const(command).get_options()) {
    if (std::find(others.begin(), others.end(), option) == others.end()) {
      arguments.density_options.push_back(option);
    }
  }
}

/// The pictures that are no map, and the options that they do not support.
void add_plots(CLI::App& command, DrawArguments& arguments) {
  const OptionGroup group(command, "Plots");
  CLI::Option* history = command
                             .add_option("--history", arguments.reports,
                                         "Draw the convergence of runs against evaluations and "
                                         "seconds, from reports of calotte cvt --report; no MESH")
                             ->type_name("REPORT ...")
                             ->expected(1, static_cast<int>(most_histories));
  CLI::Option* law = command.add_flag(
      "--spacing-law", arguments.spacing_law,
      "Draw the spacings of the cells against those that --density prescribes, instead of a map");
  for (const char* name : {"--projection", "--view", "--zoom", "--graticule", "--region",
                           "--coastlines", "--what", "--colour", "--sphere-radius", "--units"}) {
    law->excludes(command.get_option(name));
    history->excludes(command.get_option(name));
  }
  for (const char* name : {"--range", "--scale", "--palette", "--title"}) {
    law->excludes(command.get_option(name));
  }
  for (const char* name : {"MESH", "--mesh", "--at", "--points", "--lonlat", "--spacing-law",
                           "--range", "--scale", "--palette", "--title"}) {
    history->excludes(command.get_option(name));
  }
  for (const CLI::Option* option : arguments.density_options) {
    history->excludes(command.get_option(option->get_name()));
  }
}

/// --plane and the domain.
void add_plane_options(CLI::App& command, DrawArguments& arguments) {
  const OptionGroup group(command, "Plane");
  arguments.domain = add_domain(command);
  add_plane(command, *arguments.source,
            {"--projection", "--view", "--zoom", "--graticule", "--region", "--coastlines",
             "--spacing-law", "--sphere-radius", "--units"},
            domain_names);
  for (const char* name : {"--plane", "--domain", "--rectangle", "--periodic"}) {
    command.get_option("--history")->excludes(command.get_option(name));
  }
}

} // namespace

std::shared_ptr<DrawArguments> add_draw_options(CLI::App& command) {
  auto arguments = std::make_shared<DrawArguments>();
  const OptionGroup group(command, "Files");
  arguments->source = add_mesh_source(command);
  command.get_option("MESH")->required(false); // a density or a report replaces it
  add_fields_of(command, *arguments->source);
  command.add_option("-o,--output", arguments->output, "Output picture: .png, .svg or .pdf")
      ->required()
      ->type_name("FILE");
  add_look(command, *arguments);
  add_density_options(command, *arguments);
  add_plots(command, *arguments);
  add_plane_options(command, *arguments);
  return arguments;
}

} // namespace calotte::tools
