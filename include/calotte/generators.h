// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// Starts of a CVT and test sets. All functions return 3 x n points: Cartesian unit columns on the
/// sphere, with the same bits on every machine; x, y and 0 in the plane, in its unit of length.
/// They throw Error invalid_argument for a count out of range; the largest count is 2^30.

/// Independent random points of a surface. They depend on n, surface, density and seed, not on the
/// number of threads; a smaller n gives the first points of a larger n.
///
/// Uniform points of the whole sphere come from Marsaglia's rejection (Ann. Math. Stat. 43, 1972)
/// with SplitMix64; others from von Neumann's rejection (1951) from a bound of the density that is
/// constant on small boxes, so that narrow bumps cost no more than wide ones. The bound of a
/// callable, and in the plane that of any density, comes from values on a lattice. If the density
/// exceeds it at a proposed point, the function improves the bound and draws all points again; then
/// a smaller n may give other points. The lattice can miss features narrower than 0.01 radians
/// (0.001 where the density is zero elsewhere), in the plane 1/500 of the longer extent; they then
/// receive too few points.
/// \param n number of points, 1 to 2^30.
/// \param surface the sphere, a region of it, a box, or a part of the plane.
/// \param density default: uniform.
/// \param seed any value; default 1.
/// \throws Error invalid_argument for a plane without rings and two periods;
///         if the density is ill-formed; negative, infinite or NaN somewhere;
///         zero everywhere; or a callable without a maximum.
Points3 random_points(std::int64_t n, const Surface& surface, const Density& density = {},
                      std::uint64_t seed = 1);

/// Independent random points, uniform on the sphere. A smaller n gives the first points of a larger
/// n with the same seed. Method: Marsaglia's rejection (Ann. Math. Stat. 43, 1972) with SplitMix64.
/// \param n number of points, 1 to 2^30.
/// \param seed any value; default 1.
Points3 random_sphere(std::int64_t n, std::uint64_t seed = 1);

/// Independent random points with the given density. The points depend on n, density and seed, not
/// on the number of threads; a smaller n gives the first points of a larger n. Method: von
/// Neumann's rejection (1951) from a bound of the density that is constant on small boxes, so that
/// narrow bumps cost no more than wide ones.
///
/// The bound of a callable comes from its values on a lattice. If the density exceeds the bound at
/// a proposed point, the function improves the bound and draws all points again; then a smaller n
/// may give other points. The lattice can miss features narrower than 0.01 radians (0.001 where the
/// density is zero elsewhere); they then receive too few points.
/// \param n number of points, 1 to 2^30.
/// \param density uniform gives the points above.
/// \param seed any value; default 1.
/// \throws Error invalid_argument if the density is ill-formed; negative, infinite or NaN
///         somewhere; zero everywhere; or a callable without a maximum.
Points3 random_sphere(std::int64_t n, const Density& density, std::uint64_t seed = 1);

/// Generators along the boundary of a surface, ring by ring, for Recipe::fixed of a run with
/// Boundary::generators: at the distances of neighbours that a density demands of so many
/// generators, of which those on the boundary have half a cell. Corners where the boundary turns by
/// 20 degrees or more have a generator unless a sharper one is nearer than two thirds of such a
/// distance; the distances between two corners are equal, from 5/8 to 5/4 of the demanded one. A
/// ring has at least three generators, whose distances may be smaller.
///
/// The generators lie on the boundary up to 1e-15, in a plane times its coordinates, and not
/// outside the surface.
/// \param surface the sphere, a region of it, or a plane.
/// \param cells number of generators of the run, 4 to 2^30.
/// \returns 3 x n; none for a surface without a boundary.
/// \throws Error invalid_argument for an ill-formed density, cells out of range, and if the
///         boundary takes all of the cells.
Points3 boundary_points(const Surface& surface, std::int64_t cells, const Density& density = {});

