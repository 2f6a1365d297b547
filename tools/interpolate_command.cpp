// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "help/nearest_name.h"
#include "options/choice.h"
#include "options/delaunay_options.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/mesh_source.h"
#include "options/warning.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/field_grid.h>
#include <calotte/version.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

/// Whether a source or a target is a text of positions, not a size or a file of cells.
bool is_text(const std::string& word) { return !raster_of(word) && is_positions(word); }

struct InterpolateRequest {
  std::string source, mesh, target, output, weights, apply;
  std::vector<std::string> fields, categories, numbers;
  std::vector<std::string> position; ///< columns of text
  bool plane = false;                ///< whether text is in a plane
  std::vector<FieldIndex> at;        ///< of dimensions of the fields
  Interpolation method = Interpolation::conservative;
  std::string method_word; ///< as given, or the default
  WeightsFormat format = WeightsFormat::esmf;
  double min_cover = 0;
  std::optional<int> threads;

  bool scattered() const { return is_text(source); }
  bool to_positions() const { return is_text(target); }
};

/// Refuses one number where the size of a raster is meant, and doubts columns and rows that are
/// likely exchanged.
void require_size(const std::string& target) {
  const bool number = !target.empty() && target.find_first_not_of("0123456789") == target.npos;
  if (std::error_code error; number && !std::filesystem::exists(target, error))
    refuse(message("{} is no file; the size of a raster is its columns x its rows, such as 720x360",
                   target));
  if (const std::optional<FieldGrid> raster = raster_of(target)) {
    const auto columns = raster->boxes->longitudes.size(), rows = raster->boxes->latitudes.size();
    if (rows > columns)
      warn(message("{} has {} columns and {} rows, whose boxes are {} degrees wide and {} high; "
                   "the columns come first, as in 720x360",
                   target, columns, rows, formatted("%.3g", 360.0 / static_cast<double>(columns)),
                   formatted("%.3g", 180.0 / static_cast<double>(rows))));
  }
}

/// Refuses options of grids where there are positions, and the reverse.
void require_options(const InterpolateRequest& request) {
  const auto refuse_with = [&](bool given, const char* option, bool with, const char* what) {
    if (given && with)
      refuse(message("{} does not apply to {}; leave it out", option, what));
  };
  const bool scattered = request.scattered(), text = scattered || request.to_positions();
  refuse_with(!request.weights.empty(), "--weights", text, "positions, which have no cells");
  refuse_with(!request.apply.empty(), "--apply", text, "positions, which have no cells");
  refuse_with(!request.mesh.empty(), "--mesh", scattered, "a text of values");
  refuse_with(!request.at.empty(), "--at", scattered, "a text of values");
  refuse_with(!request.categories.empty(), "--categories", scattered, "a text of values");
  refuse_with(!request.numbers.empty(), "--numbers", scattered, "a text of values");
  refuse_with(request.min_cover > 0, "--min-cover", text, "positions, which have no cells");
  refuse_with(!request.position.empty(), "--position", !text, "meshes and rasters");
  refuse_with(request.plane, "--plane", !text, "meshes and rasters, which know their surface");
  if (request.method_word == "conservative" && text)
    refuse("positions have no cells to share areas; give linear, nearest or natural as --method");
}

/// Checks all options that can fail, before any input is read.
void require_request(const InterpolateRequest& request) {
  require_size(request.target);
  require_options(request);
  if (request.output.empty() && request.weights.empty())
    refuse("nothing to write; give -o FILE for fields, --weights FILE for weights, or both");
  if (!request.output.empty() && raster_of(request.target) && !request.output.ends_with(".nc"))
    refuse_path(request.output, "a raster is written to NetCDF; give a name that ends in .nc");
  if (!request.output.empty() && request.to_positions())
    require_storable(request.output, FieldGrid{.name = request.target, .positions = Positions()},
                     {});
  else if (!request.output.empty())
    require_field_format(request.output);
  if (!request.weights.empty() && !request.weights.ends_with(".nc"))
    refuse_path(request.weights, "weights are written to NetCDF; give a name that ends in .nc");
  require_outputs({{"fields", request.output}, {"weights", request.weights}},
                  {request.source, request.mesh, request.target, request.apply});
}

FieldGrid raster_or_mesh(const std::string& word, FieldChoice choice,
                         const std::vector<FieldIndex>& at = {}) {
  if (std::optional<FieldGrid> raster = raster_of(word))
    return *std::move(raster);
  return read_field_grid(word, choice, at);
}

