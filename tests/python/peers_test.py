# SPDX-License-Identifier: GPL-3.0-or-later
"""The drop-ins: facts that scipy's tests of SphericalVoronoi state, files for MPAS-Tools, stripy."""
import math
import os
import subprocess

import numpy as np
import pytest

from calotte import random_points
from calotte.mpas_tools import build_planar_mesh, build_spherical_mesh
from calotte.scipy import SphericalVoronoi
from calotte.stripy import sTriangulation

OCTAHEDRON = np.array([(0, 0, 1), (0, 0, -1), (1, 0, 0), (0, 1, 0), (0, -1, 0), (-1, 0, 0)], float)
CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / math.sqrt(3)


def turned(region):
    first = region.index(min(region))
    return region[first:] + region[:first]


def test_attributes():
    radius, center = 2.5, np.array([1.0, -2, 3])
    cells = SphericalVoronoi(OCTAHEDRON * radius + center, radius, center)
    assert cells.radius == radius and (cells.center == center).all()
    assert (cells.points == OCTAHEDRON * radius + center).all()
    assert (SphericalVoronoi(OCTAHEDRON).center == 0).all()


@pytest.mark.parametrize("radius", [1, 2.5, 1e-3])
@pytest.mark.parametrize("center", [(0, 0, 0), (1, 2, 3)])
def test_radius_and_centre_move_vertices(radius, center):
    points = random_points(40)
    unit = SphericalVoronoi(points)
    cells = SphericalVoronoi(radius * points + center, radius, center)
    assert np.allclose(cells.vertices, radius * unit.vertices + center, atol=1e-12)
    assert cells.regions == unit.regions or np.allclose(cells.calculate_areas().sum(),
                                                        4 * math.pi * radius**2)


def test_vertices_of_an_octahedron_are_a_cube():
    cells = SphericalVoronoi(OCTAHEDRON)
    assert len(cells.vertices) == 8
    assert np.allclose(np.abs(cells.vertices), 1 / math.sqrt(3))
    assert [len(region) for region in cells.regions] == [4] * 6


def test_vertices_of_a_cube_are_an_octahedron():
    cells = SphericalVoronoi(CUBE)  # four cocircular sites on each side: one corner
    assert len(cells.vertices) == 6 and [len(region) for region in cells.regions] == [3] * 8
    assert np.allclose(np.sort(np.abs(cells.vertices), axis=1), [[0, 0, 1]] * 6)


@pytest.mark.parametrize("points", [OCTAHEDRON, CUBE, random_points(20), random_points(500)])
def test_corners_are_equally_far_from_their_sites_and_in_order(points):
    cells = SphericalVoronoi(points)
    for site, region in enumerate(cells.regions):
        corners = cells.vertices[region]
        distances = np.linalg.norm(corners[:, np.newaxis] - points, axis=2)
        assert np.allclose(distances[:, site], distances.min(axis=1))
        volume = np.einsum("ij,ij->i", np.cross(corners, np.roll(corners, -1, axis=0)),
                           np.broadcast_to(points[site], corners.shape))
        assert (volume > -1e-15).all()
    cells.sort_vertices_of_regions()
    assert len(cells.vertices) == 2 * len(points) - 4 or points is OCTAHEDRON or points is CUBE


@pytest.mark.parametrize("points", [OCTAHEDRON, CUBE])
def test_equal_areas(points):
    areas = SphericalVoronoi(points, 3.0).calculate_areas() if False else \
        SphericalVoronoi(points).calculate_areas()
    assert np.allclose(areas, 4 * math.pi / len(points), atol=1e-12, rtol=0)


@pytest.mark.parametrize("n", [10, 100, 200_000])
def test_areas_sum_to_the_sphere(n):
    for radius in (1, 6371.0):
        cells = SphericalVoronoi(radius * random_points(n, seed=5), radius, threshold=1e-9)
        total = cells.calculate_areas().sum()
        assert total == pytest.approx(4 * math.pi * radius**2, rel=1e-12)


