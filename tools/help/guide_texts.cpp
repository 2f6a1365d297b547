// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/guides.h"

namespace calotte::tools {
namespace {

constexpr const char* ocean = R"(An ocean grid: make a grid of the Earth, then leave the land out.

  calotte cvt --cell-width 120km --for mpas-ocean -o earth.nc
  calotte cull earth.nc --land coast.geojson --passage straits.geojson -o ocean.nc
  calotte cull earth.nc --raster bathymetry.nc -o ocean.nc

--land takes polygons or a file of GSHHG, --raster heights or fractions. --least-area leaves small
islands and lakes out. cull prints the largest seas that are not connected: --passage opens
straits to them, --barrier closes land, --seed LON,LAT keeps a sea. --topography writes the sea
floor, --land-mesh the other cells; --sea-ice-latitude 43 lets ice move. Widths by the distance from
a coast: calotte help widths. The region of a sea that ends at its coast: calotte coast.
)";

constexpr const char* straits = R"(Straits stay open, and land stays closed, by lines of GeoJSON.

  calotte cull earth.nc --land coast.geojson --passage passages.geojson -o ocean.nc
  calotte cull earth.nc --land coast.geojson --barrier barriers.geojson -o ocean.nc

tools/examples has the usual passages and barriers of the world: passages.geojson and
barriers.geojson. Narrow cells in straits: the rules by-channel and around of calotte help widths.
)";

constexpr const char* limited_area =
    R"(A part of the sphere, for a regional model, with rings of boundary cells; or cut from a global
grid.

  calotte cvt --region box=-20,30,40,60 --cell-width 60km --limited-area -o europe.nc
  calotte cvt --region area.geojson --cells 5000 -o area.vtp
  calotte cut global.nc --region circle=-105,40,1000km -o region.nc

Shapes and files of regions: calotte help region.
)";

constexpr const char* models = R"(Files that a model reads: --for names the model.

  calotte cvt --cell-width 60km --for mpas-atmosphere -o earth.nc
  calotte cvt --cell-width 120km --for mpas-ocean -o earth.nc
  calotte convert mesh.nc nod2d.out --for fesom
  calotte cvt --region sea.geojson --boundary generators --cell-width 60km -o hgrid.gr3
  calotte partition earth.nc --parts 64

--for takes mpas-atmosphere, mpas-ocean, mpas-sw and fesom. Other models: calotte help formats.
)";

constexpr const char* cell_width =
    R"(How wide cells are: one number of km, a file, or rules. Without --cells the widths give their
number.

  calotte cvt --cell-width 60km -o earth.nc
  calotte plan --cell-width widths.nc
  calotte cvt --cell-width rules.toml --gradient 0.03 -o earth.nc
  calotte cvt --cell-width polygons.geojson --outside-width 120 --transition 4000 -o earth.nc

Rules by coasts, straits, depths and latitudes: calotte help widths. Bumps without km: calotte
help density.
)";

constexpr const char* gradient =
    R"(The gradient of widths: their largest change, km per km. Most models need 0.03 or less.

  calotte plan --cell-width widths.nc --gradient 0.03
  calotte cvt --cell-width widths.nc --gradient 0.03 -o earth.nc
  calotte refine earth.nc --region circle=10,50,900km --factor 2 --gradient 0.05 -o finer.nc

--gradient makes widths narrower around narrow ones, never wider. Of polygons a longer
--transition does the same. calotte plan and calotte cvt print the largest gradient, and where it
is.
)";

constexpr const char* units = R"(Units of options and files.

  widths, distances      km, also written 60km or 60000m; in rules and GeoJSON km; in NetCDF km or
                         m, by the attribute units; in a plane the unit of its coordinates
  longitude, latitude    degrees, longitude first; west and south are negative
  radius of a region     with its unit: 1000km, 1000000m or 30deg
  --sphere-radius        metres, or earth: the radius of the sphere in NetCDF files
  --earth-radius         km: the sphere that widths in km refer to
  gradient               km per km, such as 0.03
  heights                m or km, by the attribute units; below 0 is sea
  areas of islands       km^2 (cull --least-area, and least-area of rules)

--units of plan, cvt, info, view and draw chooses km, degrees or radians of what they print and
show, but for reports. Gradients are the same in each unit.
)";

constexpr const char* depth =
    R"(Heights and depths of the sea: NetCDF rasters of latitude and longitude such as GEBCO's or
