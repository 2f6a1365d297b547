# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input, each with its exception and message."""
import math

import numpy as np
import pytest

import calotte


def refuses(text, call, *arguments, **words):
    with pytest.raises(ValueError) as caught:
        call(*arguments, **words)
    assert isinstance(caught.value, calotte.Error)
    assert text in str(caught.value) and "\n" not in str(caught.value)
    return caught.value


def test_shapes_and_types():
    refuses("shape (5,)", calotte.delaunay, np.zeros(5))
    refuses("shape (4, 4)", calotte.delaunay, np.zeros((4, 4)))
    refuses("must be numbers", calotte.delaunay, [["a", "b", "c"]] * 4)
    refuses("must be numbers", calotte.delaunay, np.ones((4, 3), dtype=complex))
    refuses("n x 2 for a surface in the plane", calotte.delaunay, np.ones((4, 3)),
            calotte.periodic_box(2, 1))


def test_points():
    points = calotte.random_points(10)
    points[7, 1] = math.nan
    error = refuses("point 7", calotte.delaunay, points)
    assert (error.code, error.index) == ("not_finite", 7)
    points[7] = 0
    assert refuses("", calotte.delaunay, points).code == "zero_vector"
    assert refuses("", calotte.delaunay, points[:2]).code == "too_few_sites"
    assert len(calotte.delaunay(points[:3]).triangles) == 1
    points[7] = points[2]
    error = refuses("", calotte.delaunay, points, duplicates="refuse")
    assert (error.code, error.index) == ("duplicate", 7)
    refuses("merge or refuse", calotte.delaunay, points, duplicates="keep")
    circle = [(math.cos(a), math.sin(a), 0) for a in range(6)]
    assert refuses("", calotte.delaunay, circle).code == "degenerate"


def test_longitudes_and_latitudes():
    places = np.stack([np.linspace(-180, 180, 200), np.linspace(-90, 90, 200)], axis=1)
    places[5, 1] = 91
    error = refuses("point 5", calotte.delaunay, places)
    assert error.index == 5
    places[5, 1] = 80
    mesh, same = calotte.delaunay(places, "circle=0,0,90deg"), calotte.from_lonlat(*places.T)
    assert (mesh.points == same).all() and mesh.surface.is_bounded
    assert calotte.delaunay(places).surface.is_sphere
    assert not calotte.delaunay(places, calotte.plane()).surface.is_sphere
    rng = np.random.default_rng(1)
    radians = np.stack([rng.uniform(-np.pi, np.pi, 300), rng.uniform(-1.5, 1.5, 300)], axis=1)
    with pytest.warns(UserWarning, match="not radians"):
        calotte.delaunay(radians)


def test_functions_of_the_user():
    def fails(points):
        raise LookupError("no data there")

    with pytest.raises(LookupError, match="no data there"):
        calotte.cvt(100, density=fails)
    refuses("one number for each", calotte.cvt, 100, density=lambda points: np.ones(3))
    refuses("", calotte.cvt, 100, density=lambda points: -np.ones(len(points)))
    refuses("", calotte.cvt, 100, density=lambda points: np.full(len(points), np.nan))
    refuses("shape", calotte.plan, lambda lon, lat: np.ones(7))
    refuses("", calotte.plan, lambda lon, lat: -np.ones(lon.shape))


def test_widths_and_densities():
    lon, lat = np.arange(0, 360, 10.0), np.linspace(-90, 90, 19)
    good = np.full((19, 36), 500.0)
    refuses("latitudes x longitudes", calotte.plan, (good.T, lon, lat))
    bad = good.copy()
    bad[3, 4] = math.nan
    refuses("", calotte.plan, (bad, lon, lat))
    refuses("", calotte.plan, (0 * good, lon, lat))
    refuses("12 to 1073741824", calotte.plan, (good / 1e9, lon, lat))
    with pytest.warns(UserWarning, match="not radians"):
        refuses("leaves part of the sphere out; give a global raster in degrees", calotte.plan,
                (good, np.radians(lon), np.radians(lat)))
    refuses("no density y8", calotte.cvt, 100, density="y8")
    refuses("no parameter bta", calotte.cvt, 100, density="tanh:bta=1")
    refuses("could not convert", calotte.cvt, 100, density="tanh:lon=east")
    refuses("alpha is '5km'; give radians, or degrees such as 30deg", calotte.cvt, 100, density="tanh:alpha=5km")
    refuses("not both", calotte.cvt, 100, density="x8", cell_width=500.0)
    refuses("give cell widths as", calotte.cvt, cell_width=object())
    refuses("no-such.nc", calotte.cvt, cell_width="no-such.nc")


