# SPDX-License-Identifier: GPL-3.0-or-later
"""Careless mistakes: each ends in one line that names the argument, what it is and what to give."""
import inspect
import warnings

import numpy as np
import pytest

import calotte
from calotte import widths

MESH = calotte.delaunay(calotte.fibonacci_sphere(100))
POINTS = calotte.fibonacci_sphere(10)


@pytest.mark.parametrize("text, call", [
    ("mesh is 'f.nc'; give a Mesh or Polygons, such as read('f.nc')", lambda: calotte.check("f.nc")),
    ("mesh is 'f.nc'; give a Mesh or Polygons, such as read('f.nc')", lambda: calotte.quality("f.nc")),
    ("mesh is an array of the shape (10, 3); give a Mesh or Polygons, which delaunay() makes of points",
     lambda: calotte.voronoi(POINTS)),
    ("parts is 16.0; give a whole number", lambda: calotte.partition(MESH, 16.)),
    ("parts is a list; give a whole number", lambda: calotte.partition(MESH, [16, 32])),
    ("path is a Mesh; give the name of a file", lambda: calotte.write(MESH, "x.nc")),
    ("fields is an array of the shape (100,); give a dict",
     lambda: calotte.write("x.nc", MESH, fields=np.ones(100))),
    ("at is 3; give a dict", lambda: calotte.read("x.nc", at=3)),
    ("is '10'; give a whole number", lambda: calotte.fibonacci_sphere("10")),
    ("longitudes is the file topo.tif; give the DataArray", lambda: calotte.raster("topo.tif")),
    ("period: \"12.42\" is no time; give a number and its unit, s, min, h or d",
     lambda: widths.by_depth("sea.nc", 2, period="12.42", cells=60)),
    ("the cell width has the unit 'miles'; give km or m", lambda: calotte.plan("60 miles")),
    ("lower is 0; give a corner as (x, y)", lambda: calotte.rectangle(0, 0)),
    ("by_channel() cannot use an argument: coast is 'c.nc', least is 'x', cells is 3;",
     lambda: widths.by_channel("c.nc", "x", cells=3)),
])
def test_wrong_arguments(text, call):
    with pytest.raises(calotte.Error) as caught:
        call()
    assert text in str(caught.value)
    assert "\n" not in str(caught.value) and "incompatible" not in str(caught.value)


def test_misspelt_names_are_answered_with_the_nearest():
    with pytest.raises(TypeError, match="cvt.* 'cellwidth'; did you mean cell_width?"):
        calotte.cvt(cellwidth=60)
    with pytest.raises(TypeError, match="by_distance.* 'fat'; did you mean far?"):
        widths.by_distance([(0, 0), (1, 1)], near=1, fat=2, over=3)
    with pytest.raises(TypeError, match="check.*'mesh'; its arguments are mesh"):
        calotte.check()


def test_signatures_and_texts_stay():
    assert list(inspect.signature(calotte.check).parameters) == ["mesh"]
    assert calotte.check.__doc__.startswith("Proves that a mesh")
    assert calotte.partition(MESH, np.int32(4)).max() == 3
    assert len(calotte.delaunay(POINTS, merge_within=np.float32(0)).points) == 10


def test_errors_of_functions_of_the_user_stay():
    def fails(points):
        raise TypeError("mine")

    with pytest.raises(TypeError, match="mine"):
        calotte.cvt(100, density=fails)


def test_columns_come_first_and_degrees_are_no_radians():
    with pytest.warns(UserWarning, match="36 columns and 72 rows make boxes of 10 x 2.5 degrees"):
        calotte.raster(36, 72)
    lon, lat = np.radians(np.arange(-175., 180, 10)), np.radians(np.arange(-85., 90, 10))
    with pytest.warns(UserWarning, match="not radians") as record:
        calotte.raster(lon, lat)
    assert record[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        calotte.raster(72, 36)


def test_widths_and_times_have_the_units_of_the_command():
    assert calotte.plan("960000m").cells == calotte.plan("960km").cells == calotte.plan(960).cells
