# SPDX-License-Identifier: GPL-3.0-or-later
"""Every choice of a recipe has the bits of the command, and errors name what does not fit."""
import json
import os
import subprocess
import sys

import numpy as np
import pytest

import calotte
import recipe_caller

COMMAND = os.environ.get("CALOTTE_COMMAND", "calotte")
RECTANGLE, BOX = calotte.rectangle((0, 0), (2, 1)), calotte.periodic_box(2, 1)


def run(*words):
    result = subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True)
    assert result.returncode in (0, 1, 5), result.stderr


def refuses(text, call, *arguments, **words):
    with pytest.raises(calotte.Error) as caught:
        call(*arguments, **words)
    assert text in str(caught.value)
    return caught.value


# ---- The command's bits

@pytest.mark.parametrize("words, arguments", [
    (["--cells", 162, "--start", "icosahedron", "--bisections", 1],
     {"cells": 162, "start": "icosahedron", "bisections": 1}),
    (["--cells", 300, "--start", "geodesic"], {"cells": 300, "start": "geodesic"}),
    (["--cells", 300, "--start", "random", "--seed", 7, "--iterations", 5],
     {"cells": 300, "start": "random", "seed": 7, "iterations": 5}),
    (["--cells", 300, "--start", "fibonacci", "--method", "lloyd", "--iterations", 5],
     {"cells": 300, "start": "fibonacci", "method": "lloyd", "iterations": 5}),
    (["--cells", 300, "--start", "density", "--density", "x4", "--norm", "linf",
      "--tolerance", 1e-3],
     {"cells": 300, "start": "density", "density": "x4", "norm": "linf", "tolerance": 1e-3}),
    (["--cells", 300, "--density", "x4", "--insertion-rounds", 2],
     {"cells": 300, "density": "x4", "insertion_rounds": 2}),
    (["--cells", 300, "--stop", "well-centred"], {"cells": 300, "well_centred": True}),
    (["--cells", 200, "--region", "circle=-105,40,1000km", "--boundary", "generators"],
     {"cells": 200, "surface": "circle=-105,40,1000km", "boundary": "generators"}),
])
def test_on_the_sphere(tmp_path, words, arguments):
    run("cvt", *words, "-o", tmp_path / "a.vtp")
    file, mesh = calotte.read(tmp_path / "a.vtp"), calotte.cvt(**arguments).mesh
    assert (file.points == mesh.points).all() and (file.triangles == mesh.triangles).all()


def planar_widths(path):
    netcdf = pytest.importorskip("netCDF4")
    x, y = np.linspace(0, 2, 9), np.linspace(0, 1, 5)
    values = 0.06 + 0.04 * x + 0.02 * y[:, np.newaxis]
    with netcdf.Dataset(path, "w") as file:
        for name, axis in (("x", x), ("y", y)):
            file.createDimension(name, len(axis))
            file.createVariable(name, "f8", (name,))[:] = axis
        file.createVariable("cellWidth", "f8", ("y", "x"))[:] = values
    return values, x, y


def test_widths_of_a_plane(tmp_path):
    raster = planar_widths(tmp_path / "widths.nc")
    run("cvt", "--rectangle", "0,0,2,1", "--cell-width", tmp_path / "widths.nc", "-o",
        tmp_path / "a.vtp")
    expected = calotte.read(tmp_path / "a.vtp").points
    for given in (tmp_path / "widths.nc", str(tmp_path / "widths.nc"), raster):
        grid = calotte.cvt(cell_width=given, surface=RECTANGLE)
        assert (grid.mesh.points == expected).all() and grid.well_centred
    plan = calotte.plan(raster, surface=RECTANGLE)
    assert plan.cells == len(expected) and plan.start == "multilevel" and plan.gradient is None
    assert plan.widths == (raster[0].min(), raster[0].max())
    quality = calotte.quality(grid.mesh, cell_width=raster)
    assert quality.dc_over_h.p50 == pytest.approx(1, abs=0.05)
    grid.mesh.to_mpas(tmp_path / "grid.nc", cell_width=raster)


