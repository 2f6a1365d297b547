# SPDX-License-Identifier: GPL-3.0-or-later
"""The drop-ins: facts that scipy's tests of SphericalVoronoi state, files for MPAS-Tools, stripy."""
import math
import os
import subprocess

import numpy as np
import pytest

from calotte import random_sphere
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
    points = random_sphere(40)
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


@pytest.mark.parametrize("points", [OCTAHEDRON, CUBE, random_sphere(20), random_sphere(500)])
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
        cells = SphericalVoronoi(radius * random_sphere(n, seed=5), radius, threshold=1e-9)
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
    with pytest.raises(ValueError):
        SphericalVoronoi(random_sphere(3))


def test_the_same_cells_as_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    points = random_sphere(1000)
    theirs, ours = spatial.SphericalVoronoi(points), SphericalVoronoi(points)
    theirs.sort_vertices_of_regions()
    assert np.allclose(ours.calculate_areas(), theirs.calculate_areas(), atol=1e-10)
    for a, b in zip(ours.regions, theirs.regions):
        p = {tuple(np.round(v, 9) + 0.0) for v in ours.vertices[a]}
        assert p == {tuple(np.round(v, 9) + 0.0) for v in theirs.vertices[b]}


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
    cells = build_spherical_mesh(widths, lon, lat, 6371229.0, out_filename="base.nc",
                                 dir=str(tmp_path))
    passes_check(tmp_path / "base.nc")
    netcdf = pytest.importorskip("netCDF4")
    with netcdf.Dataset(tmp_path / "base.nc") as file:
        assert file.sphere_radius == 6371229.0 and file.dimensions["nCells"].size == cells
        assert file["areaCell"][:].sum() == pytest.approx(4 * math.pi * 6371229.0**2)
        latitude, spacing = file["latEdge"][:], file["dcEdge"][:]
        assert spacing[latitude > 1.2].mean() > 2.5 * spacing[latitude < -1.2].mean()


def test_build_planar_mesh(tmp_path):
    x, y = np.linspace(0, 1e6, 21), np.linspace(0, 5e5, 11)
    widths = np.tile(np.linspace(20, 60, 21), (11, 1))
    corners = [((0.0, 0.0), 0), ((1e6, 0.0), 0), ((1e6, 5e5), 0), ((0.0, 5e5), 0)]
    edges = [((0, 1), 0), ((1, 2), 0), ((2, 3), 0), ((3, 0), 0)]
    cells = build_planar_mesh(widths, x, y, corners, edges, str(tmp_path / "plane.nc"))
    assert 350 < cells < 550
    passes_check(tmp_path / "plane.nc")
