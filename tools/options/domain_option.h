// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <calotte/mesh_file.h>
#include <calotte/surface.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// The values of the options for a domain of the plane; at most one is given.
struct DomainWords {
  std::optional<std::string> file;      ///< of polygons
  std::optional<std::string> rectangle; ///< "X0,Y0,X1,Y1"
  std::optional<std::string> periodic;  ///< "WIDTH,HEIGHT" of a box from 0 0 on
  std::optional<std::string> hexagons;  ///< "NX,NY,DC", which determine the box
  std::optional<std::string> walls;     ///< "x", "y" or "xy": where the box is not periodic

  bool given() const { return file || rectangle || periodic || hexagons; }
};

/// Adds --domain, --rectangle and --periodic.
std::shared_ptr<DomainWords> add_domain(CLI::App& command);
/// Their names.
inline const std::vector<std::string> domain_names{"--domain", "--rectangle", "--periodic"};

/// Adds --hexagons and --walls.
void add_hexagons(CLI::App& command, DomainWords& words);

/// The directions of --walls. \throws Error invalid_argument.
Walls walls_of(const DomainWords& words);

/// The mesh of --hexagons. \pre words.hexagons. \throws Error invalid_argument.
MeshFile hexagons_of(const DomainWords& words);

/// Adds --domain and --rectangle only.
std::shared_ptr<DomainWords> add_bounded_domain(CLI::App& command);

/// The part of the plane, or the box, of the options; none if no option is given. Reads the file,
/// if there is one. \throws Error invalid_argument naming the word and the remedy; as read_domain.
std::optional<Surface> surface_of(const DomainWords& words);

/// Sets the part of the plane that clips the cells of a mesh, or the box.
/// \throws Error invalid_argument for a box where the mesh's plane has another period.
void set_surface(Mesh& mesh, const Surface& part);

/// The input that determines it, a line "name value" for a run's configuration; for a file, its
/// contents.
/// \pre words.given().
/// \throws Error file.
std::string domain_configuration(const DomainWords& words);

/// Adds --periodic only.
/// \param word receives the value.
CLI::Option* add_periodic(CLI::App& command, std::optional<std::string>& word);

/// The period of --periodic, if it is given.
/// \throws Error invalid_argument.
std::optional<Eigen::Vector2d> period_of(const std::optional<std::string>& word);

} // namespace calotte::tools
