// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "draw.h"

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
  std::string output;
  DrawOptions options;
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

void run(const DrawArguments& arguments) {
  picture_format(arguments.output); // fails before the mesh is read
  require_folder(arguments.output);
  require_distinct(arguments.output, arguments.source->path);
  require_distinct(arguments.output, arguments.source->points);
  const Mesh mesh = read_mesh(*arguments.source);
  draw(arguments.output, mesh, arguments.options);
  std::cout << arguments.output << ": picture of " << mesh.points.cols() << " sites, "
            << mesh.triangles.cols() << " triangles\n";
}

} // namespace

void add_draw(CLI::App& app) {
  CLI::App* command = app.add_subcommand("draw", "Draw a mesh as a globe.");
  auto arguments = std::make_shared<DrawArguments>();
  arguments->source = add_mesh_source(*command);
  command->add_option("-o,--output", arguments->output, "the picture: .png, .svg or .pdf")
      ->required()
      ->type_name("FILE");
  add_look(*command, arguments->options);
  command->callback([arguments] { run(*arguments); });
}

} // namespace calotte::tools