ETOPO's.

  calotte cull earth.nc --raster bathymetry.nc -o ocean.nc
  calotte interpolate bathymetry.nc ocean.nc -o depth.nc
  calotte convert ocean.nc nod2d.out --for fesom --depth-levels 0,10,30,100,1000 --depth 4000
  calotte convert sea.vtp hgrid.gr3 --depth bathymetry.nc --open box=-20,30,-15,60

Heights are metres or km upwards, and below 0 is sea; the attribute positive = "down" tells
depths. Widths by depth are the rule by-depth: calotte help widths.
)";

constexpr const char* rasters =
    R"(NetCDF rasters of latitude and longitude, in degrees, of any order.

  calotte cvt --cell-width widths.nc -o earth.nc             cellWidth(lat, lon), or the only one
  calotte cvt --density-raster density.nc --cells 40962 -o earth.nc
  calotte cull earth.nc --raster bathymetry.nc -o ocean.nc   heights; fractions: --raster-values
  calotte interpolate earth.nc 720x360 -o map.nc             from a mesh to a raster, or back
  calotte plan --cell-width rules.toml --raster widths.nc    writes rules as a raster

Images: gdalwarp -t_srs EPSG:4326 -of netCDF heights.tif heights.nc; GRIB: CDO or GDAL.
)";

constexpr const char* polygons =
    R"(Polygons and lines are GeoJSON or shapefiles in degrees; GDAL converts KML and projections.

  ogr2ogr -t_srs EPSG:4326 area.geojson area.shp
  calotte cvt --region area.geojson --cells 5000 -o area.vtp
  calotte cvt --cell-width area.geojson --inside-width 60 --outside-width 120 --transition 4000 \
    -o earth.nc
  calotte cull earth.nc --land area.geojson --passage lines.geojson -o ocean.nc
  calotte cvt --cell-width 150km --fixed rivers.geojson -o earth.nc

Rings may run either way; see calotte help region.
)";

constexpr const char* python =
    R"(The Python package calotte has the same functions and words as the command.

  pip install calotte-*.whl

  import calotte
  grid = calotte.cvt(cell_width="120km")
  grid.mesh.to_mpas("earth.nc")

There are also libraries for C++, C and Fortran.
)";

constexpr const char* multimesh =
    R"(Nested nodes and edges for graph networks, in Python and C++.

  import calotte
  mesh = calotte.multimesh(6)           # of an icosahedron; with cell_width= by widths
  edges = mesh.edges()                  # 2 x m, of all levels, as graph packages take them
)";

constexpr const char* install =
    R"(A wheel for Python, a folder, Debian packages, an image, or the sources.

  pip install calotte-*.whl
  tar xf calotte-*-linux-x86_64.tar.gz
  tools/quickstart

The last one builds a clone on Debian 12. calotte version prints the version.
)";

constexpr const char* threads =
    R"(Commands use all processors; --threads N uses fewer. The result has the same bits.

  calotte cvt --cell-width 60km --threads 8 -o earth.nc
  calotte plan --cell-width 60km

plan estimates time and memory. There is no MPI: one machine makes the grid, and calotte partition
divides it for the processes of a model.
)";

constexpr const char* resume =
    R"(A long run saves its state, and another command goes on from it, to the same bits.

  calotte cvt --cell-width 15km --checkpoint run.state -o earth.nc
  calotte cvt --resume run.state -o earth.nc

Control-C ends a run after its iteration, and a line says at once what it still writes: the mesh as
it is, and the state to the file of --checkpoint, or else to the one of --resume, or else to
earth.nc.checkpoint. The file stays when the run ends: remove it. Control-C again, after a second,
ends it at once, without a mesh.
)";

constexpr const char* examples = R"(A first grid, its check, its measures and a picture.

  calotte cvt --cell-width 120km -o earth.nc
  calotte check earth.nc
  calotte info earth.nc
  calotte draw earth.nc -o earth.png --what cells
  calotte view earth.nc --open

Files of options and of widths are in tools/examples; calotte cvt --config FILE reads those of
options.
)";

constexpr const char* plane =
    R"(Grids of the plane: a rectangle, polygons, a periodic box, or regular hexagons.

  calotte cvt --rectangle 0,0,2000,1000 --cells 5000 -o channel.vtp
  calotte cvt --domain lake.geojson --cells 4000 -o lake.vtp
  calotte cvt --hexagons 16,50,10000 --walls y -o channel.nc
  calotte delaunay points.txt --plane -o mesh.vtp
)";

