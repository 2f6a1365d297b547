// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/demanded_spacing.h"
#include "domain/arcs.h"
#include "exact/space.h"
#include "generators/room.h"

#include <cstddef>
#include <vector>

namespace calotte::generators_detail {

/// The shorter arc between two unit vectors, or in the plane the straight line between two points.
using Segment = Arc;

/// A curve of segments, measured in the edges between neighbours that a density demands along it.
template <Space S> class Curve {
public:
  /// \param spacing must outlive this.
  /// \param longest maximum step of the measurement, in the unit of the space.
  /// \param segments one or more, each beginning where the one before ends. \param closed whether
  ///        the last ends where the first begins.
  Curve(const DemandedSpacing& spacing, double longest, std::vector<Segment> segments, bool closed);

  const std::vector<Segment>& segments() const { return segments_; }
  bool is_closed() const { return closed_; }
  double edges() const { return marks_.back().edges; } ///< of the whole

  struct Position {
    Vec3 at;
    std::size_t segment;
  };
  /// The position after a number of edges, from 0 to edges().
  Position position(double edges) const;

  /// The positions of generators in numbers of edges, ascending. Generators are at the kept
  /// corners, and between two of these at equal distances: `dense` ones from 5/8 to 5/4 edges,
  /// others from 2/3 to 5/3. A corner where the curve turns by 20 degrees or more is kept, unless a
  /// corner of higher priority is nearer than two thirds of an edge; the ends of an open curve have
  /// the highest priority, then sharper corners. A closed curve has three or more generators.
  std::vector<double> stops(bool dense) const;

private:
  /// A position by the number of edges from the start.
  struct Mark {
    double edges;
    std::size_t segment;
    double along; ///< from the segment's start
  };

  void measure(std::size_t segment, double longest);
  double rate_at(std::size_t segment, double along) const;
  std::vector<double> kept_corners() const;

  const DemandedSpacing& spacing_;
  std::vector<Segment> segments_;
  bool closed_;
  std::vector<Mark> marks_;           ///< a tenth of an edge apart; the last mark is the end
  std::vector<double> corners_ = {0}; ///< edges at the starts of segments, and at the end
};

/// The maximum step of the measurement of curves on a surface: a share of its extent.
template <Space S> double longest_step(const Surface& surface);

extern template class Curve<Sphere>;
extern template class Curve<Plane>;
extern template double longest_step<Sphere>(const Surface& surface);
extern template double longest_step<Plane>(const Surface& surface);

} // namespace calotte::generators_detail
