// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "draw.h"

#include <calotte/error.h>

#include <charconv>
#include <map>
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

void add_look(CLI::App& command, DrawOptions& options) {
  static const std::map<std::string, Shapes> shapes = {{"triangles", Shapes::triangles},
                                                       {"cells", Shapes::cells}};
  static const std::map<std::string, Colouring> colourings = {{"spacing", Colouring::spacing},
                                                              {"angle", Colouring::angle},
                                                              {"valence", Colouring::valence},
                                                              {"none", Colouring::none}};
  command
      .add_option_function<std::string>(
          "--view", [&options](const std::string& text) { options.view = parse_view(text); },
          "the middle of the globe; default: 15,25, or the middle of an open mesh")
      ->type_name("LON,LAT");
  command.add_option("--size", options.size, "width in pixels (points in SVG and PDF)")
      ->check(CLI::Range(64, 16384))
      ->capture_default_str();
  command.add_option("--what", options.shapes, "triangles, or cells: Voronoi cells")
      ->transform(CLI::CheckedTransformer(shapes).description(""))
      ->type_name("SHAPES")
      ->default_str("triangles");
  command
      .add_option("--colour,--color", options.colouring,
                  "spacing: mean distance of neighbours; angle: smallest angle; valence: number of "
                  "neighbours; or none")
      ->transform(CLI::CheckedTransformer(colourings).description(""))
      ->type_name("QUANTITY")
      ->default_str("spacing");
}

void run(const DrawArguments& arguments) {
  picture_format(arguments.output); // fails before the mesh is read
  require_folder(arguments.output);
  require_distinct(arguments.output, arguments.source->path);
  require_distinct(arguments.output, arguments.source->points);
  draw(arguments.output, read_mesh(*arguments.source), arguments.options);
}

} // namespace

void add_draw(CLI::App& app) {
  CLI::App* command = app.add_subcommand("draw", "Draw a mesh as a globe");
  auto arguments = std::make_shared<DrawArguments>();
  arguments->source = add_mesh_source(*command);
  command->add_option("-o,--output", arguments->output, "the picture: .png, .svg or .pdf")
      ->required()
      ->type_name("FILE");
  add_look(*command, arguments->options);
  command->callback([arguments] { run(*arguments); });
}

} // namespace calotte::tools
