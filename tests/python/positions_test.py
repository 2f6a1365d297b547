# SPDX-License-Identifier: GPL-3.0-or-later
"""Positions in meshes, and values there."""
import pickle

import numpy as np
import pytest

import calotte

RNG = np.random.default_rng(3)


def nearest(points, positions):
    return np.argmax(positions @ points.T, axis=1)


def test_on_the_sphere():
    mesh = calotte.delaunay(calotte.random_points(500))
    positions = calotte.random_points(2000, seed=2)
    found = calotte.locate(mesh, 3 * positions)
    assert len(found) == 2000 and found.triangle.dtype == found.nearest.dtype == np.int32
    assert found.weights.shape == (2000, 3) and (found.weights >= 0).all()
    assert np.allclose(found.weights.sum(axis=1), 1)
    corners = mesh.points[mesh.triangles[found.triangle]]
    within = (found.weights[:, :, np.newaxis] * corners).sum(axis=1)
    assert np.allclose(within / np.linalg.norm(within, axis=1, keepdims=True), positions)
    assert (found.nearest == nearest(mesh.points, positions)).all()
    again = calotte.locate(mesh, calotte.to_lonlat(positions))
    assert (again.nearest == found.nearest).all()
    values = mesh.points[:, 2]
    linear = (found.weights * values[mesh.triangles[found.triangle]]).sum(axis=1)
    assert np.allclose(calotte.interpolate(mesh, values, positions), linear)
    natural = calotte.interpolate(mesh, mesh.points, positions, method="natural")
    assert natural.shape == (2000, 3) and np.abs(natural - positions).max() < 0.05
    assert np.allclose(calotte.interpolate(mesh, values, mesh.points, method="natural"), values)
    assert repr(found) == "<calotte.Locations: 2000 positions>"


def test_a_locator_of_a_mesh():
    mesh = calotte.delaunay(calotte.random_points(500))
    positions = calotte.random_points(2000, seed=2)
    locator = pickle.loads(pickle.dumps(calotte.Locator(mesh)))
    assert repr(locator) == "<calotte.Locator: in 500 sites>" and len(locator.mesh) == 500
    found, hinted = locator.find(positions), locator.find(positions, hints=np.zeros(2000))
    assert (found.triangle == calotte.locate(mesh, positions).triangle).all()
    assert (hinted.triangle == found.triangle).all()
    assert (locator.nearest(positions, hints=found.triangle) == found.nearest).all()
    distances = np.arccos(np.clip(positions @ mesh.points.T, -1, 1))
    few = locator.nearest(positions.astype(np.float32), 8)
    assert few.shape == (2000, 8) and few.dtype == np.int32
    assert (few == np.argsort(distances, axis=1)[:, :8]).mean() > 0.9999  # float32 is another place
    assert (locator.nearest(positions, 8) == np.argsort(distances, axis=1)[:, :8]).all()
    near = locator.within(calotte.to_lonlat(positions), 0.2)
    assert len(near) == 2000 and (np.diff(near.begin) == (distances <= 0.2).sum(axis=1)).all()
    assert (near[7] == np.flatnonzero(distances[7] <= 0.2)).all()
    for call, words in [(lambda: locator.nearest(positions, 501), "k is 501, and the mesh has 500 sites"),
                        (lambda: locator.nearest(positions, 0), "k is 0; give 1 or more"),
                        (lambda: locator.within(positions, -1), "the distance is -1"),
                        (lambda: locator.find(positions, hints=[5]), "there are 1 hints for 2000 positions"),
                        (lambda: calotte.Locator(calotte.raster(8, 4)), "give a Mesh")]:
        with pytest.raises(calotte.Error, match=words):
            call()


