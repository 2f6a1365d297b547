// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/domain_option.h"

#include "options/files.h"
#include "options/numbers.h"
#include "text/text.h"

#include <calotte/read.h>

#include <CLI/App.hpp>

#include <cmath>

namespace calotte::tools {
namespace {

Surface rectangle_of(const std::string& word) {
  const auto sides = numbers_of<4>(word);
  if (!sides || !((*sides)[0] < (*sides)[2]) || !((*sides)[1] < (*sides)[3]))
    refuse(
        message("--rectangle {} is not a rectangle; give its lower left and upper right corners, "
                "as in --rectangle 0,0,2,1",
                word));
  return rectangle({(*sides)[0], (*sides)[1]}, {(*sides)[2], (*sides)[3]});
}

} // namespace

CLI::Option* add_periodic(CLI::App& command, std::optional<std::string>& word) {
  return command
      .add_option(
          "--periodic", word,
          "Doubly periodic plane: a box with this WIDTH and HEIGHT, > 0. It contains all points; "
          "its lower left corner is at 0 0. Meshes of it are .nc (MPAS), .txt or .tri")
      ->type_name("WIDTH,HEIGHT");
}

std::shared_ptr<DomainWords> add_bounded_domain(CLI::App& command) {
  auto words = std::make_shared<DomainWords>();
  CLI::Option* file =
      command
          .add_option("--domain", words->file,
                      "Planar domain inside the polygons of a file. GeoJSON (.geojson, .json; x "
                      "and y in place of longitude and latitude), or text with a corner x y on "
                      "each line and a blank line or a line > between rings. Rings within rings "
                      "are holes")
          ->type_name("FILE");
  command
      .add_option("--rectangle", words->rectangle,
                  "Planar domain: the rectangle with this lower left and upper right corner")
      ->type_name("X0,Y0,X1,Y1")
      ->excludes(file);
  return words;
}

std::shared_ptr<DomainWords> add_domain(CLI::App& command) {
  auto words = add_bounded_domain(command);
  add_periodic(command, words->periodic)
      ->excludes(command.get_option("--domain"))
      ->excludes(command.get_option("--rectangle"));
  return words;
}

void add_hexagons(CLI::App& command, DomainWords& words) {
  command
      .add_option("--hexagons", words.hexagons,
                  "A grid of regular hexagons in the plane instead of a run: NX columns, NY rows, "
                  "centres DC apart, as planar_hex of MPAS-Tools makes it. The box follows; it is "
                  "periodic but for --walls")
      ->type_name("NX,NY,DC")
      ->excludes(command.get_option("--domain"))
      ->excludes(command.get_option("--rectangle"))
      ->excludes(command.get_option("--periodic"));
  command
      .add_option("--walls", words.walls,
                  "Direction in which the box of --periodic or --hexagons ends at walls instead: y "
                  "(a channel along x), x, or with --hexagons xy. Walls run along the sides of "
                  "whole cells, as MPAS-Ocean has them")
      ->check(CLI::IsMember({"x", "y", "xy"}));
}

Walls walls_of(const DomainWords& words) {
  if (!words.walls)
    return {};
  if (!words.periodic && !words.hexagons)
    refuse("--walls applies to a periodic box; give --periodic or --hexagons, too");
  return {*words.walls != "y", *words.walls != "x"};
}

MeshFile hexagons_of(const DomainWords& words) {
  const auto numbers = numbers_of<3>(*words.hexagons);
  const auto whole = [](double x) { return x >= 1 && x <= 1e9 && x == std::floor(x); };
  if (!numbers || !whole((*numbers)[0]) || !whole((*numbers)[1]) || !((*numbers)[2] > 0))
    refuse(message("--hexagons {} is not two counts and a distance; give columns, rows and the "
                   "distance of the centres, as in --hexagons 16,50,10000",
                   *words.hexagons));
  return planar_hexagons(static_cast<std::int64_t>((*numbers)[0]),
                         static_cast<std::int64_t>((*numbers)[1]), (*numbers)[2], walls_of(words));
}

std::optional<Eigen::Vector2d> period_of(const std::optional<std::string>& word) {
  if (!word)
    return std::nullopt;
  const auto sides = numbers_of<2>(*word);
  if (!sides || !((*sides)[0] > 0) || !((*sides)[1] > 0))
    refuse(message(
        "--periodic {} is not a box; give two positive lengths, as in --periodic 1000,866.025",
        *word));
  return Eigen::Vector2d((*sides)[0], (*sides)[1]);
}

void set_surface(Mesh& mesh, const Surface& part) {
  const Eigen::Vector2d& period = mesh.surface.period();
  if (period != part.period())
    refuse(message("the domain's period is not that of the mesh, {} x {}; leave the domain out, or "
                   "give that of the mesh",
                   shortest(period.x()), shortest(period.y())));
  mesh.surface = part;
}

std::string domain_configuration(const DomainWords& words) {
  if (words.file)
    return message("domain of {}\n", checksum_of(*words.file));
  if (words.rectangle)
    return message("rectangle {}\n", *words.rectangle);
  return message("periodic {}\n{}", *words.periodic,
                 words.walls ? message("walls {}\n", *words.walls) : "");
}

std::optional<Surface> surface_of(const DomainWords& words) {
  if (words.file)
    return read_domain(*words.file);
  if (words.rectangle)
    return rectangle_of(*words.rectangle);
  if (const std::optional<Eigen::Vector2d> period = period_of(words.periodic))
    return Surface::periodic(*period);
  return std::nullopt;
}

} // namespace calotte::tools
