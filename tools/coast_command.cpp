// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "options/cell_width_option.h"
#include "options/files.h"
#include "options/numbers.h"
#include "options/ocean_options.h"
#include "options/region_option.h"
#include "run/interruption.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/generalise.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/write_region.h>

#include <CLI/App.hpp>

#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace calotte::tools {
namespace {

struct CoastRequest {
  std::vector<std::string> coasts, passages, seeds;
  std::string region, inside;
  WidthWords widths;
  double least_island = GeneraliseOptions{}.least_island;
  std::string output;
};

/// Checks all options that can fail, before any input is read.
void require_request(const CoastRequest& request) {
  if (!request.widths.in_km())
    refuse("there are no widths; give --cell-width KM|FILE");
  if (!request.output.ends_with(".geojson") && !request.output.ends_with(".json"))
    refuse_path(request.output, "the sea is written to GeoJSON; give a name that ends in .geojson");
  std::vector<std::string> inputs = request.coasts;
  inputs.insert(inputs.end(), request.passages.begin(), request.passages.end());
  if (!request.widths.file.empty())
    inputs.push_back(request.widths.file);
  require_outputs({{"sea", request.output}}, inputs);
}

std::string position_words(const Eigen::Vector3d& position) {
  const Points2 at = to_lonlat(position);
  return lonlat_words(at(0, 0), at(1, 0));
}

/// The largest of some parts of the sea, a line for each. \param scale km^2 of a steradian.
std::string largest_of(const std::vector<ClosedSea>& seas, double scale) {
  constexpr std::size_t most = 5;
  std::string lines;
  for (std::size_t k = 0; k < seas.size() && k < most; ++k)
    lines += row("  around " + position_words(seas[k].position), 28,
                 formatted("%.0f km^2", seas[k].area * scale));
  return lines;
}

/// A line on passages without effect; "" if all have one.
std::string stranded_passages(const GeneralisedSea& sea, const std::vector<Points3>& passages) {
  std::vector<std::string> positions;
  for (const std::int64_t passage : sea.stranded_passages) {
    const Points3& line = passages[static_cast<std::size_t>(passage)];
    positions.push_back(position_words(line.col(line.cols() / 2)));
  }
  return positions.empty() ? ""
                           : message("{} that no sea of the region reaches, without effect: {}\n",
                                     counted(std::ssize(positions), "passage"), listed(positions));
}

std::string describe_coast(const CoastRequest& request, const GeneralisedSea& sea,
                           const std::vector<Points3>& passages) {
  const double scale = request.widths.radius * request.widths.radius; // km^2 of a steradian
  const auto line = [](const std::string& name, const std::string& value) {
    return row(name, 28, value);
  };
  std::int64_t corners = 0;
  for (const DoubleMatrix& ring : sea.sea.rings())
    corners += ring.cols();
  return line("islands left out", spaced(sea.islands)) +
         line("parts of the sea left out", spaced(std::ssize(sea.parts))) +
         largest_of(sea.parts, scale) +
         (sea.parts.empty()
              ? ""
              : "  --passage connects a part, --seed selects parts by points in them\n") +
         line("straits closed", spaced(std::ssize(sea.straits))) + largest_of(sea.straits, scale) +
         stranded_passages(sea, passages) +
         line("land that became sea", formatted("%.0f km^2", sea.land_to_sea * scale)) +
         line("sea that became land", formatted("%.0f km^2", sea.sea_to_land * scale)) +
         line("distance from the coast", formatted("%.2f", sea.usual_displacement) +
                                             " widths at 95% of the rings, at most " +
                                             formatted("%.2f", sea.displacement)) +
         message("{}: {}, {}, {}\n", request.output, counted(std::ssize(sea.sea.rings()), "ring"),
                 counted(corners, "corner"), formatted("%.4g km^2", sea.sea.area() * scale));
}

void run(const CoastRequest& request) {
  require_request(request);
  GeneralisedSea sea;
  GeneraliseOptions options;
  {
    Progress progress;
    progress.stage("reading the coast");
    const Coast coast = read_coasts(request.coasts);
    options.least_island = request.least_island;
    if (!request.region.empty())
      options.within = region_of(request.region, request.inside, request.widths.radius);
    options.passages = read_all_lines(request.passages);
    options.seeds = read_seeds(request.seeds);
    const Widths widths = read_widths(request.widths).widths;
    progress.stage("generalising the coast");
    announce_files();
    sea = generalised_sea(coast, widths, options);
    write_region(request.output, sea.sea);
  }
  std::cout << describe_coast(request, sea, options.passages);
}

} // namespace

void add_coast(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "coast", "Makes the region of the sea at the widths of a grid, for a grid that ends at the "
               "coast.");
  auto request = std::make_shared<CoastRequest>();
  command
      ->add_option("COAST", request->coasts,
                   "Polygons of land: GeoJSON or a binned file of GSHHG, as of calotte cull --land")
      ->type_name("FILE")
      ->required();
  add_width_file(*command, request->widths, "Widths of the grid's cells");
  add_gradient(*command, request->widths.gradient,
               "Largest change of the widths, in km per km, such as 0.03; > 0")
      ->needs("--cell-width");
  command
      ->add_option(
          "--region", request->region,
          "Part of the sphere to which the sea belongs: a shape such as box=-6,30,37,46, or "
          "a file; see calotte help region. Its sides in the sea are open boundaries, "
          "which --open of other commands takes. Default: the whole sphere")
      ->type_name("SHAPE|FILE");
  add_inside(*command, request->inside);
  command
      ->add_option("--least-island", request->least_island,
                   "Islands of fewer cells become sea; >= 0.25. Default: 1.")
      ->type_name("CELLS");
  command
      ->add_option("--passage", request->passages,
                   "GeoJSON lines along which the sea is a cell wide at least, also over land, "
                   "such as straits, and on from their ends to where it is as wide. May be "
                   "repeated.")
      ->type_name("FILE");
  command
      ->add_option("--seed", request->seeds,
                   "Point in the sea, in degrees. The region holds what is connected with a seed. "
                   "May be repeated. Default: the largest part of the sea.")
      ->type_name("LON,LAT");
  command
      ->add_option("-o,--output", request->output,
                   "GeoJSON file of the sea, for --region of other commands")
      ->type_name("FILE")
      ->required();
  set_help(*command,
           {.common = {"COAST", "--cell-width", "--gradient", "--region", "--least-island",
                       "--passage", "--seed", "--output"},
            .examples = {"calotte coast /usr/share/gmt-gshhg/binned_GSHHS_l.nc --cell-width 120km "
                         "-o sea.geojson",
                         "calotte coast land.geojson --cell-width rules.toml --passage "
                         "straits.geojson -o sea.geojson",
                         "calotte cvt --region sea.geojson --cell-width 120km --for mpas-ocean -o "
                         "ocean.nc"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