FieldGrid source_of(const InterpolateRequest& request) {
  if (request.scattered())
    return read_positions(
        request.source,
        {.plane = request.plane,
         .position = request.position,
         .fields = request.fields.empty() ? std::nullopt : std::optional(request.fields)});
  const FieldChoice choice = request.output.empty() ? FieldChoice::none : FieldChoice::all;
  return request.mesh.empty() ? raster_or_mesh(request.source, choice, request.at)
                              : read_field_grid(request.source, request.mesh, choice, request.at);
}

FieldGrid target_of(const InterpolateRequest& request) {
  if (!request.to_positions())
    return raster_or_mesh(request.target, FieldChoice::none);
  // --position names columns of the source, where both are text
  return read_positions(
      request.target,
      {.plane = request.plane,
       .position = request.scattered() ? std::vector<std::string>() : request.position,
       .fields = std::vector<std::string>()});
}

// ---- Fields

std::vector<std::string> field_names(const std::vector<MeshField>& fields) {
  std::vector<std::string> names;
  for (const MeshField& field : fields)
    names.push_back(field.name);
  return names;
}

MeshField& field_named(const std::string& name, FieldGrid& source) {
  const auto found = std::find_if(source.fields.begin(), source.fields.end(),
                                  [&](const MeshField& field) { return field.name == name; });
  if (found != source.fields.end())
    return *found;
  const std::vector<std::string> names = field_names(source.fields);
  const std::string nearest = nearest_name(name, names);
  refuse(message("{} has no field {} at cells{}{}", source.name, name,
                 nearest.empty() ? "" : message("; did you mean {}?", nearest),
                 names.empty() ? "; give a file that has"
                               : (nearest.empty() ? "; it has " : " It has ") + listed(names)));
}

/// The fields that are asked for; all without names.
std::vector<MeshField> chosen_fields(const InterpolateRequest& request, FieldGrid& source) {
  if (request.fields.empty() && source.fields.empty())
    refuse(message("{} has no fields at cells; give a file that has, or --weights without -o",
                   source.name));
  if (request.fields.empty())
    return std::move(source.fields);
  std::vector<MeshField> chosen;
  for (const std::string& name : request.fields) {
    if (std::ranges::find(chosen, name, &MeshField::name) != chosen.end())
      refuse(message("--fields names {} twice; name it once", name));
    chosen.push_back(field_named(name, source));
  }
  return chosen;
}

