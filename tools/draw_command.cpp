// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "draw/draw.h"
#include "draw/history.h"
#include "draw/picture.h"
#include "draw/plane.h"
#include "draw/spacing_law.h"
#include "draw/title.h"
#include "draw_options.h"
#include "help/help.h"
#include "options/coastlines_option.h"
#include "options/files.h"
#include "options/region_option.h"
#include "options/sphere_radius_option.h"
#include "options/units_option.h"
#include "run/operator_measures.h"
#include "run/progress.h"
#include "run/spacing_survey.h"
#include "text/text.h"

#include <calotte/field_grid.h>
#include <calotte/quality.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <iostream>

namespace calotte::tools {

namespace {

constexpr const char* limited_area_mask_name = "bdyMaskCell";

// Each function that draws returns the lines to print.

std::string draw_reports(const DrawArguments& arguments, Progress& progress) {
  std::vector<History> histories;
  for (const std::string& report : arguments.reports) {
    require_distinct(arguments.output, report);
    histories.push_back(read_history(report));
  }
  progress.writing(arguments.output);
  draw_history(arguments.output, histories, arguments.options.look.size);
  return message("{}: convergence of {}\n", arguments.output,
                 counted(std::ssize(histories), "run"));
}

/// Throws for options of a field without one.
void require_field(const DrawArguments& arguments) {
  const MeshSource& source = *arguments.source;
  if (arguments.options.colouring != Colouring::field || !arguments.error_of.empty()) {
    require(source.mesh.empty() && source.at.empty(),
            "{} is for a field of MESH; name it, as in --colour field:NAME",
            source.mesh.empty() ? "--at" : "--mesh");
  }
}

/// Throws for a density without an option that uses it, and for a missing density.
void require_density(const DrawArguments& arguments) {
  const bool wanted = arguments.spacing_law || arguments.options.colouring == Colouring::density;
  if (wanted && !arguments.has_density()) {
    refuse(message("{} requires a density; give --density or --cell-width",
                   arguments.spacing_law ? "--spacing-law" : "--colour density"));
  }
  if (!wanted && arguments.has_density()) {
    refuse("a mesh with a density requires --colour density or --spacing-law; give one of "
           "these, or leave MESH out to draw the density");
  }
}

/// A field of MESH at the indices of --at; the mask of a limited area is in the mesh's file.
CellField read_chosen_field(const MeshSource& source, const std::string& name, std::int64_t cells) {
  return name == limited_area_mask_name ? read_cell_field(source.mesh_path(), name, cells)
                                        : read_cell_field(source.path, name, cells, source.at);
}

/// The values of the mesh's sites; a cell whose site has duplicates has the value of the first.
CellField read_field(const MeshSource& source, const std::string& name, const Mesh& mesh) {
  const auto cells = mesh.site_of_input.empty()
                         ? static_cast<std::int64_t>(mesh.points.cols())
                         : static_cast<std::int64_t>(mesh.site_of_input.size());
  CellField field = read_chosen_field(source, name, cells);
  if (cells != mesh.points.cols()) {
    const DoubleVector values = field.values;
    field.values.resize(mesh.points.cols());
    for (auto cell = cells; cell-- > 0;) {
      field.values[mesh.site_of_input[static_cast<std::size_t>(cell)]] = values[cell];
    }
  }
  return field;
}

/// Shows the errors of an operator as a field.
void set_errors(const std::string& word, const OperatorErrors& errors, DrawOptions& options) {
  const auto name = std::find_if(operator_names.begin(), operator_names.end(),
                                 [&](const OperatorName& other) { return word == other.word; });
  options.field = {errors.by_cell.*(name->by_cell),
                   "greatest at the cell, over the root mean square of exact values", ""};
  options.field_name = std::string("error of the ") + name->label;
}

/// \throws Error invalid_argument in a plane without an end, whose cells nothing clips, and for a
///         mesh that ends at walls; as operator_errors().
OperatorErrors errors_of(const Mesh& mesh) {
  if (mesh.surface == Surface::plane())
    refuse("the errors of operators depend on the domain, which clips "
           "the cells; give --domain, --rectangle or --periodic");
  if (has_walls(mesh))
    refuse("the mesh ends at walls, where its cells have no errors of "
           "operators; choose another --colour");
  return operator_errors(mesh);
}

/// A field of the file, read with the cells.
CellField field_of(const DrawOptions& options, const MeshSource& source, const MeshFile& file,
                   std::int64_t cells) {
  const std::string& name = options.field_name;
  const MeshField* const field = find_cell_field(file, name, cells);
  if (field != nullptr && source.mesh.empty() && source.at.empty()) {
    return {field->values, field->long_name, field->units};
  }
  return read_chosen_field(source, name, cells);
}

/// Adds the indices of --at to the name of a field.
void name_indices(const MeshSource& source, DrawOptions& options) {
  if (!source.at.empty()) {
    options.field_name += " at " + words_of(source.at);
  }
}

/// Sets the region whose boundary is drawn, if one is given.
void set_region(const DrawArguments& arguments, std::optional<double> radius_km, Look& look) {
  if (!arguments.region.empty()) {
    look.region =
        region_of(arguments.region, arguments.inside, radius_km.value_or(earth_radius_km));
  }
}

bool shows_field(const DrawOptions& options) {
  return options.colouring == Colouring::field || options.colouring == Colouring::region;
}

bool has_cells(Shapes shapes) { return shapes == Shapes::cells || shapes == Shapes::both; }

/// Points are black, and the cells of a limited-area grid show its zones, unless another colouring
/// is given.
void choose_colouring(const DrawArguments& arguments, const MeshFile& file, DrawOptions& options) {
  const auto is_mask = [](const MeshField& field) {
    return field.name == limited_area_mask_name && field.location == FieldLocation::cells &&
           field.values.size() > 0 && field.values.maxCoeff() > 0;
  };
  if (arguments.colour->count() == 0 && options.shapes == Shapes::points) {
    options.colouring = Colouring::none;
  }
  if (arguments.colour->count() == 0 && has_cells(options.shapes) && file.mesh &&
      !file.mesh->closed() && std::any_of(file.fields.begin(), file.fields.end(), is_mask)) {
    options.colouring = Colouring::region;
  }
  if (options.colouring == Colouring::region) {
    options.field_name = limited_area_mask_name;
  }
}

/// The options of a picture of a file's mesh.
DrawOptions options_for(const DrawArguments& arguments, const MeshFile& file) {
  DrawOptions options = arguments.options;
  const std::optional<double> radius =
      radius_km(file, arguments.density->widths, arguments.sphere_radius);
  options.unit = unit_of(arguments.units, radius);
  options.name = file_name(*arguments.source);
  options.look.coastlines = shows_coastlines(arguments.coastlines, radius);
  set_region(arguments, radius, options.look);
  choose_colouring(arguments, file, options);
  return options;
}

/// Cells that are not Voronoi cells have no triangles and no spacing law.
std::string draw_cells(const DrawArguments& arguments, const MeshFile& file, Progress& progress) {
  const Polygons& cells = *file.polygons;
  const std::string not_voronoi = message("{}: the cells are not Voronoi cells ({})",
                                          arguments.source->mesh_path(), file.not_voronoi.text());
  if (arguments.spacing_law ||
      (arguments.what->count() > 0 && arguments.options.shapes != Shapes::cells)) {
    refuse(not_voronoi + "; draw them with --what cells");
  }
  if (!arguments.error_of.empty()) {
    refuse(not_voronoi + ", so that they have no errors of operators; choose another --colour");
  }
  DrawOptions options = options_for(arguments, file);
  if (shows_field(options)) {
    options.field = field_of(options, *arguments.source, file, cells.size());
    name_indices(*arguments.source, options);
  }
  progress.writing(arguments.output);
  draw(arguments.output, cells, options);
  return changes_of(*arguments.source, file) +
         message("{}: picture of {} cells\n", arguments.output, cells.size());
}

std::string draw_mesh(const DrawArguments& arguments, Progress& progress) {
  const WidthWords& widths = arguments.density->widths;
  require_outputs({{"picture", arguments.output}},
                  {arguments.source->path, arguments.source->points, arguments.source->mesh,
                   widths.file, widths.raster, arguments.domain->file.value_or("")});
  require_density(arguments);
  require_field(arguments);
  std::optional<Surface> domain = surface_of(*arguments.domain);
  progress.stage("reading " + arguments.source->mesh_path());
  MeshFile file = read_mesh_alone(*arguments.source, FieldChoice::scalars);
  const bool plane = file.plane() != nullptr;
  if (const MeshSource& source = *arguments.source; !source.mesh.empty())
    require_order(source.path, file, source.mesh);
  DrawOptions options = options_for(arguments, file);
  options.density =
      density_of(*arguments.density, plane ? domain.value_or(Surface::plane()) : Surface());
  if (!plane && file.other_cells()) {
    return draw_cells(arguments, file, progress);
  }
  if (plane && !domain) {
    domain = filled_surface(file);
  }
  if (domain) {
    set_surface(*file.mesh, *domain);
  }
  const Mesh& mesh = *file.mesh;
  if (file.polygons && file.polygons->size() == mesh.points.cols()) {
    options.cells = &*file.polygons;
  }
  progress.stage("measuring " + arguments.source->path);
  if (!arguments.error_of.empty()) {
    set_errors(arguments.error_of, errors_of(mesh), options);
  } else if (shows_field(options)) {
    options.field = read_field(*arguments.source, options.field_name, mesh);
    name_indices(*arguments.source, options);
  }
  progress.writing(arguments.output);
  if (arguments.spacing_law) {
    draw_spacing_law(arguments.output, mesh, options.density, options.look.size);
  } else {
    draw(arguments.output, mesh, options);
  }
  return (plane ? "" : changes_of(*arguments.source, file)) +
         message("{}: {} of {} sites, {} triangles\n", arguments.output,
                 arguments.spacing_law ? "spacing law" : "picture", mesh.points.cols(),
                 mesh.triangles.cols());
}

std::string title_of(const DensityWords& words) {
  const std::vector<std::string> names = density_names(words);
  return names.size() == 1 ? names.front()
                           : message("{} bumps, their {}", names.size(), words.join);
}

std::function<DoubleVector(const Points3&)> spacings_by(const Density& density, double unit) {
  return [density, unit](const Points3& x) { return spacings_of(density, unit, x); };
}

/// The widths of a file, otherwise the density; --colour selects the other.
SphereField field_of(const DrawArguments& arguments) {
  const DensityOfWidths resolution = sampled(*arguments.density);
  const Density& density = resolution.density;
  const std::string title = title_of(*arguments.density);
  const bool asked = arguments.colour->count() > 0;
  const bool density_asked = asked && arguments.options.colouring == Colouring::density;
  if (resolution.widths && !resolution.widths->of_plane() && !density_asked) {
    const WidthField& widths = *resolution.widths;
    const double radius = arguments.density->widths.radius;
    const Unit unit = unit_of(arguments.units, radius);
    const double scale = unit.of_radian / radius, least = scale * widths.least();
    return {spacings_by(density, least),
            message("{}, {}", title, range_text(least, scale * widths.greatest(), symbol_of(unit))),
            "cell width, " + unit.name};
  }
  if (arguments.units)
    refuse("a density has no unit of lengths; leave --units out, or give widths in km");
  if (asked && !density_asked) {
    return {spacings_by(density, 1), title, "spacing by the density, over that where it is 1"};
  }
  return {[density](const Points3& x) { return evaluate(density, x); }, title, "density"};
}

std::string draw_density(const DrawArguments& arguments, Progress& progress) {
  const Colouring colouring = arguments.options.colouring;
  if (arguments.what->count() > 0) {
    throw CLI::RequiredError("--what: MESH");
  }
  if (arguments.source->plane || arguments.domain->given()) {
    refuse("a picture of a density is one of the sphere; leave --plane and the domain out, or give "
           "a mesh");
  }
  if (colouring != Colouring::density && colouring != Colouring::spacing) {
    refuse(
        "a picture of a density is coloured by density or spacing; give one of these, or a mesh");
  }
  Look look = arguments.options.look;
  const WidthWords& widths = arguments.density->widths;
  if (arguments.sphere_radius)
    refuse("--sphere-radius is that of a mesh; widths in km refer to --earth-radius");
  const std::optional<double> radius = widths.in_km() ? std::optional(widths.radius) : std::nullopt;
  look.coastlines = shows_coastlines(arguments.coastlines, radius);
  set_region(arguments, radius, look);
  progress.stage(widths.in_km() ? "reading the widths" : "reading the density");
  const SphereField field = field_of(arguments);
  progress.writing(arguments.output);
  draw(arguments.output, field, look);
  return message("{}: picture of a density\n", arguments.output);
}

std::string draw_picture(const DrawArguments& arguments) {
  Progress progress;
  if (!arguments.reports.empty()) {
    return draw_reports(arguments, progress);
  }
  if (!arguments.source->path.empty()) {
    return draw_mesh(arguments, progress);
  }
  if (arguments.has_density() && !arguments.spacing_law) {
    return draw_density(arguments, progress);
  }
  throw CLI::RequiredError("MESH");
}

void run(const DrawArguments& arguments) {
  require_sphere_radius(arguments.sphere_radius.value_or(1));
  picture_format(arguments.output); // fails before any input is read
  require_folder(arguments.output);
  std::cout << draw_picture(arguments);
}

} // namespace

void add_draw(CLI::App& app) {
  CLI::App* command = app.add_subcommand("draw", "Draws a mesh or a density on a map, its spacing "
                                                 "law, or the convergence of CVT runs.");
  const std::shared_ptr<DrawArguments> arguments = add_draw_options(*command);
  set_help(*command,
           {.common = {"MESH", "--mesh", "--at", "--output", "--what", "--colour", "--projection",
                       "--view", "--zoom", "--graticule", "--region", "--size", "--density",
                       "--cell-width", "--units", "--history", "--spacing-law", "--domain"},
            .examples = {"calotte draw mesh.nc -o globe.png --what cells --view 285,38",
                         "calotte draw history.nc --mesh mesh.nc --colour field:theta "
                         "--at time=3,lev=0 -o theta.png",
                         "calotte draw --history report.json -o convergence.png"}});
  command->callback([arguments] { run(*arguments); });
}

} // namespace calotte::tools