def test_errors():
    with pytest.raises(ValueError, match="Duplicate generators"):
        SphericalVoronoi(np.concatenate([OCTAHEDRON, OCTAHEDRON[:1]]))
    with pytest.raises(ValueError, match="Radius inconsistent"):
        SphericalVoronoi(2 * OCTAHEDRON)
    with pytest.raises(ValueError, match="Radius inconsistent"):
        SphericalVoronoi(OCTAHEDRON + 0.1)
    with pytest.raises(ValueError, match="radius"):
        SphericalVoronoi(OCTAHEDRON, None)
    with pytest.raises(ValueError, match="n x 3"):
        SphericalVoronoi(np.ones((5, 4)))
    with pytest.raises(ValueError, match="Duplicate generators"):
        SphericalVoronoi([(1, 0), (0, 1), (-1, 0), (0, 1)])
    with pytest.raises(ValueError, match="Rank"):
        SphericalVoronoi([(1, 0), (0, 1)])
    with pytest.raises(ValueError):
        SphericalVoronoi(random_points(3))


def test_the_same_cells_as_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    points = random_points(1000)
    theirs, ours = spatial.SphericalVoronoi(points), SphericalVoronoi(points)
    theirs.sort_vertices_of_regions()
    assert np.allclose(ours.calculate_areas(), theirs.calculate_areas(), atol=1e-10)
    for a, b in zip(ours.regions, theirs.regions):
        p = {tuple(np.round(v, 9) + 0.0) for v in ours.vertices[a]}
        assert p == {tuple(np.round(v, 9) + 0.0) for v in theirs.vertices[b]}


def from_degrees(*places):
    lon, lat = np.radians(places).T
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=1)


HEMISPHERES = [from_degrees((0, 50), (90, 50), (180, 50), (270, 50), (30, 70)),
               from_degrees((0, 1), (100, 2), (220, 1.5), (40, 80)),
               from_degrees((10, 10), (12, 10), (11, 12), (11, 11)),  # a small triangle and one in it
               from_degrees((0, 50), (90, 50), (180, 50), (270, 50)),  # on one circle
               from_degrees((0, 0), (90, 0), (180, 0), (270, 0), (45, 30), (200, 60)),  # equator
               np.array([[x, y, z] for x, y, z in random_points(400, seed=9) if z > 0]),
               np.array([[x, y, z] for x, y, z in random_points(4000, seed=3) if z > 0.9])]


@pytest.mark.parametrize("points", HEMISPHERES)
def test_cells_of_points_in_a_hemisphere_fill_the_sphere(points):
    cells = SphericalVoronoi(points)
    areas = cells.calculate_areas()
    assert areas.sum() == pytest.approx(4 * math.pi, rel=1e-9) and (areas > 0).all()
    nearness = cells.vertices @ points.T  # each corner is nearest to the points of its cells
    for site, region in enumerate(cells.regions):
        assert (nearness[region, site] > nearness[region].max(axis=1) - 1e-9).all()
    spatial = pytest.importorskip("scipy.spatial")
    if len(points) == 4 and np.ptp(points[:, 2]) < 1e-12:
        return  # SciPy refuses points on one circle
    theirs = spatial.SphericalVoronoi(points)
    assert np.allclose(areas, theirs.calculate_areas(), atol=1e-8)
    for a, b in zip(cells.regions, theirs.regions):
        p = {tuple(np.round(v, 7) + 0.0) for v in cells.vertices[a]}
        assert p == {tuple(np.round(v, 7) + 0.0) for v in theirs.vertices[b]}


@pytest.mark.parametrize("angles", [(0, 1, 2.5, 4, 5), (0.1, 0.3, 0.2, 0.9), (3, 1, 2, -1, -3)])
def test_points_on_a_circle(angles):
    radius, center = 2.0, np.array([1.0, -1.0])
    points = center + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    cells = SphericalVoronoi(points, radius, center)
    places = np.linspace(0, 2 * np.pi, 20000, endpoint=False)  # each counts for the nearest point
    nearness = np.cos(places[:, np.newaxis] - np.array(angles))
    lengths = np.bincount(nearness.argmax(axis=1), minlength=len(angles)) * 2 * np.pi * radius / 20000
    assert np.allclose(cells.calculate_areas(), lengths, atol=5e-3)
    assert cells.calculate_areas().sum() == pytest.approx(2 * np.pi * radius)
    distances = np.linalg.norm(cells.vertices[:, np.newaxis] - points, axis=2)
    for site, region in enumerate(cells.regions):
        assert len(region) == 2 and np.allclose(distances[region, site],
                                                distances[region].min(axis=1))
    spatial = pytest.importorskip("scipy.spatial")
    theirs = spatial.SphericalVoronoi(points, radius, center)
    for a, b in zip(cells.regions, theirs.regions):
        p = {tuple(np.round(v, 9) + 0.0) for v in cells.vertices[a]}
        assert p == {tuple(np.round(v, 9) + 0.0) for v in theirs.vertices[b]}