def test_a_width_of_a_plane(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    run("cvt", "--periodic", "2,1", "--cell-width", "0.1", "-o", tmp_path / "command.nc")
    for width in (0.1, "0.1"):
        grid = calotte.cvt(cell_width=width, surface=BOX)
        grid.mesh.to_mpas(tmp_path / "python.nc")
        with netcdf.Dataset(tmp_path / "command.nc") as a, \
                netcdf.Dataset(tmp_path / "python.nc") as b:
            assert len(grid.mesh) == a.dimensions["nCells"].size == 231
            assert all((a[name][:] == b[name][:]).all() for name in ("xCell", "yCell"))


def test_a_hexagonal_lattice():
    grid = calotte.cvt(200, surface=RECTANGLE, start="hexagonal", max_iterations=0)
    assert len(grid.mesh) == len(calotte.hexagonal_lattice(200, RECTANGLE))


@pytest.mark.parametrize("density", [None, "tanh:x=1,y=0.5,beta=0.3,alpha=0.2,gamma=x2"])
@pytest.mark.parametrize("walls", ["x", "y"])
def test_a_channel(tmp_path, walls, density):
    netcdf = pytest.importorskip("netCDF4")
    words = [] if density is None else ["--density", density]
    run("cvt", "--cells", 300, "--periodic", "2,1", "--walls", walls, *words, "-o",
        tmp_path / "command.nc")
    grid = calotte.cvt(300, surface=BOX, walls=walls, density=density)
    grid.cells.to_mpas(tmp_path / "python.nc")
    with netcdf.Dataset(tmp_path / "command.nc") as a, netcdf.Dataset(tmp_path / "python.nc") as b:
        for name in ("xCell", "yCell", "cellsOnCell", "meshDensity", "areaCell"):
            assert (a[name][:] == b[name][:]).all(), name
        assert len(grid.cells) == a.dimensions["nCells"].size < len(grid.mesh)
    k = "xy".index(walls)
    assert grid.cells.surface.period[k] == 0 and grid.mesh.surface.period[k] > BOX.period[k]
    assert calotte.check(grid.mesh) and len(grid.voronoi().cells) == len(grid.cells)
    assert repr(grid).startswith(f"<calotte.Cvt: {len(grid.cells)} cells")


def test_lines(tmp_path):
    lines = [[(-105, 47), (-90, 38)], [(-80, 40), (-90, 38)], [(-90, 38), (-90, 30)]]
    path = tmp_path / "rivers.geojson"
    path.write_text(json.dumps({"type": "MultiLineString", "coordinates": lines}))
    run("cvt", "--cell-width", "500km", "--fixed", path, "-o", tmp_path / "command.vtp")
    made = calotte.read(tmp_path / "command.vtp").points
    for given in (path, lines, [calotte.from_lonlat(*np.transpose(line)) for line in lines]):
        assert (calotte.cvt(cell_width=500, lines=given).mesh.points == made).all()
    assert (made[0] == calotte.from_lonlat(-90, 38)).all()  # where they meet
    refuses("line 0, point 1 is opposite", calotte.cvt, cell_width=500, lines=[[(0, 0), (180, 0)]])


def test_a_limited_area_with_fixed_points(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    (tmp_path / "fixed.txt").write_text("-105 40\n-104 41\n")
    run("cvt", "--region", "circle=-105,40,1000km", "--cell-width", "200km", "--limited-area",
        "--fixed", tmp_path / "fixed.txt", "--lonlat", "-o", tmp_path / "command.nc")
    counts = calotte.limited_area(tmp_path / "python.nc", "circle=-105,40,1000km", 200.0,
                                  fixed=[(-105, 40), (-104, 41)])
    with netcdf.Dataset(tmp_path / "command.nc") as a, netcdf.Dataset(tmp_path / "python.nc") as b:
        assert counts["cells"] == a.dimensions["nCells"].size
        for name in ("xCell", "bdyMaskCell", "meshDensity", "nominalMinDc"):
            assert (a[name][:] == b[name][:]).all(), name


# ---- The plan

def test_a_plan_is_what_runs():
    for words in ({"cells": 642}, {"cells": 2562, "density": "x8"},
                  {"cells": 400, "surface": BOX}, {"cells": 300, "start": "random"},
                  {"cells": 200, "surface": "circle=0,0,20deg"},
                  {"cells": 642, "start": "icosahedron", "bisections": 2, "iterations": 3}):
        plan, grid = calotte.plan(**words), calotte.cvt(**words)
        assert [(a.kind, a.cells, a.times, a.tolerance) for a in plan.actions] == [
            (a.kind, a.cells, a.times, a.tolerance) for a in grid.actions]
        assert plan.cells == len(grid.mesh) == plan.actions[-1].cells
        assert sum(a.iterations for a in grid.actions) == grid.iterations
        assert plan.widths is None and np.isnan(plan.least_km)
    assert calotte.plan(points=calotte.random_points(50)).start == "points"
    plan = calotte.plan(200.0, surface="circle=0,0,20deg", limited_area=True)
    assert plan.cells > calotte.plan(200.0, surface="circle=0,0,20deg").cells
    assert (plan.least_km, plan.greatest_km, plan.widths) == (200, 200, (200, 200))


# ---- Errors

def test_words():
    refuses("no start cube; give one of: automatic, points", calotte.cvt, 100, start="cube")
    refuses("give the number of cells as cells=, the generators to begin with as points=", calotte.cvt, start=100)
    refuses("shape (50, 3); give the generators to begin with as points=", calotte.cvt, calotte.random_points(50))
    refuses("points give the number of cells", calotte.cvt, 50, points=calotte.random_points(50))
    refuses("no method newton; give one of: auto, lloyd", calotte.cvt, 100, method="newton")
    refuses("no boundary open; give one of: clip, generators", calotte.cvt, 100, boundary="open")
    refuses("no rule for duplicates keep", calotte.cvt, 100, duplicates="keep")
    refuses("no walls z", calotte.cvt, 100, surface=BOX, walls="z")
    for words in ({"start_kind": "random"}, {"region": "circle=0,0,20deg"}, {"domain": BOX}):
        with pytest.raises(TypeError, match="unexpected keyword argument"):
            calotte.plan(cells=100, **words)
        with pytest.raises(TypeError, match="unexpected keyword argument"):
            calotte.cvt(100, **words)


def test_what_does_not_fit():
    points = calotte.random_points(50)
    refuses("norm none", calotte.cvt, 100, norm="none")
    refuses("sphere only", calotte.cvt, 100, surface=BOX, start="geodesic")
    refuses("plane only", calotte.cvt, 100, start="hexagonal")
    refuses("the start has points", calotte.cvt, points=points, start="random")
    refuses("the start has no points", calotte.cvt, points=np.empty((0, 3)))
    refuses("the number of cells is 0", calotte.cvt, 0, cell_width=500.0)
    refuses("chooses the bisections", calotte.cvt, 100, start="multilevel", bisections=1)
    refuses("multilevel only", calotte.cvt, 642, insertion_rounds=1)
    refuses("1 or more", calotte.cvt, 642, iterations=0)
    refuses("limited area", calotte.cvt, cell_width=200.0, limited_area=True)
    refuses("a bounded surface only", calotte.cvt, 100, boundary="generators")
    refuses("periodic box", calotte.cvt, 100, surface=RECTANGLE, walls="y")
    refuses("no period", calotte.cvt, 100, surface=BOX, walls="xy")
    assert refuses("", calotte.cvt, points=points[[0, *range(50)]], duplicates="refuse").index == 1
    assert refuses("fixed point 99", calotte.cvt, 100, fixed=calotte.random_points(100)).index == 99


def test_widths_of_a_plane_that_are_none():
    refuses("unit of its coordinates", calotte.cvt, cell_width="1km", surface=BOX)
    refuses("y x x", calotte.cvt, cell_width=(np.ones((2, 3)), [0, 1], [0, 1, 2]), surface=BOX)
    refuses("not positive", calotte.cvt, cell_width=lambda x, y: x, surface=BOX)
    refuses("one number for each", calotte.cvt, cell_width=lambda x, y: x[0], surface=BOX)
    refuses("(values, x, y)", calotte.cvt, cell_width=(1, 2), surface=BOX)
    refuses("", calotte.cvt, cell_width=(0.1 * np.ones((2, 2)), [0, 1], [0, 1]), surface=BOX)
    refuses("not both", calotte.cvt, cell_width=0.1, density="uniform", surface=BOX)
    refuses("no-such.nc", calotte.cvt, cell_width="no-such.nc", surface=BOX)


# ---- The program that compares callers

@pytest.mark.parametrize("request_", ["uniform", "walls", "points"])
def test_the_caller_writes_what_it_makes(tmp_path, request_):
    subprocess.run([sys.executable, recipe_caller.__file__, request_, str(tmp_path / "a")],
                   check=True)
    points = np.fromfile(tmp_path / "a").reshape(-1, 3)
    assert (points == recipe_caller.generators(request_)).all()
    assert (points[:, 2] == 0).all() == (request_ == "walls")
