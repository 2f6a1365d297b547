// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "draw/draw.h"
#include "draw/history.h"
#include "draw/picture.h"
#include "draw/spacing_law.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/mesh_source.h"

#include <calotte/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <map>
#include <string_view>
#include <utility>

namespace calotte::tools {

namespace {

struct DrawArguments {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<DensityWords> density;
  std::vector<const CLI::Option*> density_options; ///< all options that add_density adds
  const CLI::Option* what = nullptr;
  const CLI::Option* colour = nullptr;
  std::string output;
  DrawOptions options;
  std::vector<std::string> reports; ///< drawn instead of a mesh
  bool spacing_law = false;
  std::shared_ptr<DomainWords> domain; ///< with --plane

  bool has_density() const { return !density->densities.empty() || density->widths.given(); }
};

/// Removes a number and the text after it from the input; false if there is none.
bool take_number(std::string_view& text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc();
}

LonLat parse_view(std::string_view text) {
  LonLat view;
  std::string_view rest = text;
  bool good = take_number(rest, view.longitude) && rest.starts_with(',');
  if (good) {
    rest.remove_prefix(1);
    good = take_number(rest, view.latitude) && rest.empty() && std::abs(view.latitude) <= 90 &&
           std::abs(view.longitude) <= 360;
  }
  if (!good) {
    throw Error(
        ErrorCode::bad_option,
        "--view " + std::string(text) +
            " is not a location; give longitude and latitude in degrees, as in --view 15,-30");
  }
  return view;
}

/// An option whose value is one of several words.
template <class Value>
void add_choice(CLI::App& command, const std::string& names, Value& value,
                const std::vector<std::pair<std::string, Value>>& choices,
                const std::string& help) {
  std::vector<std::string> words;
  words.reserve(choices.size());
  for (const auto& choice : choices) {
    words.push_back(choice.first);
  }
  const auto choose = [&value, choices](const std::string& word) {
    const auto is_it = [&](const auto& choice) { return choice.first == word; };
    value = std::find_if(choices.begin(), choices.end(), is_it)->second;
  };
  command.add_option_function<std::string>(names, choose, help)
      ->check(CLI::IsMember(words))
      ->type_name("WORD")
      ->default_str(words.front());
}

constexpr const char* field_prefix = "field:";

/// --colour: a word, or field:NAME.
void add_colour(CLI::App& command, DrawArguments& arguments) {
  static const std::map<std::string, Colouring> words = {
      {"spacing", Colouring::spacing}, {"angle", Colouring::angle}, {"valence", Colouring::valence},
      {"degree", Colouring::valence},  {"area", Colouring::area},   {"quality", Colouring::quality},
      {"density", Colouring::density}, {"none", Colouring::none}};
  const auto check = [](const std::string& text) -> std::string {
    const bool field = text.starts_with(field_prefix) && text != field_prefix;
    return field || words.contains(text)
               ? ""
               : "\"" + text +
                     "\" is not one of spacing, angle, valence (or degree), "
                     "area, quality, density, field:NAME, none";
  };
  DrawOptions& options = arguments.options;
  const auto choose = [&options](const std::string& text) {
    const auto word = words.find(text);
    options.colouring = word == words.end() ? Colouring::field : word->second;
    options.field_name =
        word == words.end() ? text.substr(std::string_view(field_prefix).size()) : "";
  };
  arguments.colour =
      command
          .add_option_function<std::string>(
              "--colour,--color", choose,
              "Quantity that determines the colour: spacing (mean distance to the neighbours), "
              "angle (smallest angle), valence or degree (number of neighbours), area, quality (of "
              "a cell: shortest side over longest; of a triangle: 1 if equilateral), density (of "
              "--density), none, or field:NAME (a variable of a NetCDF mesh with one number for "
              "each cell)")
          ->check(check)
          ->type_name("WORD")
          ->default_str("spacing");
}

void add_look(CLI::App& command, DrawArguments& arguments) {
  Look& look = arguments.options.look;
  add_choice<Projection>(command, "--projection", look.projection,
                         {{"globe", Projection::globe}, {"plate-carree", Projection::plate_carree}},
                         "Map projection: globe (the visible hemisphere) or plate-carree (the "
                         "whole sphere, longitude and latitude as x and y)");
  const auto look_from = [&look](const std::string& text) { look.view = parse_view(text); };
  command
      .add_option_function<std::string>(
          "--view", look_from,
          "Centre of the map in degrees; latitude from -90 to 90. Default of globe: 15,25, or the "
          "centre of an open mesh. plate-carree uses only the longitude; default: 0")
      ->type_name("LON,LAT");
  command.add_flag("--graticule", look.graticule, "Draw meridians and parallels every 30 degrees");
  command.add_option("--size", look.size, "Width in pixels (points in SVG and PDF)")
      ->check(CLI::Range(64, 16384))
      ->capture_default_str();
  DrawOptions& options = arguments.options;
  add_choice<Shapes>(
      command, "--what", options.shapes,
      {{"triangles", Shapes::triangles}, {"cells", Shapes::cells}, {"both", Shapes::both}},
      "Shapes: triangles (Delaunay), cells (Voronoi), or both (edges of the triangles on the "
      "cells)");
  arguments.what = command.get_option("--what");
  add_colour(command, arguments);
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
  CLI::Option* history = command
                             .add_option("--history", arguments.reports,
                                         "Draw the convergence of runs against evaluations and "
                                         "seconds, from reports of calotte cvt --report; no MESH")
                             ->type_name("REPORT ...")
                             ->expected(1, static_cast<int>(most_histories));
  CLI::Option* law = command.add_flag(
      "--spacing-law", arguments.spacing_law,
      "Draw the spacings of the cells against those that --density prescribes, instead of a map");
  for (const char* name : {"--projection", "--view", "--graticule", "--what", "--colour"}) {
    law->excludes(command.get_option(name));
    history->excludes(command.get_option(name));
  }
  for (const char* name : {"MESH", "--points", "--lonlat", "--spacing-law"}) {
    history->excludes(command.get_option(name));
  }
  for (const CLI::Option* option : arguments.density_options) {
    history->excludes(command.get_option(option->get_name()));
  }
}

/// --plane, the domain, and the options that they exclude.
void add_plane_options(CLI::App& command, DrawArguments& arguments) {
  CLI::Option* plane = add_plane(command, *arguments.source);
  arguments.domain = add_domain(command);
  for (const char* name : {"--domain", "--rectangle", "--periodic"}) {
    command.get_option(name)->needs(plane);
  }
  for (const char* name : {"--projection", "--view", "--graticule", "--spacing-law", "--history"}) {
    plane->excludes(command.get_option(name));
  }
}

void draw_reports(const DrawArguments& arguments) {
  std::vector<History> histories;
  for (const std::string& report : arguments.reports) {
    require_distinct(arguments.output, report);
    histories.push_back(read_history(report));
  }
  draw_history(arguments.output, histories, arguments.options.look.size);
  std::cout << arguments.output << ": convergence of " << histories.size()
            << (histories.size() == 1 ? " run\n" : " runs\n");
}

/// Throws for a density without an option that uses it, and for a missing density.
void require_density(const DrawArguments& arguments) {
  const bool wanted = arguments.spacing_law || arguments.options.colouring == Colouring::density;
  if (wanted && !arguments.has_density()) {
    throw Error(ErrorCode::bad_option,
                std::string(arguments.spacing_law ? "--spacing-law" : "--colour density") +
                    " requires a density; give --density or --cell-width");
  }
  if (!wanted && arguments.has_density()) {
    throw Error(ErrorCode::bad_option,
                "a mesh with a density requires --colour density or --spacing-law; give one of "
                "these, or leave MESH out to draw the density");
  }
}

/// The values of the mesh's sites; a cell whose site has duplicates has the value of the first.
template <class AnyMesh>
CellField read_field(const std::string& path, const std::string& name, const AnyMesh& mesh) {
  const auto cells = mesh.site_of_input.empty()
                         ? static_cast<std::int64_t>(mesh.points.cols())
                         : static_cast<std::int64_t>(mesh.site_of_input.size());
  CellField field = read_cell_field(path, name, cells);
  if (cells != mesh.points.cols()) {
    const Eigen::VectorXd values = field.values;
    field.values.resize(mesh.points.cols());
    for (auto cell = cells; cell-- > 0;) {
      field.values[mesh.site_of_input[static_cast<std::size_t>(cell)]] = values[cell];
    }
  }
  return field;
}

void draw_planar_mesh(const DrawArguments& arguments) {
  const std::optional<PlanarDomain> domain = domain_of(*arguments.domain);
  DrawOptions options = arguments.options;
  options.density = density_of(*arguments.density, true);
  const PlanarMesh mesh = read_planar_mesh(*arguments.source);
  if (options.colouring == Colouring::field) {
    options.field = read_field(arguments.source->path, options.field_name, mesh);
  }
  draw(arguments.output, mesh, domain, options);
  std::cout << arguments.output << ": picture of " << mesh.points.cols() << " sites, "
            << mesh.triangles.cols() << " triangles\n";
}

/// A field of the file, read with the cells.
CellField field_of(const DrawArguments& arguments, const MeshFile& file, std::int64_t cells) {
  const std::string& name = arguments.options.field_name;
  for (const MeshField& field : file.fields) {
    if (field.name == name && field.location == Location::cells && field.values.size() == cells) {
      return {field.values, field.long_name, field.units};
    }
  }
  return read_cell_field(arguments.source->path, name, cells);
}

/// Cells that are not Voronoi cells have no triangles and no spacing law.
void draw_cells(const DrawArguments& arguments, const MeshFile& file) {
  const Polygons& cells = *file.polygons;
  const std::string not_voronoi =
      arguments.source->path + ": the cells are not Voronoi cells (" + file.not_voronoi + ")";
  if (arguments.spacing_law ||
      (arguments.what->count() > 0 && arguments.options.shapes != Shapes::cells)) {
    throw Error(ErrorCode::bad_option, not_voronoi + "; draw them with --what cells");
  }
  DrawOptions options = arguments.options;
  if (options.colouring == Colouring::field) {
    options.field = field_of(arguments, file, cells.size());
  }
  draw(arguments.output, cells, options);
  std::cout << changes_of(*arguments.source, file) << arguments.output << ": picture of "
            << cells.size() << " cells\n";
}

void draw_mesh(const DrawArguments& arguments) {
  require_distinct(arguments.output, arguments.source->path);
  require_distinct(arguments.output, arguments.source->points);
  require_density(arguments);
  if (arguments.source->plane) {
    draw_planar_mesh(arguments);
    return;
  }
  DrawOptions options = arguments.options;
  options.density = density_of(*arguments.density);
  const MeshFile file = read_mesh_file(*arguments.source, FieldChoice::scalars);
  if (file.plane) {
    throw Error(ErrorCode::bad_option,
                arguments.source->path +
                    ": it holds a mesh of the plane; read it as one of the plane");
  }
  if (file.polygons && !(file.mesh && !file.mesh->closed())) {
    draw_cells(arguments, file);
    return;
  }
  const Mesh& mesh = *file.mesh;
  if (options.colouring == Colouring::field) {
    options.field = read_field(arguments.source->path, options.field_name, mesh);
  }
  if (arguments.spacing_law) {
    draw_spacing_law(arguments.output, mesh, options.density, options.look.size);
  } else {
    draw(arguments.output, mesh, options);
  }
  std::cout << changes_of(*arguments.source, file) << arguments.output << ": "
            << (arguments.spacing_law ? "spacing law of " : "picture of ") << mesh.points.cols()
            << " sites, " << mesh.triangles.cols() << " triangles\n";
}

std::string title_of(const DensityWords& words) {
  const std::vector<std::string> names = density_names(words);
  return names.size() == 1 ? names.front()
                           : std::to_string(names.size()) + " bumps, their " + words.join;
}

/// The spacings that a density implies; `unit` is the spacing at density 1.
std::function<Eigen::VectorXd(const Points3&)> spacings_by(const Density& density, double unit) {
  return [density, unit](const Points3& x) -> Eigen::VectorXd {
    return unit * evaluate(density, x).array().max(1e-150).pow(-0.25);
  };
}

/// The widths of a file, otherwise the density; --colour selects the other.
SphereField field_of(const DrawArguments& arguments) {
  const Resolution resolution = resolution_of(*arguments.density);
  const Density& density = resolution.density;
  const std::string title = title_of(*arguments.density);
  const bool asked = arguments.colour->count() > 0;
  const bool density_asked = asked && arguments.options.colouring == Colouring::density;
  if (resolution.widths && !density_asked) {
    const double least = resolution.widths->widths.minCoeff();
    return {spacings_by(density, least), title, "cell width, km"};
  }
  if (asked && !density_asked) {
    return {spacings_by(density, 1), title, "spacing by the density, over that where it is 1"};
  }
  return {[density](const Points3& x) { return evaluate(density, x); }, title, "density"};
}

void draw_density(const DrawArguments& arguments) {
  const Colouring colouring = arguments.options.colouring;
  if (arguments.what->count() > 0) {
    throw CLI::RequiredError("--what: MESH");
  }
  if (colouring != Colouring::density && colouring != Colouring::spacing) {
    throw Error(
        ErrorCode::bad_option,
        "a picture of a density is coloured by density or spacing; give one of these, or a mesh");
  }
  draw(arguments.output, field_of(arguments), arguments.options.look);
  std::cout << arguments.output << ": picture of a density\n";
}

void run(const DrawArguments& arguments) {
  picture_format(arguments.output); // fails before any input is read
  require_folder(arguments.output);
  if (!arguments.reports.empty()) {
    draw_reports(arguments);
  } else if (!arguments.source->path.empty()) {
    draw_mesh(arguments);
  } else if (arguments.has_density() && !arguments.spacing_law) {
    draw_density(arguments);
  } else {
    throw CLI::RequiredError("MESH");
  }
}

} // namespace

void add_draw(CLI::App& app) {
  CLI::App* command = app.add_subcommand("draw", "Draws a mesh or a density on a map, the spacing "
                                                 "law of a mesh, or the convergence of CVT runs.");
  auto arguments = std::make_shared<DrawArguments>();
  arguments->source = add_mesh_source(*command);
  command->get_option("MESH")->required(false); // a density or a report replaces it
  command->add_option("-o,--output", arguments->output, "Output picture: .png, .svg or .pdf")
      ->required()
      ->type_name("FILE");
  add_look(*command, *arguments);
  add_density_options(*command, *arguments);
  add_plots(*command, *arguments);
  add_plane_options(*command, *arguments);
  command->callback([arguments] { run(*arguments); });
}

} // namespace calotte::tools