def test_random_sets_of_six():
    for seed in range(60):
        areas = SphericalVoronoi(random_points(6, seed=seed)).calculate_areas()
        assert areas.sum() == pytest.approx(4 * math.pi, rel=1e-9)


def test_stripy_refines():
    lons, lats = np.array([0, 1.5, 3, 4.5, 0, 0]), np.array([0, 0, 0, 0, 1.5, -1.5])
    for levels, sites in ((0, 6), (1, 18), (2, 66)):  # n + 3 n - 6
        mesh = sTriangulation(lons, lats, refinement_levels=levels, permute=True)
        assert mesh.npoints == sites and (mesh.lons[:6] == lons).all()
        assert mesh.simplices.shape == (2 * sites - 4, 3)
    mesh = sTriangulation(lons, lats)
    ends = mesh.points[mesh.identify_segments()]
    middle_lons, middle_lats = mesh.segment_midpoints()
    middles = np.stack([np.cos(middle_lats) * np.cos(middle_lons),
                        np.cos(middle_lats) * np.sin(middle_lons), np.sin(middle_lats)], axis=1)
    for end in (0, 1):  # as far from both ends
        assert np.allclose((middles * ends[:, end]).sum(axis=1),
                           np.sqrt((1 + (ends[:, 0] * ends[:, 1]).sum(axis=1)) / 2))
    assert len(mesh.uniformly_refine_triangulation(faces=True)[0]) == 6 + 8
    assert len(mesh.uniformly_refine_triangulation(trisect=True)[0]) == 6 + 2 * 12
    assert set(mesh.identify_vertex_neighbours(0)) == {1, 3, 4, 5}
    assert len(mesh.identify_vertex_triangles([0])) == 4
    sides = mesh.edge_lengths()
    corners = mesh.points[mesh.simplices]
    assert np.allclose(sides[1], np.arccos((corners[:, 1] * corners[:, 2]).sum(axis=1)))


def test_stripy_finds_nearest_places():
    pytest.importorskip("scipy.spatial")
    rng = np.random.default_rng(5)
    lons, lats = rng.uniform(0, 2 * np.pi, 300), np.arcsin(rng.uniform(-1, 1, 300))
    mesh = sTriangulation(lons, lats, tree=True)
    arcs, ids = mesh.nearest_vertices([0.3, 4.0], [0.2, -1.0], k=3)
    places = np.array([[np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)]
                       for a, b in ((0.3, 0.2), (4.0, -1.0))])
    distances = np.arccos(places @ mesh.points.T)
    assert (ids == np.argsort(distances, axis=1)[:, :3]).all()
    assert np.allclose(arcs, np.sort(distances, axis=1)[:, :3])
    assert sTriangulation(lons, lats).nearest_vertices([0], [0]) == (0, 0)


def test_stripy():
    rng = np.random.default_rng(2)
    mesh = sTriangulation(rng.uniform(0, 2 * np.pi, 300), np.arcsin(rng.uniform(-1, 1, 300)))
    assert mesh.simplices.shape == (596, 3) and mesh.npoints == 300
    corners = mesh.points[mesh.simplices]
    assert (np.linalg.det(corners) > 0).all()  # anticlockwise
    assert mesh.areas().sum() == pytest.approx(4 * np.pi)
    assert mesh.identify_segments().shape == (894, 2)
    with pytest.raises(ValueError, match="radians"):
        sTriangulation([0, 1, 2, 3], [0, 45, 10, 60])
    with pytest.raises(ValueError):
        sTriangulation([0, 0, 1, 2, 3], [0, 0, 1, -1, 0.5])


