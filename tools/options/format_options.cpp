// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/format_options.h"

#include "io/command.h"
#include "text/text.h"

#include <calotte/error.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {
namespace {

const std::map<std::string, Numbering> numberings{{"curve", Numbering::curve},
                                                  {"input", Numbering::input}};

Format chosen_format(const FormatWords& words, const std::string& path) {
  Format given = Format::by_name;
  for (const FormatInfo& info : formats())
    if (words.format == info.word)
      given = info.format;
  const ModelNeeds* const model = model_of(words.model);
  const Format format = calotte::format_of(path, given);
  if (model != nullptr && model->format != format)
    refuse_path(path, "--for {} writes the format {}, not {}; give {}{}", model->word,
                info_of(model->format).word, info_of(format).word,
                model->format == Format::fesom ? "the name nod2d.out" : "a name that ends in .nc",
                words.format ? ", and leave --format out" : "");
  return format;
}

/// Nothing for a name that is no mesh's.
std::optional<Format> format_of_name(const std::string& path) {
  try {
    return calotte::format_of(path);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// The names of files of some formats, each once.
std::string names(bool (*of)(const FormatInfo&)) {
  std::vector<std::string> all;
  for (const FormatInfo& info : formats())
    for (const std::string& name : info.names)
      if (of(info) && std::find(all.begin(), all.end(), name) == all.end())
        all.push_back(name);
  return listed(all, " or ");
}

void require_radius(double radius, Format format, const std::string& path) {
  require_sphere_radius(radius);
  if (radius != 1 && !info_of(format).netcdf)
    refuse(message("--sphere-radius {} applies to NetCDF files only, not to {}; leave it out, or "
                   "give a name that ends in .nc",
                   shortest(radius), path));
}

} // namespace

std::shared_ptr<FormatWords> add_format(CLI::App& command, const FormatDefaults& defaults) {
  auto words = std::make_shared<FormatWords>();
  std::vector<std::string> known;
  for (const FormatInfo& info : formats())
    if (!info.word.empty())
      known.push_back(info.word);
  add_model(command, words->model);
  command
      .add_option("--format", words->format,
                  "Format of the mesh; default: by the file name; see calotte help formats")
      ->check(CLI::IsMember(known));
  add_sphere_radius(command, words->sphere_radius,
                    "Radius of the sphere in NetCDF files: metres, > 0, or earth (6371229 m); "
                    "default: " +
                        defaults.radius);
  command
      .add_option("--order", words->order,
                  "Numbering of the cells: curve (along a space-filling curve) or input (the order "
                  "of what was given); default: " +
                      defaults.order)
      ->check(CLI::IsMember({"curve", "input"}));
  return words;
}

bool is_mpas(Format format) { return format == Format::mpas || format == Format::mpas_minimal; }

bool holds_points(const std::string& path) {
  const std::optional<Format> format = format_of_name(path);
  return format ? *format != Format::triangles && *format != Format::mpi_scvt
                : is_netcdf_file(path);
}

bool is_positions(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  const std::string suffix = name.extension();
  const auto has_name = [&](const FormatInfo& info) { // also of formats that are only read
    return std::ranges::find(info.names, suffix) != info.names.end();
  };
  const bool is_mpi_scvt =
      name.string().starts_with("SaveVertices") || name.string().starts_with("SaveTriangles");
  return !holds_points(path) && !is_mpi_scvt &&
         (suffix == ".txt" || suffix.empty() || std::ranges::none_of(formats(), has_name));
}

bool holds_triangles(const std::string& path) { return format_of_name(path) == Format::triangles; }

std::string names_of_read_meshes() {
  return names([](const FormatInfo& info) { return info.read && info.points; });
}

std::string help_of_output() {
  return "Output mesh. Its name selects the format, see calotte help formats: " +
         names([](const FormatInfo& info) { return !info.word.empty(); });
}

WriteOptions options_of(const FormatWords& words, const std::string& path) {
  WriteOptions options;
  options.format = chosen_format(words, path);
  const ModelNeeds* const model = model_of(words.model);
  options.sphere_radius = words.sphere_radius.value_or(options.sphere_radius);
  require_radius(options.sphere_radius, options.format, path);
  if (model != nullptr) {
    options.sphere_radius = *radius_for(model, words.sphere_radius);
    options.planet_radius = model->planet_radius;
    options.numbering = model->numbering;
    options.vertex_order = model->vertex_order;
    options.dimensions = model->dimensions;
  }
  if (words.order)
    options.numbering = numberings.at(*words.order);
  if (words.order && *words.order != "input" && options.format == Format::triangles)
    refuse(message("{} holds triangles that refer to the input points; leave --order out", path));
  return options;
}

} // namespace calotte::tools