/// Requires the fields of --categories and --numbers to be among those that are taken.
void require_taken(const InterpolateRequest& request, const std::vector<MeshField>& fields) {
  const auto require_each = [&](const char* option, const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (std::ranges::find(fields, name, &MeshField::name) == fields.end()) {
        const std::string nearest = nearest_name(name, field_names(fields));
        refuse(
            message("{}: no field {} is taken{}", option, name,
                    nearest.empty() ? "; leave it out" : message("; did you mean {}?", nearest)));
      }
  };
  require_each("--categories", request.categories);
  require_each("--numbers", request.numbers);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether integers are categories: what the options say, or those without a unit.
/// \returns the remark on a decision that no option made.
std::string decide_categories(const InterpolateRequest& request, MeshField& field) {
  if (contains(request.categories, field.name)) {
    if (!field.integer)
      refuse(
          message("--categories {}: the field does not hold integers; leave it out", field.name));
    return "";
  }
  if (!field.integer)
    return "";
  if (contains(request.numbers, field.name)) {
    field.integer = false;
    return "";
  }
  const bool numbers = !field.units.empty() && field.units != "1";
  field.integer = !numbers;
  return numbers ? message("{} holds integers in {}, taken as numbers; see --categories\n",
                           field.name, field.units)
                 : message("{} holds integers without a unit, taken as categories: each cell has "
                           "the one of the greatest weight; see --numbers\n",
                           field.name);
}

// ---- Weights

void require_fit(const InterpolateRequest& request, const GridWeights& weights,
                 const FieldGrid& source, const FieldGrid& target) {
  const auto require_size = [&](std::int64_t known, const FieldGrid& grid, const char* role) {
    require(known == grid.size(),
            "{}: the weights are for a {} of {} cells, and {} has {}; give the grids for which "
            "they were made",
            request.apply, role, known, grid.name, grid.size());
  };
  require_size(weights.weights.cols(), source, "source");
  require_size(weights.weights.rows(), target, "target");
}

GridWeights weights_of(const InterpolateRequest& request, const FieldGrid& source,
                       const FieldGrid& target) {
  if (request.apply.empty())
    return interpolation_weights(source, target, request.method);
  GridWeights weights = read_weights(request.apply);
  require_fit(request, weights, source, target);
  return weights;
}

// ---- Messages

/// By cell of the target, whether the source has none there.
using Outside = std::vector<bool>;

Outside without_weights(const Weights& weights) {
  Outside outside;
  for (Eigen::Index i = 0; i < weights.rows(); ++i)
    outside.push_back(weights.outerIndexPtr()[i + 1] == weights.outerIndexPtr()[i]);
  return outside;
}

/// The cells inside that lack a number, and how many numbers these lack.
struct Missing {
  std::int64_t cells = 0, values = 0;
};

Missing count_missing(const Outside& outside, const MeshField& field) {
  Missing missing;
  for (std::int64_t i = 0; i < std::ssize(outside); ++i) {
    if (outside[static_cast<std::size_t>(i)])
      continue;
    const std::int64_t lacks =
        field.values.segment(i * field.count(), field.count()).array().isNaN().count();
    missing.cells += lacks > 0 ? 1 : 0;
    missing.values += lacks;
  }
  return missing;
}

bool is_of_times(const MeshField& field) {
  return field.dimensions.size() == 1 &&
         (field.dimensions[0].name == "time" || field.dimensions[0].name == "Time");
}

/// "sst: 12 of 2562 cells have no value, at each time"; "" if no number is missing.
std::string missing_words(const Outside& outside, const MeshField& field) {
  const Missing missing = count_missing(outside, field);
  const std::int64_t count = field.count(), cells = std::ssize(outside);
  if (missing.values == 0)
    return "";
  std::string over;
  for (const FieldDimension& dimension : field.dimensions)
    over += message("{}{} ({})", over.empty() ? "" : ", ", dimension.name, dimension.size);
  if (missing.values == count * missing.cells)
    return message("{}: {} of {} {} no value{}", field.name, missing.cells, counted(cells, "cell"),
                   missing.cells == 1 ? "has" : "have",
                   count == 1           ? ""
                   : is_of_times(field) ? ", at each time"
                                        : ", at each index of " + over);
  return message("{}: {} of {} {} no value, in all, over {}", field.name, missing.values,
                 counted(count * cells, "number"), missing.values == 1 ? "has" : "have",
                 is_of_times(field) ? counted(count, "time") : over);
}

std::string describe_missing(const InterpolateRequest& request, const FieldGrid& source,
                             const Outside& outside, const std::vector<MeshField>& fields) {
  std::string lines;
  const std::string& name = request.output.empty() ? request.weights : request.output;
  if (const auto count = std::ranges::count(outside, true); count > 0)
    lines += message("{}: {} {} outside of {}, and missing\n", name, counted(count, "cell"),
                     count == 1 ? "is" : "are", source.name);
  for (const MeshField& field : fields)
    if (const std::string words = missing_words(outside, field); !words.empty())
      lines += request.min_cover > 0
                   ? message("{}: {}, as {} has values for less than {} of the cell\n", name, words,
                             source.name, request.min_cover)
                   : message("{}: {}, as {} has none there\n", name, words, source.name);
  return lines;
}

/// What scattered values gave: numbers that are missing, and what is written.
std::string describe_scattered(const InterpolateRequest& request, const FieldGrid& target,
                               const std::vector<MeshField>& fields) {
  std::string lines;
  const char* const where = target.positions ? "position" : "cell";
  const std::int64_t masked = target.mask.size() - target.mask.sum();
  if (masked > 0)
    lines += message("{}: {} that the mask of {} leaves out {} missing\n", request.output,
                     counted(masked, where), target.name, masked == 1 ? "is" : "are");
  const MeshField* before = nullptr;
  for (const MeshField& field : fields) {
    const std::int64_t lacks = field.values.array().isNaN().count() - masked;
    const bool as_before =
        before != nullptr && (field.values.array().isNaN() == before->values.array().isNaN()).all();
    before = &field;
    if (lacks > 0 && !as_before)
      lines += message("{}: {}: {} of {} {} outside of the triangles between the positions of {}, "
                       "and missing\n",
                       request.output, field.name, lacks, counted(target.size(), where),
                       lacks == 1 ? "is" : "are", request.source);
  }
  return lines;
}

std::string written_line(const InterpolateRequest& request, const FieldGrid& target,
                         const std::vector<MeshField>& fields) {
  return message("{}: {} at {}, {}\n", request.output, listed(field_names(fields)),
                 counted(target.size(), target.positions ? "position" : "cell"),
                 request.apply.empty() ? request.method_word : "by " + request.apply);
}

std::string history_of(const InterpolateRequest& request) {
  return message(
      "calotte " CALOTTE_VERSION " interpolate: {} {} {}", request.source, request.target,
      request.apply.empty() ? "--method " + request.method_word : "--apply " + request.apply);
}

/// Interpolates scattered values. \returns what to say of them.
std::string interpolate_text(const InterpolateRequest& request, const FieldGrid& source,
                             const FieldGrid& target, std::vector<MeshField>& fields) {
  ScatteredFields found = interpolate_scattered(source, target, request.method);
  if (found.merged > 0)
    warn(message("{}: {} had the position of an earlier row; the values at one position are "
                 "averaged",
                 request.source, counted(found.merged, "row")));
  fields = std::move(found.fields);
  return describe_scattered(request, target, fields);
}

/// Interpolates by weights, and writes these if they are asked for.
std::string interpolate_cells(const InterpolateRequest& request, const FieldGrid& source,
                              const FieldGrid& target, std::vector<MeshField>& fields,
                              Progress& progress) {
  const GridWeights weights = weights_of(request, source, target);
  for (MeshField& field : fields)
    field = interpolate(weights, field, request.min_cover);
  if (!request.weights.empty()) {
    progress.writing(request.weights);
    write_weights(request.weights, weights, source, target, request.method, request.format,
                  history_of(request));
  }
  std::string lines = describe_missing(request, source, without_weights(weights.weights), fields);
  if (!request.weights.empty())
    lines += message("{}: {} weights from {} to {} cells\n", request.weights,
                     weights.weights.nonZeros(), weights.weights.cols(), weights.weights.rows());
  return lines;
}

/// Interpolates a file that is read in parts.
/// \param first its first part.
std::string interpolate_in_parts(const InterpolateRequest& request, const FieldParts& parts,
                                 const FieldGrid& first, const FieldGrid& target,
                                 std::vector<MeshField>& fields) {
  CoveredFields found = interpolate_parts(parts, fields, target, request.min_cover);
  fields = std::move(found.fields);
  Outside outside;
  for (const double fraction : found.target_fraction)
    outside.push_back(!(fraction > 0));
  return describe_missing(request, first, outside, fields);
}

/// The source in parts, where these are several and weights are not asked for.
std::optional<FieldParts> parts_of(const InterpolateRequest& request) {
  if (request.scattered() || request.to_positions() || raster_of(request.source) ||
      request.method != Interpolation::conservative || !request.mesh.empty() ||
      !request.weights.empty() || !request.apply.empty())
    return std::nullopt;
  FieldParts parts(request.source, request.at);
  return parts.count() > 1 ? std::optional(std::move(parts)) : std::nullopt;
}

void run(const InterpolateRequest& request) {
  require_request(request);
  std::string lines;
  {
    Progress progress;
    progress.stage("reading " + request.source);
    const std::optional<FieldParts> parts = parts_of(request);
    FieldGrid source = parts ? parts->read(0) : source_of(request);
    std::vector<MeshField> fields;
    if (!request.output.empty() && !request.scattered())
      fields = chosen_fields(request, source);
    require_taken(request, fields);
    for (MeshField& field : fields)
      lines += decide_categories(request, field);
    progress.stage("reading " + request.target);
    const FieldGrid target = target_of(request);
    if (!request.output.empty())
      require_storable(request.output, target, request.scattered() ? source.fields : fields);
    progress.stage(message("weights from {} to {}", request.source, request.target));
    lines += request.scattered() ? interpolate_text(request, source, target, fields)
             : parts             ? interpolate_in_parts(request, *parts, source, target, fields)
                                 : interpolate_cells(request, source, target, fields, progress);
    if (!request.output.empty()) {
      progress.writing(request.output);
      write_fields(request.output, target, fields, history_of(request), source.name);
      lines += written_line(request, target, fields);
    }
  }
  std::cout << lines;
}

void add_field_options(CLI::App& command, InterpolateRequest& request) {
  const auto add = [&](const std::string& name, std::vector<std::string>& names,
                       const std::string& help) {
    command.add_option(name, names, help)->type_name("NAMES")->delimiter(',');
  };
  command
      .add_option("--mesh", request.mesh,
                  "Mesh of the fields in SOURCE, where that holds none, such as a model's history.")
      ->type_name("FILE");
  command
      .add_option("--position", request.position,
                  "Columns of the position in a text, by name or number, such as 2,3. Of two texts "
                  "SOURCE. Default: those that a header names, or the first two.")
      ->type_name("COLUMNS")
      ->delimiter(',')
      ->expected(2);
  command.add_flag("--plane", request.plane,
                   "Positions in text are x y of a plane, not longitude and latitude");
  add_at(command, request.at);
  add("--fields", request.fields,
      "Names of the fields, with commas between them; of a text its columns, by name or number. "
      "Default: all.");
  command
      .add_option("--min-cover", request.min_cover,
                  "Least part of a cell, 0 to 1, that valid values must cover; the cell is missing "
                  "below it. Missing values do not count: the others are divided by their part of "
                  "the weights. Default: 0, any part is enough.")
      ->type_name("PART")
      ->check(CLI::Range(0.0, 1.0));
  add("--categories", request.categories,
      "Fields of integers that are categories, such as land use: a cell gets the one of the "
      "greatest weight. Default: those without a unit.");
  add("--numbers", request.numbers,
      "Fields of integers that are numbers, such as heights in metres. Default: those with a "
      "unit.");
}

void add_weights_options(CLI::App& command, InterpolateRequest& request) {
  command
      .add_option("--weights", request.weights,
                  "Also write the weights to this NetCDF file, for ncremap, CDO and --apply.")
      ->type_name("FILE");
  add_choice<WeightsFormat>(
      command, "--weights-format", request.format,
      {{"esmf", WeightsFormat::esmf}, {"scrip", WeightsFormat::scrip}},
      "Format of the weights: esmf, as ESMF_RegridWeightGen writes them, or scrip, as CDO does.")
      ->needs("--weights");
  command
      .add_option("--apply", request.apply,
                  "Apply the weights in this file of either format, also those of other "
                  "programs.")
      ->type_name("FILE")
      ->excludes("--weights");
}

void use_default_method(InterpolateRequest& request) {
  const bool text = request.scattered() || request.to_positions();
  request.method = text ? Interpolation::linear : Interpolation::conservative;
  request.method_word = text ? "linear" : "conservative";
}

} // namespace

