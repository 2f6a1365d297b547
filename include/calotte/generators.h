// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/domain.h>
#include <calotte/export.h>
#include <calotte/types.h>

#include <cstdint>

CALOTTE_API_BEGIN
namespace calotte {

/// All generators of the sphere return 3 x n unit columns (to the last bits), Cartesian, and the
/// same bits on every machine. They throw Error bad_option on a count out of range; none makes more
/// than 2^30 points.

/// n >= 1 points, independent and uniform on the sphere; the same seed gives the same points, fewer
/// of them the first ones. Marsaglia's rejection (Ann. Math. Stat. 43, 1972) from SplitMix64.
Points3 random_sphere(std::int64_t n, std::uint64_t seed = 1);

/// n >= 1 points, independent and distributed as the density (uniform: the points above); the same
/// seed gives the same points for any number of threads, fewer of them the first ones. Von
/// Neumann's rejection (1951) from a bound of the density that is constant on small boxes, so that
/// narrow bumps cost no more than wide ones.
///
/// A callable's bound comes from a lattice of its values. Where a proposal lies above it, all is
/// drawn anew from a better one; then fewer points may be others. What is narrower than 0.01
/// radians can go unseen (0.001, where all else is zero), but for the points that would fall there.
/// \throws Error bad_option, when the density is ill-formed, negative, infinite or NaN somewhere,
/// zero everywhere, or a callable that has no greatest value.
Points3 random_sphere(std::int64_t n, const Density& density, std::uint64_t seed = 1);

/// The Fibonacci lattice: z_i = 1 - (2i + 1)/n, longitude i times the golden angle.
Points3 fibonacci_sphere(std::int64_t n);

/// The generalised spiral of Rakhmanov, Saff and Zhou (Math. Res. Lett. 1, 1994), with both poles.
/// n >= 2.
Points3 spiral_sphere(std::int64_t n);

/// The icosahedron with every edge bisected `level` times: 10 * 4^level + 2 points, 0 <= level
/// <= 13. The points of a coarser level come first, bit for bit, and those of the next are its
/// `bisect` in another order.
Points3 bisected_icosahedron(int level);

/// A regular latitude-longitude grid: rows of `longitudes` points at cell-centred latitudes, south
/// to north; with `poles`, the two poles are added at the end. latitudes >= 1, longitudes >= 3.
Points3 lat_lon_sphere(std::int64_t latitudes, std::int64_t longitudes, bool poles = false);

/// Centres of the 6 m^2 cells of the equiangular cubed sphere (Ronchi et al., 1996). m >= 1.
Points3 cubed_sphere(std::int64_t m);

/// The points of a mesh, as they are, followed by the unit midpoint of every edge in the order of
/// the triangles, edge i of a triangle across from its vertex i (n -> 4n - 6 on a closed mesh).
/// \throws Error bad_option where an id is outside the mesh.
Points3 bisect(const Mesh& mesh);

/// Regular hexagons in a doubly periodic box, [0, columns spacing) x [0, rows spacing sqrt(3)/2):
/// every second row is shifted by half a spacing. Site r columns + c stands in row r.
/// \throws Error bad_option, for fewer than 3 columns, or 4 rows, or an odd number of these; for a
/// spacing that is not positive and finite.
PlanarMesh periodic_hexagons(std::int64_t columns, std::int64_t rows, double spacing);

// ---- The plane: 2 x n places inside a domain. They throw as require_domain(), too.

/// n >= 1 places, independent and uniform; the same seed gives the same places for any number of
/// threads, fewer of them the first ones.
Points2 random_places(std::int64_t n, const PlanarDomain& domain, std::uint64_t seed = 1);

/// The same, distributed as the density (of columns x, y, 0; bumps as planar_cvt() has them):
/// as random_sphere(n, density, seed) for a callable, so that what is narrower than 1/500 of the
/// domain's longer extent can go unseen, but for the places that would fall there. \throws Error
/// bad_option, as that.
Points2 random_places(std::int64_t n, const PlanarDomain& domain, const Density& density,
                      std::uint64_t seed = 1);

/// A regular hexagonal lattice, rows along x from the bottom up. n >= 1.
///
/// Of a polygon, the places inside it of the lattice whose spacing s, bisected from
/// sqrt(2 area / (sqrt(3) n)), makes them nearest to n, which they may miss by about half a row:
/// those at x_0 + (i + 1/4) s, i + 3/4 in every second row, and y_0 + (j + 1/2) s sqrt(3)/2, with
/// (x_0, y_0) the lower left corner of the least box around it. A rectangle of whole rows and
/// columns is filled evenly.
///
/// Of a periodic box, at least 3 columns and an even number of rows, at least 4, stretched to fit:
/// those for which the sum of how much the number misses n and how much the rows' distance misses
/// sqrt(3)/2 of the columns', relative both, is least. A box of periodic_hexagons() has its points.
/// \throws Error bad_option also for n < 12 in a periodic box, and where no place is inside.
Points2 hexagonal_lattice(std::int64_t n, const PlanarDomain& domain);

/// The points of a mesh, as they are, followed by those midpoints of its edges that are inside the
/// domain or on its boundary, in the order of bisect(mesh). Of a periodic box: all midpoints
/// between nearest copies, in the box (n -> 4n).
/// \throws Error bad_option where an id is outside the mesh, or its period is not the domain's.
Points2 bisect(const PlanarMesh& mesh, const PlanarDomain& domain);

} // namespace calotte
CALOTTE_API_END