constexpr const char* pictures = R"(Pictures of grids, as files or as a page for a browser.

  calotte draw earth.nc -o earth.png --what cells --view 285,38 --colour spacing
  calotte view earth.nc --open
  calotte cvt --density-raster face.png --cells 5000 --stop tolerance --tolerance 0.01 -o face.vtp
  calotte draw face.vtp --what points -o face.svg
  calotte plan --cell-width rules.toml -o plan.png

ParaView reads .vtu and .vtp: calotte convert earth.nc earth.vtu
)";

constexpr const char* quality =
    R"(Is a grid good? check proves it, info measures it, view shows its worst cells.

  calotte check earth.nc
  calotte info earth.nc --operators
  calotte view earth.nc --open

The words that info prints: calotte help measures.
)";

constexpr const char* parts = R"(Parts of a grid for the processes of a model, by METIS.

  calotte partition ocean.nc --parts 16 32 64

It writes graph.info.part.N. There is a NAME.graph.info beside each MPAS file for gpmetis, too.
)";

constexpr const char* remap = R"(Fields from one grid to another, and weights for other programs.

  calotte interpolate old.nc new.nc --fields t2m -o fields.nc
  calotte interpolate old.nc 720x360 --weights map.nc

Methods: conservative, linear, nearest, natural.
)";

constexpr const char* formats_guide =
    R"(Files of meshes: their names select the format, or --format does.

  calotte convert earth.nc grid.nc --format scrip
  calotte convert earth.nc earth.vtu

All formats: calotte help formats.
)";

constexpr const char* jigsaw = R"(JIGSAW's files are read and written, and its programs replaced.

  calotte jigsaw mesh.jig
  calotte marche mesh.jig
  calotte cvt --cell-width spacing.msh -o earth.nc

Its options: calotte help jig.
)";

constexpr const char* local =
    R"(Finer or coarser cells in a part of a grid; all others keep their bits.

  calotte refine earth.nc --region circle=10,50,900km --factor 2 -o finer.nc
  calotte coarsen earth.nc --region circle=150,10,3000km --factor 1.5 -o coarser.nc
)";

constexpr const char* rotation =
    R"(A grid rotated to where it is needed, with its fields; ids and areas stay.

  calotte rotate fine.nc --from 0,0 --to -105,40 -o rockies.nc

What turns of fields, and what must be made anew, the command says.
)";

constexpr const char* algorithms = R"(Triangulations and tessellations of points.

  calotte points random 100000 -o points.txt
  calotte delaunay points.txt -o mesh.vtp
  calotte cvt points.txt --method lloyd -o cvt.vtp
  calotte convert cvt.vtp cvt.nc

A mesh has the triangles; a .nc file has the Voronoi cells, too.
)";

constexpr const char* options = R"(Options in a file, by their long names: TOML.

  calotte cvt --config run.toml

  cell_width = "60km"
  output = "earth.nc"

The command line takes precedence. Files that are read are relative to the TOML file, files that
are written to the current folder. Examples are in tools/examples; rules of widths are another file:
calotte help widths.
)";

constexpr const char* converging = R"(When a run ends, and what its exit code says.

  calotte cvt --cells 40962 --tolerance 1e-4 --max-iterations 2000 -o earth.nc
  calotte cvt --cells 40962 --iterations 50 -o earth.nc
  calotte draw --history report.json -o convergence.png       of a run with --report report.json

Exit code 1: not converged; 5: converged, but some shapes are beyond the limits of models, or the
grid is beyond the demands of the model that --for names. The grid is written.
)";

constexpr const char* lattices = R"(Regular points and grids.

  calotte cvt --cells 40962 -o earth.nc              12 cells of 5 neighbours, all others of 6
  calotte cvt --cells 40962 --start icosahedron -o bisected.nc
  calotte points fibonacci 1000 -o points.txt

calotte points writes random, fibonacci, spiral, icosahedron and other points: calotte points
--help.
)";

constexpr const char* about =
    R"(Calotte's licence is GPL-3.0-or-later. CITATION.cff of the sources says how to cite it.

  calotte version
  calotte help
)";

constexpr const char* trouble = R"(A message is one line: what is wrong, where, and the remedy.

  calotte help exit-codes

A run that does not converge, or misses shapes or widths, writes its grid and says so in its exit
code.
)";