def test_outside_of_an_open_mesh():
    mesh = calotte.delaunay([(0, 50), (90, 50), (180, 50), (270, 50), (30, 70)])
    found = calotte.locate(mesh, [(0, -90), (10, 80)])
    assert found.triangle[0] == -1 and found.triangle[1] >= 0
    assert np.isnan(found.weights[0]).all() and np.isfinite(found.weights[1]).all()
    for method in ("linear", "natural"):
        values = calotte.interpolate(mesh, np.ones(5), [(0, -90), (10, 80)], method=method)
        assert np.isnan(values[0]) and values[1] == pytest.approx(1)
    assert repr(found) == "<calotte.Locations: 2 positions, 1 outside>"


def test_in_the_plane():
    mesh = calotte.delaunay(RNG.random((300, 2)), calotte.plane())
    positions = 0.2 + 0.6 * RNG.random((1000, 2))
    found = calotte.locate(mesh, positions)
    corners = mesh.points[mesh.triangles[found.triangle]]
    assert np.allclose((found.weights[:, :, np.newaxis] * corners).sum(axis=1), positions)
    distances = np.linalg.norm(positions[:, np.newaxis] - mesh.points, axis=2)
    assert (found.nearest == distances.argmin(axis=1)).all()
    values = 1 + mesh.points @ [2, 3]
    for method in ("linear", "natural"):
        assert np.allclose(calotte.interpolate(mesh, values, positions, method=method),
                           1 + positions @ [2, 3])
    assert calotte.locate(mesh, [(9, 9)]).triangle[0] == -1


def test_in_a_periodic_box():
    mesh = calotte.cvt(100, surface=calotte.periodic_box(2, 1)).mesh
    positions = RNG.random((500, 2)) * [2, 1]
    found = calotte.locate(mesh, positions)
    shifted = calotte.locate(mesh, positions + [4, -3])
    assert (found.triangle >= 0).all() and (shifted.nearest == found.nearest).all()
    assert calotte.interpolate(mesh, np.ones(100), positions) == pytest.approx(1)


def test_errors():
    mesh = calotte.delaunay(calotte.random_points(50))
    plane = calotte.delaunay(RNG.random((50, 2)), calotte.plane())
    positions = calotte.random_points(10)
    positions[4, 0] = np.nan
    for call in (lambda p: calotte.locate(mesh, p),
                 lambda p: calotte.interpolate(mesh, np.ones(50), p)):
        with pytest.raises(calotte.Error, match="4") as caught:
            call(positions)
        assert (caught.value.code, caught.value.index) == ("not_finite", 4)
        with pytest.raises(calotte.Error) as caught:
            call(np.eye(4)[:, :3])
        assert (caught.value.code, caught.value.index) == ("zero_vector", 3)
        with pytest.raises(calotte.Error, match="latitude") as caught:
            call([(0, 0), (0, 91)])
        assert caught.value.index == 1
        with pytest.raises(calotte.Error, match=r"positions have the shape \(4, 4\)"):
            call(np.eye(4))
    with pytest.raises(calotte.Error, match="n x 2 for a surface in the plane"):
        calotte.locate(plane, np.eye(3))
    with pytest.raises(calotte.Error, match=r"shape \(3,\); give a number, or an array of them, for "
                                            "each of the 50 cells"):
        calotte.interpolate(mesh, np.ones(3), np.eye(3))
    with pytest.raises(calotte.Error, match="must be numbers"):
        calotte.interpolate(mesh, ["a"] * 50, np.eye(3))
    with pytest.raises(calotte.Error, match="no method cubic; give one of: linear, natural, nearest"):
        calotte.interpolate(mesh, np.ones(50), np.eye(3), method="cubic")


def test_tables_of_pandas():
    pandas = pytest.importorskip("pandas")
    lonlat = np.random.default_rng(3).uniform((-180, -90), (180, 90), (200, 2))
    table = pandas.DataFrame({"name": ["a"] * 200, "Latitude": lonlat[:, 1], "t": 1, "lon": lonlat[:, 0]})
    mesh = calotte.delaunay(lonlat)
    assert (calotte.delaunay(table).points == mesh.points).all()
    assert (calotte.Locator(mesh).nearest(table) == np.arange(200)).all()
    xyz = pandas.DataFrame(mesh.points, columns=["x", "y", "z"])
    assert (calotte.delaunay(xyz[["z", "y", "x"]]).points == mesh.points).all()
    plane = calotte.delaunay(pandas.DataFrame(lonlat, columns=["x", "y"]), surface=calotte.plane())
    assert (plane.points[:, :2] == lonlat).all()
    assert (calotte.area_weights(table) == calotte.area_weights(lonlat)).all()
    with pytest.raises(calotte.Error, match="a table with the columns a, b; name those of the position lon, lat or x, y, z"):
        calotte.delaunay(pandas.DataFrame(lonlat, columns=["a", "b"]))


