// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "peers.h"

#include <CLI/CLI.hpp>

#include <string>

namespace calotte::bench {

/// The paths of peers that no package holds; empty where the user has none.
struct BuiltPeers {
  std::string pbbs, geogram;
};

void add_pbbs_option(CLI::App& app, BuiltPeers& peers);
void add_geogram_option(CLI::App& app, BuiltPeers& peers);

/// The functions below run a program once on a file of the points; of its clock are the seconds of
/// the triangulation, of its output the triangles. A program that fails, or prints something else,
/// ends in a failure of the outcome.

/// PBBS' incremental Delaunay triangulation of the plane (Blelloch, Gu, Shun, Sun, J. ACM 67(4),
/// 2020), `delaunay`, warm: it repeats the triangulation for a second first. It adds ten vertices
/// around the points and never removes them, so that triangles at the hull are missing; those that
/// have only the points for corners are triangles of the Delaunay triangulation.
Outcome run_pbbs(const std::string& program, const Points2& points, int threads);

/// geogram's `compute_delaunay` with algorithm BDEL2d, which is serial.
Outcome run_geogram(const std::string& program, const Points2& points);

/// On the sphere the hull of geogram's tetrahedra between the points and the centre: BDEL on one
/// thread, otherwise PDEL on all cores. Its triangles come in any orientation and are turned
/// counter-clockwise seen from outside.
Outcome run_geogram(const std::string& program, const Points3& points, int threads);

} // namespace calotte::bench