constexpr const char* sphere =
    R"(The radius of the sphere: of a file, and of the planet that widths refer to.

  calotte cvt --cell-width 120km --earth-radius 3389.5 --sphere-radius 3389500 -o mars.nc

MPAS-Ocean's files are in metres, MPAS-Atmosphere's on the unit sphere: --for chooses.
)";

} // namespace

const std::vector<Guide>& guides() {
  static const std::vector<Guide> all{
      {"ocean sea land coastline shore coastal mask land-mask marine culling island lake "
       "gshhg "
       "mpas-ocean mpaso mpas-o",
       ocean, "oceans.md coasts.md"},
      {"straits strait passage channel gibraltar bosphorus barrier blockage transect connectivity "
       "red-sea",
       straits, "oceans.md coasts.md cell-widths.md"},
      {"limited-area regional limited lam area region-file nest nesting boundary shape box circle "
       "subdomain "
       "relaxation lbc",
       limited_area, "limited-area.md"},
      {"models model mpas mpas-atmosphere mpas-a mpasa mpas-sw fesom fesom2 atmosphere weather "
       "climate for",
       models, "models.md"},
      {"cell-width width-file resolution size spacing width cellwidth variable-resolution "
       "refinement km "
       "hfun mesh-spacing tile cell",
       cell_width, "cell-widths.md"},
      {"gradient grading steep steepness slope transition smooth smoothness", gradient,
       "cell-widths.md"},
      {"units unit metre meter degree kilometre kilometer radian", units,
       "cell-widths.md measures.md"},
      {"bathymetry depth topography height gebco etopo orography elevation", depth,
       "coasts.md oceans.md cell-widths.md"},
      {"raster netcdf nc xarray-file lat-lon latlon geotiff grib", rasters,
       "cell-widths.md interpolation.md"},
      {"shapefile polygon geojson shp kml line river gis gdal", polygons,
       "cell-widths.md limited-area.md"},
      {"python numpy xarray scipy notebook jupyter c++ cpp c fortran api library", python,
       "python.md python-reference.md cplusplus.md c-and-fortran.md"},
      {"install installation pip wheel conda debian docker build compile package update", install,
       "install.md"},
      {"threads thread parallel reproducible bit openmp mpi core cpu gpu memory speed performance "
       "time",
       threads, "performance.md"},
      {"resume checkpoint restart interrupt interrupted kill continue", resume, "first-grid.md"},
      {"examples example tutorial start quickstart first getting-started usage howto how-to new "
       "grid mesh earth "
       "global",
       examples, "first-grid.md"},
      {"plane planar periodic rectangle cartesian hexagon hex flat domain", plane, "plane.md"},
      {"picture plot figure image html png paraview visualise visualize visualisation browser "
       "stippling stipple dots",
       pictures, "first-grid.md browser.md stippling.md"},
      {"quality measure check-mesh obtuse angle valid verify", quality,
       "measures.md first-grid.md"},
      {"partitions metis graph decomposition graph.info gpmetis process", parts, "models.md"},
      {"multimesh multi-mesh graphcast gencast anemoi gnn graph-network neural machine-learning ml "
       "networkx pytorch torch",
       multimesh, "graphs.md"},
      {"remap remapping regrid weight conservative field interpolation", remap, "interpolation.md"},
      {"conversion format ugrid scrip esmf exodus vtk gmsh icon schism adcirc sms hgrid fort.14 "
       "2dm",
       formats_guide, "formats.md coasts.md"},
      {"mpas-tools jigsawpy compass polaris", jigsaw, "jigsaw.md"},
      {"finer refined nested coarser change local zoom", local, "changes.md"},
      {"rotation rotated grid_rotate move turn relocate", rotation, "rotation.md"},
      {"voronoi triangulation scvt lloyd algorithm paper stripack centroidal triangle", algorithms,
       "algorithms.md"},
      {"config toml namelist yaml configuration option settings", options, "first-grid.md"},
      {"error message troubleshooting bug fail failure warning problem support", trouble,
       "troubleshooting.md"},
      {"radius sphere-radius earth-radius planet mars sphere", sphere, "models.md cell-widths.md"},
      {"converge convergence converged tolerance iteration end not-converged norm residual",
       converging, "troubleshooting.md first-grid.md"},
      {"lattice icosahedral icosahedron geodesic cubed-sphere fibonacci uniform quasi-uniform",
       lattices, "algorithms.md"},
      {"about manual documentation doc licence license citation cite gpl", about, "index.md"}};
  return all;
}

} // namespace calotte::tools