def test_area_weights():
    scipy_spatial = pytest.importorskip("scipy.spatial")
    points = calotte.random_points(3000, seed=4)
    weights = calotte.area_weights(points)
    areas = scipy_spatial.SphericalVoronoi(points).calculate_areas()
    assert np.abs(weights - areas).max() < 1e-13 and abs(weights.sum() - 4 * np.pi) < 1e-12
    twice = np.concatenate([points, points[:7]])
    shared = calotte.area_weights(twice)
    assert (shared[:7] == weights[:7] / 2).all() and (shared[3000:] == shared[:7]).all()
    single = calotte.area_weights(points.astype(np.float32))
    assert np.abs(single / weights - 1).max() < 1e-2

    longitudes, latitudes = np.meshgrid(np.arange(5, 16, 0.25), np.arange(44, 55, 0.25))
    nodes = np.stack([longitudes.ravel(), latitudes.ravel()], axis=1)
    bounded = calotte.area_weights(nodes) / np.cos(np.radians(nodes[:, 1]))
    assert bounded.max() / bounded.min() < 1.01
    assert calotte.area_weights(nodes, edge="hull").sum() < bounded.sum()
    far = calotte.area_weights(nodes, edge="50km")
    assert far.max() < np.pi * (50 / 6371) ** 2 and far.sum() > calotte.area_weights(nodes).sum()
    assert abs(calotte.area_weights(nodes, edge="whole").sum() - 4 * np.pi) < 1e-11

    square = np.stack(np.meshgrid(np.arange(5.0), np.arange(4.0)), axis=-1).reshape(-1, 2)
    assert np.allclose(calotte.area_weights(square, calotte.plane()), 1)
    assert abs(calotte.area_weights(square, calotte.plane(), edge="hull").sum() - 12) < 1e-12
    assert np.allclose(calotte.area_weights(square, calotte.plane(), edge=0.25), np.pi / 16)
    assert np.allclose(calotte.area_weights(square, calotte.rectangle((-0.5, -0.5), (4.5, 3.5))), 1)
    for call, text in [(lambda: calotte.area_weights(nodes, edge="far"), "edge is 'far'; give whole, hull"),
                       (lambda: calotte.area_weights(nodes, edge="100deg"), "at most pi/2"),
                       (lambda: calotte.area_weights(nodes, gap=0), "the gap is 0"),
                       (lambda: calotte.area_weights(nodes[:1]), "at least"),
                       (lambda: calotte.area_weights(square, calotte.plane(), edge="whole"), "unbounded")]:
        with pytest.raises(calotte.Error, match=text):
            call()


def test_cells_at():
    mesh = calotte.delaunay(calotte.random_points(800, seed=3))
    positions = calotte.random_points(5000, seed=8)
    cells = calotte.voronoi(mesh)
    polygons = calotte.Polygons(cells.vertices, cells.begin, cells.vertices_on_cell)
    assert (calotte.cells_at(polygons, positions) == nearest(mesh.points, positions)).all()
    assert (calotte.cells_at(polygons, calotte.to_lonlat(positions)) == calotte.cells_at(polygons, positions)).all()
    with pytest.raises(calotte.Error, match="for a Mesh use locate"):
        calotte.cells_at(mesh, positions)
    with pytest.raises(calotte.Error, match="point 1: longitude"):
        calotte.cells_at(polygons, [(0, 0), (np.nan, 0)])
