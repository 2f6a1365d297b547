// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/topics.h"

#include "text/jigsaw_options.h"
#include "text/text.h"

#include <calotte/write.h>

#include <iomanip>
#include <sstream>

namespace calotte::tools {
namespace {

constexpr const char* density =
    R"(The widths of the cells follow from a density, or are given in km.

--density uniform (default) makes cells of one size. A bump makes them finer in one place:

  --density tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8

--density x8 is short for it, and x4 or x16 for other contrasts. The density is about 1 within the
angle beta of the centre and gamma far from it. The width of a cell is proportional to
density^(-1/4).

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
  --cell-width FILE          widths in km: NetCDF cellWidth(lat, lon), JIGSAW .msh, .geojson, or
                             rules (.toml), see calotte help widths
  --density-raster FILE      NetCDF density(lat, lon), in the plane density(y, x), or there a
                             picture (.png): generators are as dense as it is dark

calotte plan describes the grid that a density or widths lead to; calotte draw shows them on a map.
)";

constexpr const char* widths =
    R"(--cell-width FILE.toml reads rules for the width of cells, in km on the Earth, or on the sphere of
--earth-radius. The file has one table:

  [cell-width]
  gradient = 0.03
  minimum = [
    { by-latitude = [[-90, 35], [-30, 60], [0, 30], [30, 60], [90, 35]] },
    { by-distance = "coast.geojson", near = 10, far = 60, over = 600 },
    { around = "straits.geojson", width = 5, over = 200 },
  ]

A rule has one of these keys, which says what it is, and the keys after it:

  width = KM              one width
  by-latitude = [[DEGREES, KM], ...]   by latitude; smooth
  by-distance = FILE      by the distance from the nearest line, side or point of a file: near and
                          far, the widths at 0 and from the distance `over` on; or
                          profile = [[KM, WIDTH], ...]; smooth. Of polygons or a coast also
                          side = "sea" or "land": on the other side the rule says nothing. In a
                          profile with negative distances, these are on land. Islands and lakes
                          smaller than least-area, in km^2, do not count
  around = FILE           `width` up to the distance `over`; beyond it the rule says nothing
  by-channel = FILE       at least `cells` cells across the channels and straits of a coast, up to
                          `widest`, default 500 km, but no cell below `least`; elsewhere the rule
                          says nothing; least-area as for by-distance
  by-depth = FILE         by the depth of the sea, from NetCDF heights(lat, lon) in metres, of
                          `variable`, if it has several: period = "12.42h" and cells, the number
                          of cells in the length of a wave; or rossby = CELLS in a Rossby radius; or
                          slope = CELLS in 2 pi depth / slope; and `least`, the width at the shore
  raster = FILE           widths of a NetCDF raster, of `variable`, if it has several and none is
                          cellWidth; or of JIGSAW's .msh
  polygons = FILE         of GeoJSON: inside, outside, transition, as the options of that name
  minimum = [RULES]       the least of several; a number is a rule, too; maximum, sum likewise
  blend = [A, B]          (1 - t) A + t B, with the share t of B from 0 to 1 in share: a file of NetCDF
                          t(lat, lon), of `variable`, if it has several; or a REGION, in which t is
                          1. Outside, t falls to 0 at the distance `over`; or profile = [[KM, T],
                          ...] from its boundary, negative inside; smooth. With either it may be a
                          coast: t is 1 on land; least-area as for by-distance

Any rule takes also, in this order:

  times = FACTOR          of the widths
  least = KM, most = KM   limits of the widths
  within = REGION         see calotte help region, or a file of NetCDF t(lat, lon) from 0 to 1;
                          outside it, or where t is below 1/2, the rule says nothing
  gradient = G            the largest widths that are nowhere above the rule's and change by at most
                          G km per km, such as 0.03: grids of steep widths have bad cells

  smooth = true           between two numbers along a cubic that is level at both, not along a line
  step = DEGREES          of the raster of calotte plan --raster, in the table [cell-width]; default:
                          the least width, within 0.05 to 1

A FILE of lines is GeoJSON of lines or of polygons, a coast of GSHHG (.nc), or points (.txt):
longitude and latitude a line. Names are relative to the folder of the TOML file. Distances are along
great circles.

In a plane lengths are in its unit, files are of x and y, and distances straight. The rules width,
by-distance, around, raster, minimum, maximum, sum and blend apply; a region is a file of --domain,
and step is a length. The gradient of all rules is limited in the domain, round its islands.
)";

