# SPDX-License-Identifier: GPL-3.0-or-later
"""Values at scattered points."""
import numpy as np
import pytest

import calotte

METHODS = ("linear", "natural", "nearest")


def stations(n, seed=1):
    random = np.random.default_rng(seed)
    return np.stack([random.uniform(-180, 180, n), np.degrees(np.arcsin(random.uniform(-1, 1, n)))], axis=1)


def test_values_at_the_points_and_shapes():
    points = stations(300)
    values = np.random.default_rng(2).normal(size=(3, 300))
    for method in METHODS:
        found = calotte.interpolate_scattered(points, values, points, method=method)
        assert found.shape == (3, 300) and np.abs(found - values).max() < 1e-12
        one = calotte.interpolate_scattered(points, values[1], points[:7], method=method)
        assert one.shape == (7,) and np.abs(one - values[1, :7]).max() < 1e-12
        vectors = calotte.from_lonlat(*points.T)
        assert (calotte.interpolate_scattered(2 * vectors, values[1], vectors[:7], method=method) == one).all()


def test_targets():
    points = stations(400)
    values = np.sin(np.radians(points[:, 1]))
    boxes, mesh = calotte.raster(36, 18), calotte.delaunay(calotte.fibonacci_sphere(500))
    for method in METHODS:
        found = calotte.interpolate_scattered(points, values, boxes, method=method)
        assert found.shape == (648,)
        assert (calotte.interpolate_scattered(points, values, (36, 18), method=method) == found).all()
        assert np.abs(found.reshape(18, 36) - np.sin(np.radians(boxes.latitudes))[:, np.newaxis]).max() < 0.25
        assert calotte.interpolate_scattered(points, values, mesh, method=method).shape == (500,)


def test_missing_values_and_duplicates():
    points = stations(200)
    values = np.ones((2, 200))
    values[1] = 3
    values[1, ::3] = np.nan
    found = calotte.interpolate_scattered(points, values, stations(50, 5))
    assert np.abs(found[0] - 1).max() < 1e-14 and np.abs(found[1] - 3).max() < 1e-14
    double = np.concatenate([points, [points[0], points[0], (0, 90), (50, 90)]])
    values = np.concatenate([np.arange(200.0), [6, 9, 1, 3]])
    with pytest.warns(UserWarning, match="3 points had the position of an earlier one"):
        at = calotte.interpolate_scattered(double, values, [points[0], (-70, 90)], method="natural")
    assert at.tolist() == [5, 2]


def test_the_plane_and_its_hull():
    random = np.random.default_rng(3)
    points, at = random.uniform(0, 1, (500, 2)), random.uniform(0.1, 0.9, (200, 2))
    for method in ("linear", "natural"):
        found = calotte.interpolate_scattered(points, points @ [2, -1] + 5, at, method=method, surface=calotte.plane())
        assert np.abs(found - (at @ [2, -1] + 5)).max() < 1e-12
        outside = calotte.interpolate_scattered(points, points[:, 0], [(3, 3)], method=method, surface=calotte.plane())
        assert np.isnan(outside).all()
    nearest = calotte.interpolate_scattered(points, np.arange(500), at * 2, method="nearest", surface=calotte.plane())
    assert (nearest == ((at[:, np.newaxis] * 2 - points) ** 2).sum(axis=2).argmin(axis=1)).all()


def test_arguments_are_refused():
    points = stations(10)
    for arguments, message in (
            ((points, np.ones(9), points), "values have the shape"),
            ((points, np.ones((2, 2, 10)), points), "values have the shape"),
            ((points, np.full(10, np.inf), points), "is infinite; give NaN"),
            ((points, np.full(10, np.nan), points), "has no values; leave it out"),
            ((points[:2], np.ones(2), points), "fewer than 3 distinct positions"),
            (([(0, 0), (10, 0), (20, 0)], np.ones(3), points), "on one great circle"),
            ((points, np.ones(10), "720x360"), "give the columns and rows of a raster as"),
            ((points, np.ones(10), (36.5, 18)), "whole number"),
            ((points, np.ones(10), calotte.delaunay(np.random.default_rng(1).uniform(0, 1, (9, 2)), calotte.plane())),
             "give grids of one surface")):
        with pytest.raises(calotte.Error, match=message):
            calotte.interpolate_scattered(*arguments)
    with pytest.raises(calotte.Error, match="no method conservative"):
        calotte.interpolate_scattered(points, np.ones(10), points, method="conservative")
    bad = calotte.from_lonlat(*points.T)
    bad[4] = np.nan
    with pytest.raises(calotte.Error, match="position 4"):
        calotte.interpolate_scattered(bad, np.ones(10), points)