def test_options():
    refuses("whole number", calotte.cvt, 100.5)
    refuses("12", calotte.cvt, 3)
    refuses("no method newton", calotte.cvt, 100, method="newton")
    refuses("no norm", calotte.cvt, 100, norm="l7")
    refuses("", calotte.cvt, 100, tolerance=-1.0)
    refuses("", calotte.cvt, 100, tolerance=0.0)
    refuses("there is no number of cells; give one", calotte.cvt)
    refuses("seed is -1, which is out of range", calotte.cvt, 100, seed=-1)
    refuses("give surface=", calotte.quality, calotte.delaunay(np.eye(3)[:, :2], calotte.plane()))
    refuses("1 or more", calotte.threads(0).__enter__)
    refuses("", calotte.polygon, [(0, 0), (10, 0), (0, 10), (10, 10)])
    refuses("no format", calotte.write, "x.nc", calotte.delaunay(calotte.random_points(9)),
            format="shp")


def test_masked_values_are_missing():
    mesh = calotte.cvt(642).mesh
    north = mesh.points[:, 2] > 0
    masked = np.ma.masked_where(north, np.where(north, 1e20, 1.0))
    south = calotte.interpolate(mesh, masked, [(10.0, -60.0), (20.0, -50.0), (10.0, 60.0)])
    assert south[:2] == pytest.approx([1, 1]) and np.isnan(south[2])
    boxes = calotte.raster(36, 18)
    field = np.ma.masked_greater(np.repeat([1.0, 1e20], 324), 1e19)
    assert np.nanmax(calotte.interpolation_weights(boxes, mesh).apply(field)) == pytest.approx(1)
    with pytest.raises(calotte.Error, match="weight"):
        calotte.partition(mesh, 2, weights=np.ma.masked_where(north, np.ones(642)))
    with pytest.raises(calotte.Error):
        calotte.delaunay(np.ma.masked_where(np.arange(12).reshape(4, 3) == 5, np.ones((4, 3))))


@pytest.mark.parametrize("text, call", [
    ("latitudes are -91 and 3; give the lower one first, -90 to 90 degrees", lambda: calotte.channel(-91, 3)),
    ("the radius is -10; give a positive number of degrees", lambda: calotte.circle((0, 0), -10)),
    ("the centre has the latitude 95; give a longitude, then a latitude of -90 to 90 degrees",
     lambda: calotte.circle((0, 95), 10)),
    ("the Earth's radius is -3; give a positive number of km", lambda: calotte.circle((0, 0), "10km", earth_radius=-3)),
    ("give the major one first, below 90 degrees", lambda: calotte.ellipse((0, 0), 10, 20)),
    ("the bearing of the ellipse is nan; give degrees", lambda: calotte.ellipse((0, 0), 20, 10, math.nan)),
    ("the cell width -3 is not a positive number; give km", lambda: calotte.plan(-3)),
    ("in the unit of the points", lambda: calotte.periodic_box(-1, 2)),
    ("near is -1; give a positive number of km",
     lambda: calotte.widths.by_distance([(0, 0), (1, 1)], near=-1, far=5, over=10)),
    ("over is -5; give a positive number of km", lambda: calotte.widths.share("circle=0,0,10deg", over=-5)),
    ("give 0 radians or more", lambda: calotte.delaunay(calotte.random_points(50), merge_within=-1)),
    ("such as plane()", lambda: calotte.delaunay([(5.0, 4000.0), (1, 2), (3, 4), (5, 6)])),
])
def test_messages_name_the_unit_of_an_argument(text, call):
    refuses(text, call)
