// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/topics.h"

namespace calotte::tools {
namespace {

constexpr const char* density =
    R"(The widths of the cells follow from a density, or are given in km.

--density uniform (default) makes cells of one size. A bump makes them finer in one place:

  --density tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8

The density is about 1 within the angle beta of the centre and gamma far from it. The width of a
cell is proportional to density^(-1/4).

  lon, lat   centre in degrees
  beta       radius of the bump, > 0: radians, or degrees as 30deg
  alpha      width of the transition around it, > 0: radians, or degrees as 10deg
  gamma      density far away, between 0 and 1; or x8: cells 8 times wider there
  stretch    makes an ellipse: ratio of its axes, >= 1; with azimuth
  azimuth    direction of the long axis in degrees clockwise from north; with stretch

In the plane: tanh:x=3,y=4,beta=1.5,alpha=0.5,gamma=x8, with lengths in the unit of the domain. An
ellipse there has stretch=2,angle=45, with the angle in degrees counter-clockwise from x.

--density may be repeated; --join combines the bumps: maximum (default) or sum.

Instead of --density:

  --cell-width 60km          one width; 163842 cells are 60 km wide on the Earth
  --cell-width FILE          widths in km: NetCDF cellWidth(lat, lon), JIGSAW .msh, or .geojson
  --density-raster FILE      NetCDF density(lat, lon), in the plane density(y, x)

calotte plan describes the grid that a density or widths lead to; calotte draw shows them on a map.
)";

constexpr const char* codes =
    R"(Results go to standard output, messages to standard error. Exit codes:
  0  success
  1  the mesh failed its check, or the run did not converge (the mesh is written)
  2  invalid options or input
  3  a file cannot be opened, read or written
  4  internal error
  130, 143  stopped by SIGINT or SIGTERM; --resume continues a run with --checkpoint
)";

} // namespace

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all{
      {"density", "Syntax of --density, and of widths in km", density},
      {"exit-codes", "Meaning of the exit codes", codes}};
  return all;
}

std::string exit_codes() { return codes; }

} // namespace calotte::tools
