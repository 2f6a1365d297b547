# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights between grids, their files, and values that they take along."""
import numpy as np
import pytest

import calotte


@pytest.fixture(scope="module", name="mesh")
def fixture_mesh():
    return calotte.delaunay(calotte.fibonacci_sphere(800))


def test_weights_keep_integrals(mesh):
    boxes = calotte.raster(36, 18)
    assert len(boxes) == 648 and boxes.meridians.shape == (37,) and boxes.parallels[0] == -90
    for source, target in ((mesh, boxes), (boxes, mesh), (boxes, calotte.raster(10, 7)), (mesh, mesh)):
        weights = calotte.interpolation_weights(source, target)
        values = np.sin(np.arange(len(source)))
        moved = weights.apply(values)
        assert moved.shape == (len(target),)
        assert weights.source_area.sum() == pytest.approx(4 * np.pi, abs=1e-11)
        assert weights.target_area @ moved == pytest.approx(weights.source_area @ values, abs=1e-11)
        assert np.abs(weights.source_fraction - 1).max() < 1e-11
        assert np.abs(weights.target_fraction - 1).max() < 1e-11
        assert (calotte.interpolate(source, values, target) == moved).all()  # conservative, too
        assert calotte.interpolate(source, values, target, method="conservative") == pytest.approx(moved)
        two = weights.apply(np.stack([values, 2 * values], axis=1))
        assert np.allclose(two, np.stack([moved, 2 * moved], axis=1))
    assert repr(weights) == "<calotte.Weights: 800 to 800 cells, conservative>"


def test_the_matrix_is_scipys(mesh):
    pytest.importorskip("scipy.sparse")
    weights = calotte.interpolation_weights(mesh, calotte.raster(12, 6))
    values = np.cos(np.arange(len(mesh)))
    assert weights.matrix.shape == (72, 800)
    assert np.allclose(weights.matrix @ values, weights.apply(values))
    assert np.allclose(weights.matrix.sum(axis=1), 1)


@pytest.mark.parametrize("format", ["esmf", "scrip"])
def test_files(mesh, tmp_path, format):
    weights = calotte.interpolation_weights(mesh, calotte.raster(12, 6), method="linear")
    weights.write(tmp_path / "w.nc", format=format)
    found = calotte.read_weights(tmp_path / "w.nc")
    values = np.cos(np.arange(len(mesh)))
    assert (found.apply(values) == weights.apply(values)).all()
    with pytest.raises(calotte.Error, match="use the file"):
        found.write(tmp_path / "again.nc")
    with pytest.raises(calotte.Error, match="esmf or scrip"):
        weights.write(tmp_path / "again.nc", format="csv")


def test_missing_values(mesh):
    part = calotte.raster(np.arange(10.0, 50, 2), np.arange(60.0, 20, -2))
    weights = calotte.interpolation_weights(part, mesh)
    moved = weights.apply(np.ones(len(part)))
    assert (np.isnan(moved) == (weights.target_fraction == 0)).all() and np.isnan(moved).sum() > 700
    whole = weights.apply(np.ones(len(part)), min_cover=0.999)
    assert np.isnan(whole).sum() > np.isnan(moved).sum()
    values = np.ones(len(part))
    values[:200] = np.nan
    assert np.isnan(weights.apply(values)).sum() > np.isnan(moved).sum()


def test_methods_and_files_of_meshes(mesh, tmp_path):
    boxes = calotte.raster(24, 12)
    for method in ("linear", "nearest", "natural"):
        found = calotte.interpolate(mesh, mesh.points[:, 2], boxes, method=method)
        assert np.abs(found.reshape(12, 24) - np.sin(np.radians(boxes.latitudes))[:, np.newaxis]).max() < 0.1
    calotte.write(tmp_path / "mesh.nc", mesh)
    calotte.cut(tmp_path / "mesh.nc", tmp_path / "part.nc", calotte.circle((0, 0), 30))
    part = calotte.read(tmp_path / "part.nc")
    moved = calotte.interpolate(part, np.ones(len(part)), boxes, method="conservative")
    assert 0 < np.isfinite(moved).sum() < len(boxes)