/// Generators along lines.
struct LinePoints {
  Points3 points;        ///< 3 x n
  std::int64_t ends = 0; ///< number of those at confluences and ends of lines: the first columns
  /// The largest distance of a point on the lines from the nearest of them, over the distance of
  /// neighbours that is demanded there; a half where generators follow each other at that distance.
  double farthest = 0;
};

/// Generators along lines such as rivers, for Recipe::fixed: at the distances of neighbours that a
/// density demands of so many generators, from 2/3 to 5/3 of it. The lines are one network, however
/// they are cut into parts. Where three lines or more meet, and where one ends, there is a
/// generator, and where a line turns by 20 degrees or more, unless a sharper corner is nearer than
/// two thirds of that distance. Of two generators nearer than that, one is removed; of a confluence
/// and an end, the end is removed. Lines that run close to each other, or cross between their
/// points, share generators.
/// \param lines each 3 x n, on the sphere directions joined by arcs shorter than a half circle, in
///        a plane x y 0. Points are shared if they are equal.
/// \param surface of finite area, which contains the lines.
/// \param cells number of generators of the run, 3 to 2^30.
/// \param beside other fixed generators, 3 x m, from which the result keeps that distance, too.
/// \throws Error invalid_argument, naming line and point: no direction, not finite, opposite
///         neighbours; a point outside the surface; a line that crosses what the surface leaves
///         out, or is in a periodic plane; an ill-formed density; cells out of range.
LinePoints line_points(const std::vector<Points3>& lines, const Surface& surface,
                       std::int64_t cells, const Density& density = {},
                       const Points3& beside = Points3(3, 0));

/// The Fibonacci lattice, from north to south: z_i = 1 - (2i + 1)/n, longitude i times the golden
/// angle pi (3 - sqrt 5).
/// \param n number of points, 1 to 2^30.
Points3 fibonacci_sphere(std::int64_t n);

/// The generalised spiral of Rakhmanov, Saff and Zhou (Math. Res. Lett. 1, 1994), from the south
/// pole to the north pole.
/// \param n number of points, 2 to 2^30.
Points3 spiral_sphere(std::int64_t n);

/// The icosahedron with every edge bisected `level` times: 10 * 4^level + 2 points. The points of a
/// coarser level come first, bit for bit; `bisect` of a level gives the points of the next in
/// another order.
/// \param level 0 to 13.
Points3 bisected_icosahedron(int level);

/// The points of a triangular lattice on the faces of an icosahedron, whose edges are the vector b
/// + c exp(i pi/3) of the lattice (Caspar and Klug, Cold Spring Harb. Symp. Quant. Biol. 27, 1962):
/// 10 (b^2 + b c + c^2) + 2 points, 12 with five neighbours and all others with six. They have the
/// rotations of the icosahedron as symmetries; (c, b) gives the mirror image of (b, c). The points
/// are near those of a uniform CVT, which bisected_icosahedron(k) approximates for (2^k, 0), too.
///
/// The vertices of the icosahedron come first.
/// \param b, c >= 0, not both 0; at most 2^30 points.
Points3 geodesic_sphere(std::int64_t b, std::int64_t c);

/// n such points: 12 with five neighbours, near the vertices of an icosahedron, and all others with
/// six; for n below 240 often only after a CVT descent. For 10 (b^2 + b c + c^2) + 2 points those
/// above; for other numbers the edges of the icosahedron differ by a step or two of the lattice,
/// and there is no symmetry.
/// \param n 12 to 2^30, but not 13, for which there is no such triangulation.
Points3 geodesic_sphere(std::int64_t n);

/// A number of points for a uniform grid, near a given one. It is the number of a bisected
/// icosahedron, which many models support, if that is within 0.5 percent; else the nearest number
/// of a symmetric geodesic grid, of two equally near ones the larger, if that is within 0.5
/// percent; else the given number, rounded.
/// \param points 12 to 2^30.
std::int64_t geodesic_count(double points);