constexpr const char* region =
    R"(A region is a part of the sphere. It is given as a shape or as a file.

  circle=LON,LAT,RADIUS                 a circle around a centre: circle=-105,40,1000km
  ellipse=LON,LAT,MAJOR,MINOR,BEARING   semi-axes; the bearing of the major axis in degrees
                                        clockwise from north: ellipse=138,38,1580km,1000km,45
  box=WEST,SOUTH,EAST,NORTH             between meridians and parallels, eastward from WEST to EAST:
                                        box=-20,30,40,60; over the date line: box=170,-20,-170,0;
                                        up to the pole: box=-20,60,40,90
  channel=LOWER,UPPER                   the band between two latitudes: channel=-23.5,23.5
  land=FILE,LON,LAT                     the island or continent that contains a place, from a file
                                        as calotte cull --land reads it:
                                        land=/usr/share/gmt-gshhg/binned_GSHHS_l.nc,134,-25

Longitudes and latitudes are in degrees; west and south are negative. RADIUS, MAJOR and MINOR have a
unit: km or m on the Earth, or deg. Circles, ellipses and channels become polygons of 360 corners. The
parallels of a box have so many that it errs by less than a thousandth of a cell.

Files:

  .geojson, .json   Polygon and MultiPolygon geometries in longitude and latitude
  .shp              the polygons of a shapefile, with .shx beside it
  .pts              point files of MPAS-Limited-Area: custom, circle, ellipse and channel

An edge of a polygon is the shorter arc of a great circle between two corners. Give corners along a
parallel: the arc from 130 W to 65 W at 50 N passes 4.7 degrees north of the parallel. Polygons may
lie over the date line and around a pole.

Rings may run either way. They enclose the side without poles, as on a map of longitudes and
latitudes; if both sides have a pole, the smaller side. A ring may reach a pole along a meridian and
return along it. A place inside overrules this: --inside LON,LAT for all rings, or the property of a
GeoJSON feature for its own:

  "properties": {"inside": [-100, 40]}

In a .pts file the line Point: is a place inside. The same rule holds for the polygons of --land and
--cell-width.

The boundary clips the cells along it (--boundary clip). Files of cells have the clipped cells, with
edges along the boundary; those of triangles the triangles whose circumcentre lies in the region.
With --boundary generators some generators stay on the boundary, at the distances that the density
demands, with one at each sharp corner. The mesh then ends at them.
)";

constexpr const char* measures =
    R"(calotte info, and calotte view for each cell, measure a mesh by these words. dc is the distance
between the generators of two neighbours, dv the length of the side that their cells share, and h
the spacing that the density demands of so many cells.

Cells and triangles:
  degree: cells         numbers of neighbours, and how many cells have each
  spacing               dc; of a cell, the mean over its neighbours
  triangle quality      2 times the radius of the inner circle over that of the outer; best 1
  angles                of the triangles
  obtuse triangles      with an angle above 90 degrees; MPAS and other C-grid models need none
  sigma                 dc to the nearest neighbour over dc to the farthest; best 1
  cell quality          shortest side of a cell over its longest; best 1
  cell area             of each cell
  area ratio            area of the largest cell over that of the smallest
  off-centring          distance from the middle of a side to that between its two generators, over
                        dv; best 0; above 0.5 the line between them misses the side
  dv / dc               0.577 for regular hexagons
  dv / dc below 0.18    number of sides so short that models object to them
  dc / h                how dc follows the density; best 1
  outside 0.75 to 1.4   number of pairs of neighbours with such a dc / h
  cells to object to    cells with a side or a neighbour of the two rows named before, or with a
                        corner that is the centre of an obtuse triangle
  their spacing         mean dc of each of these cells
  cells / 4 pi          sum of their areas over that of the sphere; 1 but for rounding. The same:
                        triangles / 4 pi, and of a plane cells / domain