def test_weights_at_positions(mesh):
    pytest.importorskip("scipy.sparse")
    boxes, stations = calotte.raster(24, 12), [(-105.0, 40.0), (0.0, 51.5), (10.0, -89.0)]
    for source in (mesh, boxes):
        values = np.cos(np.arange(len(source)))
        for method in ("linear", "nearest"):
            weights = calotte.interpolation_weights(source, stations, method=method)
            assert weights.matrix.shape == (3, len(source))
            found = calotte.interpolate(source, values, stations, method=method)
            assert np.allclose(weights.matrix @ values, found) and (weights.apply(values) == found).all()
            assert repr(weights) == f"<calotte.Weights: {len(source)} to 3 positions, {method}>"
    assert (calotte.interpolate(mesh, np.arange(800.0), stations) ==
            calotte.interpolate(mesh, np.arange(800.0), stations, method="linear")).all()
    nearest = calotte.interpolate(mesh, np.arange(800), stations, method="nearest")
    assert (nearest == calotte.locate(mesh, stations).nearest).all()
    assert (calotte.interpolation_weights(mesh, stations).matrix.getnnz(axis=1) <= 3).all()
    sines = np.repeat(np.sin(np.radians(boxes.latitudes)), 24)
    assert calotte.interpolate(boxes, sines, stations) == pytest.approx(np.sin(np.radians([40, 51.5, -89])), abs=0.03)
    part = calotte.raster(np.arange(0.0, 50, 5), np.arange(20.0, 60, 5))
    assert np.isnan(calotte.interpolate(part, np.ones(len(part)), stations)).tolist() == [True, False, True]


def test_values_that_are_missing(mesh):
    values = np.ones((800, 2))
    values[:, 1] = np.nan
    stations = calotte.random_points(50)
    values[calotte.locate(mesh, stations).nearest, 0] = np.nan
    found = calotte.interpolate(mesh, values, stations)
    assert np.isnan(found[:, 1]).all() and np.nanmax(np.abs(found[:, 0] - 1)) < 1e-12


def test_errors(mesh):
    boxes = calotte.raster(24, 12)
    with pytest.raises(calotte.Error, match="no method cubic"):
        calotte.interpolation_weights(mesh, boxes, method="cubic")
    with pytest.raises(calotte.Error, match="nearest and linear only"):
        calotte.interpolation_weights(boxes, mesh, method="natural")
    with pytest.raises(calotte.Error, match="a grid is str"):
        calotte.interpolation_weights("mesh.nc", boxes)
    with pytest.raises(calotte.Error, match="for each of the 288 cells"):
        calotte.interpolation_weights(boxes, mesh).apply(np.ones(3))
    with pytest.raises(calotte.Error, match="one surface"):
        calotte.interpolation_weights(calotte.cvt(64, surface=calotte.periodic_box(1, 1)).mesh, boxes)
    with pytest.raises(calotte.Error, match=r"latitude\[2\]"):
        calotte.raster([0, 120, 240], [0, 10, 5])
    with pytest.raises(calotte.Error, match="no method conservative; give one of: linear, natural, nearest"):
        calotte.interpolation_weights(mesh, [(0, 0)], method="conservative")
    with pytest.raises(calotte.Error, match="latitude") as caught:
        calotte.interpolate(boxes, np.ones(288), [(0, 0), (0, 91)])
    assert caught.value.index == 1
    with pytest.raises(calotte.Error, match="not between two grids"):
        calotte.interpolation_weights(mesh, [(0, 0)]).write("never.nc")
    with pytest.raises(calotte.Error, match=r"shape \(3,\); give a number, or an array of them, for each of the 800"):
        calotte.interpolate(mesh, np.ones(3), boxes)