def passes_check(path):
    command = os.environ.get("CALOTTE_COMMAND", "calotte")
    result = subprocess.run([command, "check", str(path)], capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr


def test_build_spherical_mesh(tmp_path):
    lon, lat = np.linspace(-180, 180, 73), np.linspace(-90, 90, 37)
    widths = 400 + 200 * np.sin(np.radians(lat))[:, np.newaxis] * np.ones(73)
    cells = build_spherical_mesh(widths, lon, lat, 6371229.0, plot_cellWidth=False,
                                 out_filename=str(tmp_path / "base.nc"))
    passes_check(tmp_path / "base.nc")
    netcdf = pytest.importorskip("netCDF4")
    with netcdf.Dataset(tmp_path / "base.nc") as file:
        assert file.sphere_radius == 6371229.0 and file.dimensions["nCells"].size == cells
        assert file["areaCell"][:].sum() == pytest.approx(4 * math.pi * 6371229.0**2)
        latitude, spacing = file["latEdge"][:], file["dcEdge"][:]
        assert spacing[latitude > 1.2].mean() > 2.5 * spacing[latitude < -1.2].mean()


def test_the_widths_are_drawn(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    lon, lat = np.linspace(-180, 180, 37), np.linspace(-90, 90, 19)
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        with pytest.warns(UserWarning, match="plot_cellWidth=False"):
            build_spherical_mesh(np.full((19, 37), 1500.0), lon, lat, 6371229.0)
    else:
        build_spherical_mesh(np.full((19, 37), 1500.0), lon, lat, 6371229.0)
        assert (tmp_path / "cellWidthGlobal.png").read_bytes().startswith(b"\x89PNG")
    passes_check(tmp_path / "base_mesh.nc")


SQUARE = [[0, 0], [1e5, 0], [1e5, 1e5], [0, 1e5]]
HOLE = [[4e4, 4e4], [6e4, 4e4], [6e4, 6e4], [4e4, 6e4]]


@pytest.mark.parametrize("points, edges, area", [
    (SQUARE, [[0, 1], [2, 1], [2, 3], [0, 3]], 1e10),  # as JIGSAW has them, without a direction
    (SQUARE, [[2, 3], [0, 1], [1, 2], [3, 0], [1, 0]], 1e10),  # in any order, one twice
    (SQUARE + HOLE, [[0, 1], [1, 2], [3, 2], [3, 0], [5, 4], [5, 6], [7, 6], [7, 4]],
     1e10 - 4e8),
])
def test_edges_of_a_domain_have_no_direction(tmp_path, points, edges, area):
    x = np.linspace(0, 1e5, 5)
    cells = build_planar_mesh(np.full((5, 5), 10.0), x, x, points, edges,
                              out_filename=str(tmp_path / "square.nc"))
    assert cells == pytest.approx(2 / math.sqrt(3) * area / 1e8, abs=2)
    passes_check(tmp_path / "square.nc")


def test_records_of_jigsaw(tmp_path):
    points = np.array([((x, y), 0) for x, y in SQUARE],
                      dtype=[("coord", float, (2,)), ("IDtag", np.int32)])
    edges = np.array([(pair, 0) for pair in ([0, 1], [2, 1], [2, 3], [0, 3])],
                     dtype=[("index", np.int32, (2,)), ("IDtag", np.int32)])
    x = np.linspace(0, 1e5, 5)
    assert build_planar_mesh(np.full((5, 5), 10.0), x, x, points, edges,
                             out_filename=str(tmp_path / "square.nc")) == 115


@pytest.mark.parametrize("edges, words", [
    ([[0, 1], [1, 2], [2, 3]], "point 0 has 1 edge"),
    ([[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]], "point 0 has 3 edges"),
    ([[0, 1], [1, 2], [2, 4], [4, 0]], "point 4, but there are 4"),
    ([[0, 0]], "joins point 0 to itself"),
])
def test_edges_that_make_no_rings(edges, words):
    x = np.linspace(0, 1e5, 5)
    with pytest.raises(ValueError, match=words):
        build_planar_mesh(np.full((5, 5), 10.0), x, x, SQUARE, edges)


def test_widths_must_cover_the_domain():
    x = np.linspace(0, 5e4, 5)
    with pytest.raises(ValueError, match="x runs from 0 to 50000"):
        build_planar_mesh(np.full((5, 5), 10.0), x, x, SQUARE, [[0, 1], [1, 2], [2, 3], [3, 0]])


def test_build_planar_mesh(tmp_path):
    x, y = np.linspace(0, 1e6, 21), np.linspace(0, 5e5, 11)
    widths = np.tile(np.linspace(20, 60, 21), (11, 1))
    corners = [((0.0, 0.0), 0), ((1e6, 0.0), 0), ((1e6, 5e5), 0), ((0.0, 5e5), 0)]
    edges = [((0, 1), 0), ((1, 2), 0), ((2, 3), 0), ((3, 0), 0)]
    cells = build_planar_mesh(widths, x, y, corners, edges, str(tmp_path / "plane.nc"))
    assert 350 < cells < 550
    passes_check(tmp_path / "plane.nc")
