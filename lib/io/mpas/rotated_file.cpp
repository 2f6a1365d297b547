// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/rotate.h>

#include "base/require.h"
#include "io/cells/field_order.h"
#include "io/mpas/turned_fields.h"

#include <calotte/voronoi.h>

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using Kind = FieldTurn::Kind;

/// The points of a file that fields belong to, before the rotation.
class FieldPoints {
public:
  explicit FieldPoints(const MeshFile& file) : file_(file) {}

  /// The points of a field; null where they are not known.
  const Points3* of(const MeshField& field) {
    const std::optional<Polygons>& polygons = file_.polygons;
    if (field.location == FieldLocation::cells) {
      if (file_.mesh && has_values_for(field, file_.mesh->points.cols()))
        return &file_.mesh->points;
      return polygons && has_values_for(field, polygons->centres.cols()) ? &polygons->centres
                                                                         : nullptr;
    }
    const bool at_vertices = field.location == FieldLocation::vertices;
    if (at_vertices && polygons && has_values_for(field, polygons->corners.cols()))
      return &polygons->corners;
    if (!file_.mesh || !file_.mesh->closed())
      return nullptr;
    if (!voronoi_)
      voronoi_ = voronoi(*file_.mesh);
    const Points3& points = at_vertices ? voronoi_->vertices : voronoi_->edges;
    return has_values_for(field, points.cols()) ? &points : nullptr;
  }

private:
  const MeshFile& file_;
  std::optional<Voronoi> voronoi_;
};

std::string text_of(const MeshField& field, const std::string& name) {
  for (const auto& [key, text] : field.attributes)
    if (key == name)
      return text;
  return "";
}

FieldTraits traits_of(const MeshField& field) {
  constexpr const char* locations[] = {"cells", "edges", "vertices"};
  FieldTraits traits{field.name,
                     field.long_name,
                     text_of(field, "standard_name"),
                     {locations[static_cast<int>(field.location)]},
                     field.dimensions.empty() ? 0 : field.dimensions.back().size,
                     !field.integer,
                     field.directed};
  for (const FieldDimension& dimension : field.dimensions)
    traits.dimensions.push_back(dimension.name);
  return traits;
}

bool are_finite(const std::vector<const DoubleVector*>& parts, Eigen::Index at) {
  for (const DoubleVector* const part : parts)
    if (!std::isfinite((*part)[at]))
      return false;
  return true;
}

/// Turns components of vectors, each in a field of its own.
void turn_components(const FieldTurn& turn, const Points3* points, const Rotation& rotation,
                     const std::vector<MeshField>& old, std::vector<MeshField>& fields) {
  std::vector<const DoubleVector*> parts;
  for (const std::size_t part : turn.parts)
    parts.push_back(&old[part].values);
  const std::int64_t width = old[turn.parts.front()].count();
  SiteTurn by;
  for (Eigen::Index at = 0; at < parts.front()->size(); ++at) {
    if (points != nullptr && at % width == 0) {
      const Eigen::Vector3d from = points->col(at / width);
      by = turn_at(from, rotation(from), rotation);
      by = turn.kind == Kind::twice ? by.twice() : by;
    }
    if (!are_finite(parts, at))
      continue;
    const double x = (*parts[0])[at], y = (*parts[1])[at];
    if (turn.kind == Kind::components) {
      const Eigen::Vector3d now = rotation(Eigen::Vector3d(x, y, (*parts[2])[at]));
      for (std::size_t k = 0; k < 3; ++k)
        fields[turn.parts[k]].values[at] = now[static_cast<Eigen::Index>(k)];
    } else {
      const std::array<double, 2> now = by.of(x, y);
      for (std::size_t k = 0; k < 2; ++k)
        fields[turn.parts[k]].values[at] = now[k];
    }
  }
}

void turn_coriolis(const Points3& points, const Rotation& rotation, MeshField& field,
                   TurnedFields& report) {
  std::vector<double> sines;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    sines.push_back(sine_of_latitude(points.col(i)));
  const std::span<const double> values(field.values.data(), sines.size());
  const double factor = coriolis_factor(values, sines);
  add_coriolis(field.name, values, factor, report);
  for (Eigen::Index i = 0; factor != 0 && i < points.cols(); ++i)
    field.values[i] = factor * sine_of_latitude(rotation(Eigen::Vector3d(points.col(i))));
}

TurnedFields turn_fields(const MeshFile& file, const Rotation& rotation,
                         std::vector<MeshField>& fields) {
  std::vector<FieldTraits> traits;
  for (const MeshField& field : file.fields)
    traits.push_back(traits_of(field));
  std::vector<FieldTurn> turns = find_turns(traits);
  FieldPoints points(file);
  TurnedFields report;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    FieldTurn& turn = turns[i];
    const bool needs_points =
        turn.kind == Kind::east_north || turn.kind == Kind::twice || turn.kind == Kind::coriolis;
    const Points3* const at = needs_points ? points.of(file.fields[i]) : nullptr;
    if (needs_points && at == nullptr)
      turn.kind = Kind::unknown;
    if (turn.kind == Kind::vectors)
      for (Eigen::Index k = 0; k + 2 < fields[i].values.size(); k += 3)
        fields[i].values.segment<3>(k) = turned(fields[i].values.segment<3>(k), rotation);
    else if (turn.kind == Kind::coriolis)
      turn_coriolis(*at, rotation, fields[i], report);
    else if (turn.kind != Kind::unknown && !turn.parts.empty() && turn.part == 0)
      turn_components(turn, at, rotation, file.fields, fields);
    add_name(fields[i].name, turn, report);
  }
  return report;
}

} // namespace
} // namespace io_detail

RotatedFile rotated(MeshFile file, const Rotation& rotation) {
  base_detail::require(
      file.surface().is_sphere(),
      "the mesh is one of a plane, but a rotation moves points of the sphere; give "
      "a mesh of the sphere");
  RotatedFile out;
  if (rotation.is_identity()) {
    out.file = std::move(file);
    return out;
  }
  std::vector<MeshField> fields = file.fields;
  out.fields = io_detail::turn_fields(file, rotation, fields);
  out.file = std::move(file);
  out.file.fields = std::move(fields);
  if (out.file.mesh)
    out.file.mesh = rotated(std::move(*out.file.mesh), rotation);
  if (out.file.polygons) {
    Polygons& polygons = *out.file.polygons;
    polygons.corners = rotation(polygons.corners);
    polygons.centres = rotation(polygons.centres);
  }
  return out;
}

} // namespace calotte