Distance from a CVT:
  density               the one that h and the rows below refer to
  residual / h          root mean square distance of generators to their cells' centroids; best 0
  energy                integral of density times squared distance to the nearest generator
  energy * cells        nearly the same for any number of cells; of a plane over its squared area
  its limit             of regular hexagons everywhere; no CVT of many cells has less
  excess                of the energy over its limit

Open meshes and other cells:
  boundary edges        sides of triangles without a neighbour; boundary loops: closed lines of them
  whole cells           those that triangles surround
  in the region         cells of a limited area; relaxation, specified: of its two outer zones
  bdyMaskCell: cells    the values of this variable, and how many cells have each
  corners               of polygons; sides: cells: how many cells have each number of sides
  not convex            cells with a corner that turns inwards
  not centroidal        cells with their centre off the centroid
  not Delaunay          edges that are not

With --operators, for smooth fields, over the root mean square of the exact values:
  errors of operators   l2 (root mean square) and greatest error of divergence, gradient,
                        Laplacian, curl, tangential velocity and kinetic energy, as TRiSK has them
  off centroid          distance of a generator from the centroid of its cell, over its spacing
  off midpoint          distance from the middle of a side to that between its generators, over dc
  longest stable step   times the speed of waves, or times a viscosity

With --for MODEL, the demands of the model on grids; calotte check fails where one is not met:
  sides of a cell       5 at least, as cells with 4 have ended forecasts
  change of width       from a cell to the next, of widths smoothed over some neighbours; limit
                        0.1225, so that they double within six cells or more
  cells that advect     the two cells of an edge and their neighbours; MPAS-Atmosphere stores 15
  dv / unit of float32  in the distance of numbers of 32 bits on the planet, half a metre on the
                        Earth; from 100 on rounding changes an edge by 2% at most
  rings out of order    cells of a limited area beside a ring that is not the next
  longest step, s       of flow 0.9 dc over 125 m/s; of waves, sound or gravity waves of the
                        deepest sea, at most the longest stable step that --operators measures

Of one cell also:
  neighbours, sides     their number
  largest angle         of the triangles at the cell
  distance to the centroid   of the generator, over the spacing
  least dc/h, greatest dc/h  over the neighbours
  prescribed spacing    h
)";

constexpr const char* codes =
    R"(Results go to standard output, messages to standard error. Exit codes:
  0  success
  1  the mesh failed its check, the run did not converge, or widths or parts fall short (written)
  2  invalid options or input
  3  a file cannot be opened, read or written
  4  not enough memory or threads, or an internal error
  5  the run converged, but the mesh is not well-centred, or is beyond the limits of the model
     that --for names (it is written)
  130, 143  stopped by SIGINT or SIGTERM; a line says how --resume continues the run
)";

/// Lists the formats of the library's table.
std::string formats_text() {
  std::ostringstream out;
  out << "The name of a file selects its format, --format another one that has that name. Of "
         "several, the\n"
         "first is meant. A NetCDF file is read by its content.\n\n";
  const auto line = [&](const std::string& title, const std::string& word, const std::string& names,
                        const std::string& read, const std::string& written) {
    out << std::left << std::setw(40) << title << std::setw(17) << word << std::setw(14) << names
        << std::setw(13) << read << written << "\n";
  };
  line("format", "--format", "name", "read", "written");
  for (const FormatInfo& info : formats()) {
    line(info.title, info.word, listed(info.names),
         !info.read    ? "no"
         : info.points ? "yes"
                       : "with points",
         info.word.empty() ? "no" : "yes");
  }
  return out.str();
}

} // namespace

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all{
      {"formats", "Formats of mesh files, and their names", formats_text()},
      {"density", "Syntax of --density, and of widths in km", density},
      {"widths", "Rules for widths in km, in a TOML file", widths},
      {"region", "Syntax of --region: shapes and files", region},
      {"measures", "Meaning of what info and view measure", measures},
      {"jig", "Options of JIGSAW, and what is made of each", jigsaw_options()},
      {"exit-codes", "Meaning of the exit codes", codes}};
  return all;
}

std::string exit_codes() { return codes; }

} // namespace calotte::tools
