// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "io/mpas/room.h"

#include <calotte/rotate.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// What turns of the fields on a mesh that is rotated.
namespace calotte::io_detail {

/// What is known of a field before its values.
struct FieldTraits {
  std::string name, long_name, standard_name;
  /// The names of its dimensions, the last one the fastest, with that of the cells, edges or
  /// vertices. Components of one vector have the same.
  std::vector<std::string> dimensions;
  std::int64_t last_length = 0; ///< of the last dimension
  bool real = true;             ///< it has floats or doubles
  bool along_edges = false;     ///< components along normals or tangents of edges
};

/// How a field turns.
struct FieldTurn {
  enum class Kind {
    none,
    along_edges, ///< components that turn with the edges, whose values stay
    vectors,     ///< three Cartesian components in the last dimension
    components,  ///< one of three fields of Cartesian components
    east_north,  ///< one of two fields of zonal and meridional components
    twice,       ///< the same of a direction that turns by twice the angle
    coriolis,    ///< a function of the latitude, if its values are
    unknown,     ///< a direction that cannot turn
    of_mesh      ///< a variable of the mesh, which is no field
  };
  Kind kind = Kind::none;
  std::vector<std::size_t> parts = {}; ///< the fields that are components, in their order
  std::size_t part = 0;                ///< its own index among them
};

/// How each of all fields of a mesh turns.
std::vector<FieldTurn> find_turns(const std::vector<FieldTraits>& fields);

/// Adds the name of a field to the list of its kind. Those of coriolis are left to the caller.
void add_name(const std::string& name, const FieldTurn& turn, TurnedFields& fields);

/// Cosine and sine of the angle by which directions at a site turn, from the east of the old place
/// to the east of the new one. At a pole east is that of the longitude 0.
struct SiteTurn {
  double cos = 1, sin = 0;

  double angle() const; ///< radians, -pi to pi
  SiteTurn twice() const { return {cos * cos - sin * sin, 2 * sin * cos}; }
  std::array<double, 2> of(double east, double north) const {
    return {cos * east - sin * north, sin * east + cos * north};
  }
};
/// \param from, to the site before and after the rotation, of any norm.
SiteTurn turn_at(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Rotation& rotation);

/// A vector turned. \param of the old components; all stay where one is not finite.
Eigen::Vector3d turned(const Eigen::Vector3d& of, const Rotation& rotation);

/// The sine of the latitude.
double sine_of_latitude(const Eigen::Vector3d& point);

/// The k for which values are k times the sines of the latitudes, within 1e-6 of k; 0 if there is
/// none.
double coriolis_factor(std::span<const double> values, std::span<const double> sines);

/// Adds the name of a parameter of Coriolis. One that is the same everywhere needs no turn.
/// \param factor its coriolis_factor().
void add_coriolis(const std::string& name, std::span<const double> values, double factor,
                  TurnedFields& fields);

} // namespace calotte::io_detail