/// A regular latitude-longitude grid: rows of `longitudes` points at cell-centred latitudes, south
/// to north, each from longitude 0 eastwards.
/// \param latitudes number of rows, >= 1; latitudes times longitudes is at most 2^30.
/// \param longitudes points per row, >= 3.
/// \param poles appends the south and the north pole; default false.
Points3 lat_lon_sphere(std::int64_t latitudes, std::int64_t longitudes, bool poles = false);

/// Centres of the 6 m^2 cells of the equiangular cubed sphere (Ronchi et al., 1996).
/// \param m number of cells along an edge, 1 to 13377.
Points3 cubed_sphere(std::int64_t m);

/// The points of a mesh, unchanged, followed by the midpoints of its edges, in the order of the
/// triangles; edge i of a triangle is opposite vertex i. On the sphere a midpoint is a unit column;
/// in a periodic direction it is that between nearest copies, moved into [0, period). On a bounded
/// surface, midpoints outside are not added. A closed mesh of n points gives 4n - 6 points on the
/// sphere, 4n in a box.
/// \throws Error invalid_argument if an id is out of range.
Points3 bisect(const Mesh& mesh);

/// The mesh of regular hexagons in the doubly periodic box [0, columns spacing) x [0, rows spacing
/// sqrt(3)/2). Every second row is shifted by half a spacing. Site r columns + c is in row r. The
/// mesh is the Delaunay triangulation of the sites.
/// \param columns number of columns, >= 3; columns times rows is at most 2^30.
/// \param rows number of rows, even, >= 4.
/// \param spacing distance between neighbouring sites, in any unit of length; > 0 and finite.
/// \throws Error invalid_argument for an argument out of range.
Mesh hexagonal_box(std::int64_t columns, std::int64_t rows, double spacing);

/// A regular hexagonal lattice in a box or a part of the plane, with rows along x, from the bottom
/// up. For the sphere see geodesic_sphere().
///
/// Between rings the result is the lattice points inside: x_0 + (i + 1/4) s, in every second row
/// x_0 + (i + 3/4) s, and y_0 + (j + 1/2) s sqrt(3)/2, where (x_0, y_0) is the lower left corner of
/// the bounding box. Bisection from sqrt(2 area / (sqrt(3) n)) finds the spacing s whose number of
/// points is closest to n; the difference may be about half a row. The lattice fills a rectangle of
/// whole rows and columns evenly.
///
/// In a periodic box the lattice is stretched to fit. It has at least 3 columns and an even number
/// of rows, at least 4. The function minimises the sum of two relative errors: that of the number
/// of points, and that of the ratio sqrt(3)/2 of row to column distance. A box of hexagonal_box()
/// gives its points.
/// \param n approximate number of points, 1 to 2^30; in a periodic box >= 12.
/// \throws Error invalid_argument for the sphere, and for a plane without rings and two periods;
///         for fewer points than 12 in a periodic box; if no lattice point is inside.
Points3 hexagonal_lattice(std::int64_t n, const Surface& surface);

/// Unit columns at longitudes and latitudes. They are exact at multiples of 90 degrees and have the
/// same bits on every machine. Longitudes that differ by 360 give the same point, and so do all
/// longitudes at a pole.
/// \param lonlat 2 x n degrees: longitude (any finite value), latitude (-90 to 90).
/// \throws Error invalid_argument unless there are 2 rows, and for a latitude out of range;
///         not_finite; both with the index of the column.
Points3 from_lonlat(const PointsRef& lonlat);

/// Longitude from -180 to 180 and latitude in degrees, 2 x n, within about 1e-15 of 360; at a pole
/// the longitude is 0.
/// \param points 3 x n directions of any norm but 0.
/// \throws Error invalid_argument unless the points have 3 rows.
Points2 to_lonlat(const PointsRef& points);

} // namespace calotte
CALOTTE_API_END