void add_interpolate(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "interpolate", "Takes fields from one grid to another: meshes, rasters of longitude and "
                     "latitude, and scattered positions.");
  auto request = std::make_shared<InterpolateRequest>();
  command
      ->add_option("SOURCE,--source", request->source,
                   "Mesh with fields at its cells, raster: NetCDF with lat(lat) and lon(lon), or "
                   "text with positions and values on each line.")
      ->type_name("FILE")
      ->required();
  command
      ->add_option(
          "TARGET,--target", request->target,
          "Mesh or raster whose cells get the fields, text with a position on each line, or "
          "the size of a global raster, such as 720x360.")
      ->type_name("FILE|SIZE")
      ->required();
  command
      ->add_option("-o,--output", request->output,
                   "File of the fields. NetCDF (.nc) holds them with the places of the cells, in "
                   "the order of TARGET; a name of another mesh format holds the mesh, too. For "
                   "positions also text (.csv, .txt).")
      ->type_name("FILE");
  add_choice<Interpolation>(
      *command, "--method", request->method,
      {{"conservative", Interpolation::conservative},
       {"linear", Interpolation::linear},
       {"nearest", Interpolation::nearest},
       {"natural", Interpolation::natural_neighbours}},
      "How: conservative, linear, nearest or natural. conservative: the mean over the cell, by "
      "shared areas, which keeps the integral. linear: on "
      "triangles between centres, bilinear in a raster. nearest: the value of the cell that holds "
      "the centre, or of the nearest position. natural: natural neighbours, of meshes and "
      "positions.")
      ->default_str("conservative; linear with a text");
  add_field_options(*command, *request);
  add_weights_options(*command, *request);
  command->get_option("--apply")->excludes("--method");
  add_threads(*command, request->threads,
              "Number of threads, 1 to 4096; no effect on the result. Default: all.");
  set_help(*command,
           {.common = {},
            .examples = {
                "calotte interpolate topography.nc grid.nc -o heights.nc --fields z",
                "calotte interpolate history.nc 720x360 --mesh grid.nc -o map.nc --fields t2m,ssh",
                "calotte interpolate stations.csv 720x360 --method natural -o map.nc",
                "calotte interpolate grid.nc 720x360 --weights map.nc"}});
  command->callback([command, request] {
    if (const CLI::Option* const method = command->get_option("--method"); method->count() > 0)
      request->method_word = method->as<std::string>();
    else
      use_default_method(*request);
    with_threads(request->threads, [&] { run(*request); });
  });
}

} // namespace calotte::tools
