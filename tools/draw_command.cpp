// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "density_option.h"
#include "draw.h"
#include "draw_history.h"
#include "draw_picture.h"
#include "draw_spacing_law.h"

#include <calotte/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <string_view>

namespace calotte::tools {

namespace {

struct DrawArguments {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<DensityWords> density;
  std::string output;
  DrawOptions options;
  std::vector<std::string> reports; ///< to be drawn instead of a mesh
  bool spacing_law = false;
};

/// Takes a number and what follows it; false where none is.
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
    throw Error(ErrorCode::bad_option,
                "--view " + std::string(text) +
                    " is no place; give longitude and latitude in degrees, as in --view 15,-30");
  }
  return view;
}

/// An option whose value is one of a few words.
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

void add_look(CLI::App& command, DrawOptions& options) {
  const auto look_from = [&options](const std::string& text) { options.view = parse_view(text); };
  command
      .add_option_function<std::string>(
          "--view", look_from,
          "the middle of the globe; default: 15,25, or the middle of an open mesh")
      ->type_name("LON,LAT");
  command.add_option("--size", options.size, "width in pixels (points in SVG and PDF)")
      ->check(CLI::Range(64, 16384))
      ->capture_default_str();
  add_choice<Shapes>(command, "--what", options.shapes,
                     {{"triangles", Shapes::triangles}, {"cells", Shapes::cells}},
                     "the Delaunay triangles or the Voronoi cells");
  add_choice<Colouring>(
      command, "--colour,--color", options.colouring,
      {{"spacing", Colouring::spacing},
       {"angle", Colouring::angle},
       {"valence", Colouring::valence},
       {"none", Colouring::none}},
      "by what to colour them: spacing is the mean distance of neighbours, angle the "
      "smallest, valence the number of neighbours");
}

/// The pictures that are no globe, and which options they do without.
void add_plots(CLI::App& command, DrawArguments& arguments) {
  CLI::Option* history =
      command
          .add_option(
              "--history", arguments.reports,
              "instead of a mesh, draw how runs converged, against evaluations and seconds: "
              "reports of calotte cvt --report")
          ->type_name("REPORT ...")
          ->expected(1, static_cast<int>(most_histories));
  CLI::Option* law = command.add_flag(
      "--spacing-law", arguments.spacing_law,
      "instead of the globe, draw the cells' spacings against those that --density asks for");
  law->needs(command.get_option("--density"));
  for (const char* name : {"--density", "--join"}) {
    command.get_option(name)->needs(law);
  }
  for (const char* name : {"--view", "--what", "--colour"}) {
    law->excludes(command.get_option(name));
    history->excludes(command.get_option(name));
  }
  for (const char* name : {"MESH", "--points", "--lonlat", "--spacing-law"}) {
    history->excludes(command.get_option(name));
  }
}

void draw_reports(const DrawArguments& arguments) {
  std::vector<History> histories;
  for (const std::string& report : arguments.reports) {
    require_distinct(arguments.output, report);
    histories.push_back(read_history(report));
  }
  draw_history(arguments.output, histories, arguments.options.size);
  std::cout << arguments.output << ": convergence of " << histories.size()
            << (histories.size() == 1 ? " run\n" : " runs\n");
}

void draw_mesh(const DrawArguments& arguments) {
  if (arguments.source->path.empty()) {
    throw CLI::RequiredError("MESH");
  }
  require_distinct(arguments.output, arguments.source->path);
  require_distinct(arguments.output, arguments.source->points);
  const Density density = density_of(*arguments.density);
  const Mesh mesh = read_mesh(*arguments.source);
  if (arguments.spacing_law) {
    draw_spacing_law(arguments.output, mesh, density, arguments.options.size);
  } else {
    draw(arguments.output, mesh, arguments.options);
  }
  std::cout << arguments.output << ": "
            << (arguments.spacing_law ? "spacing law of " : "picture of ") << mesh.points.cols()
            << " sites, " << mesh.triangles.cols() << " triangles\n";
}

void run(const DrawArguments& arguments) {
  picture_format(arguments.output); // fails before anything is read
  require_folder(arguments.output);
  if (arguments.reports.empty()) {
    draw_mesh(arguments);
  } else {
    draw_reports(arguments);
  }
}

} // namespace

void add_draw(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "draw", "Draw a mesh as a globe, its spacing law, or how a CVT converged.");
  auto arguments = std::make_shared<DrawArguments>();
  arguments->source = add_mesh_source(*command);
  command->get_option("MESH")->required(false); // a report takes its place
  command->add_option("-o,--output", arguments->output, "the picture: .png, .svg or .pdf")
      ->required()
      ->type_name("FILE");
  add_look(*command, arguments->options);
  arguments->density = add_density(*command);
  add_plots(*command, *arguments);
  command->callback([arguments] { run(*arguments); });
}

} // namespace calotte::tools
