# SPDX-License-Identifier: GPL-3.0-or-later
"""The package's own functions: laws of the results, memory, threads, and the command's bits."""
import gc
import math
import os
import pathlib
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import calotte

COMMAND = os.environ.get("CALOTTE_COMMAND", "calotte")


def run(*words):
    result = subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return result.stdout


def resident():
    text = pathlib.Path("/proc/self/statm").read_text().split()
    return int(text[1]) * resource.getpagesize()


def test_a_triangulation_is_that_of_the_command(tmp_path):
    points = calotte.random_points(2000, seed=3)
    np.savetxt(tmp_path / "points.txt", points, fmt="%.17g")
    run("delaunay", tmp_path / "points.txt", "-o", tmp_path / "mesh.txt")
    mesh = calotte.delaunay(points)
    assert (np.loadtxt(tmp_path / "mesh.txt", dtype=int) == mesh.triangles).all()
    assert mesh.closed and len(mesh) == 2000 and calotte.check(mesh)


@pytest.mark.parametrize("words, arguments", [
    (["--cells", "642"], {"cells": 642}),
    (["--cells", "1000", "--density", "tanh:lon=270,lat=30,beta=30deg,alpha=0.2,gamma=x8"],
     {"cells": 1000, "density": "x8"}),
    (["--cells", "300", "--region", "circle=-105,40,1000km"],
     {"cells": 300, "surface": calotte.circle((-105, 40), math.degrees(1000 / 6371))}),
])
def test_a_grid_has_the_bits_of_the_command(tmp_path, words, arguments):
    run("cvt", *words, "-o", tmp_path / "grid.vtp")
    grid = calotte.cvt(**arguments)
    file = calotte.read(tmp_path / "grid.vtp")
    assert (file.points == grid.mesh.points).all()
    assert (file.triangles == grid.mesh.triangles).all()


def test_widths_have_the_bits_of_the_command(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    lon, lat = np.arange(-180, 180, 3.0), np.linspace(-90, 90, 61)
    widths = 300 + 200 * np.sin(np.radians(lat))[:, np.newaxis] * np.ones(len(lon))
    with netcdf.Dataset(tmp_path / "widths.nc", "w") as file:
        file.createDimension("lat", len(lat))
        file.createDimension("lon", len(lon))
        file.createVariable("lat", "f8", ("lat",))[:] = lat
        file.createVariable("lon", "f8", ("lon",))[:] = lon
        file.createVariable("cellWidth", "f8", ("lat", "lon"))[:] = widths
    run("cvt", "--cell-width", tmp_path / "widths.nc", "-o", tmp_path / "grid.vtp")
    expected = calotte.read(tmp_path / "grid.vtp").points
    for given in (tmp_path / "widths.nc", (widths, lon, lat), (widths[::-1], lon, lat[::-1])):
        grid = calotte.cvt(cell_width=given)
        assert grid.well_centred and (grid.mesh.points == expected).all()


def test_widths_of_every_kind():
    assert calotte.plan(120.0).cells == 40962
    by_function = calotte.plan(lambda lon, lat: 300 + 200 * np.sin(np.radians(lat)))
    lon, lat = np.arange(-180, 180, 0.25), np.linspace(-90, 90, 721)
    values = 300 + 200 * np.sin(np.radians(lat))[:, np.newaxis] * np.ones(len(lon))
    by_values = calotte.plan((values, lon, lat))
    assert by_function == by_values and 2000 < by_values.cells < 20000
    xarray = pytest.importorskip("xarray")
    array = xarray.DataArray(values.T, dims=("lon", "lat"), coords={"lon": lon, "lat": lat})
    assert calotte.plan(array) == by_values


def test_a_density_function_is_a_density():
    def density(points):
        return np.where(points[:, 2] > 0, 1.0, 1.0 / 16)

    grid = calotte.cvt(800, density=density)
    north = (grid.mesh.points[:, 2] > 0).sum()
    assert grid.converged and 600 < north < 680  # 4 to 1
    quality = calotte.quality(grid.mesh, density=density)
    assert quality.cells == 800 and quality.dc_over_h.p50 == pytest.approx(1, abs=0.05)


def test_cells_of_the_sphere_and_the_plane():
    cells = calotte.voronoi(calotte.delaunay(calotte.random_points(300)))
    assert cells.cell_area.sum() == pytest.approx(4 * math.pi, abs=1e-12)
    assert cells.begin[-1] == 2 * len(cells.edges) == 6 * (300 - 2)
    grid = calotte.cvt(200, surface=calotte.rectangle((0, 0), (2, 1)))
    plane = calotte.voronoi(grid.mesh)
    assert plane.cell_area.sum() == pytest.approx(2, abs=1e-12)
    surface = calotte.periodic_box(2, 1)
    box = calotte.delaunay(calotte.random_points(200, surface), surface)
    assert len(box.triangles) == 400 and calotte.check(box)
    assert calotte.quality(box).cells == 200


def test_errors_of_operators():
    errors = calotte.operator_errors(calotte.cvt(642).mesh)
    assert 0 < errors.gradient.l2 < errors.divergence.l2 < errors.divergence.max < 0.1
    by_cell = errors.tangential_by_cell
    assert by_cell[errors.tangential.cell] == by_cell.max() == errors.tangential.max
    assert errors.dual_eigenvalue > 3 * errors.primal_eigenvalue
    assert np.linalg.norm(errors.curl.position) == pytest.approx(1)
    surface = calotte.periodic_box(2, 1)
    box = calotte.delaunay(calotte.random_points(200, surface), surface)
    assert np.isfinite(calotte.operator_errors(box).divergence_by_cell).all()


def test_regions():
    region = calotte.polygon([(0, 0), (90, 0), (0, 90)])
    assert region.area == pytest.approx(math.pi / 2)
    closed = [(0, 0), (90, 0), (0, 90), (0, 0)]
    for ring in closed, closed[::-1], np.array(closed, float):
        assert calotte.polygon(ring).area == pytest.approx(math.pi / 2)
    assert calotte.polygon(closed, inside=(180, 0)).area == pytest.approx(3.5 * math.pi)
    around = [(-180, 60), (-120, 60), (-60, 60), (0, 60), (60, 60), (120, 60)]
    cut = around + [(180, 60 + 1e-13), (180, 90), (-180, 90)]
    assert calotte.polygon(cut).area == pytest.approx(calotte.polygon(around).area)
    assert calotte.polygon(cut).contains(calotte.from_lonlat([180, 0], [75, 0])).tolist() == [True, False]
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    assert calotte.planar_polygon(square + square[:1]).area == calotte.planar_polygon(square).area
    inside = calotte.random_points(100, surface=region)
    assert region.contains(inside).all() and not region.contains(-inside).any()
    grid = calotte.cvt(200, surface=region)
    assert region.contains(grid.mesh.points).all() and not grid.mesh.closed
    assert calotte.quality(grid.mesh).triangles == len(grid.mesh.triangles)


def test_files(tmp_path):
    grid = calotte.cvt(642)
    calotte.write(tmp_path / "grid.nc", grid.mesh, sphere_radius=6371229.0,
                  fields={"height": np.arange(642.0)})
    run("check", tmp_path / "grid.nc")
    again = calotte.read(tmp_path / "grid.nc")
    assert len(again) == 642 and calotte.check(again)
    height = calotte.read_fields(tmp_path / "grid.nc")["height"]
    assert sorted(height) == list(range(642))
    cut = calotte.cut(tmp_path / "grid.nc", tmp_path / "cut.nc", calotte.circle((0, 0), 30))
    assert 0 < cut["cells"] < 642
    grid.mesh.to_mpas(tmp_path / "again.nc")
    dataset = pytest.importorskip("xarray") and grid.mesh.to_xarray()
    assert dataset.sizes["nCells"] == 642


def test_a_density_that_is_not_given_follows_from_the_cells(tmp_path):
    grid = calotte.cvt(2562, density="x8")
    for density in (None, "x8"):
        grid.mesh.to_mpas(tmp_path / "grid.nc", density=density)
        run("check", tmp_path / "grid.nc")  # compares meshDensity with the cells
    grid.mesh.to_mpas(tmp_path / "grid.nc", density="uniform")
    with pytest.raises(AssertionError, match="1 variable deviates"):
        run("check", tmp_path / "grid.nc")


def test_a_limited_area_is_that_of_the_command(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    run("cvt", "--region", "circle=-105,40,1000km", "--cell-width", "150km", "--limited-area",
        "-o", tmp_path / "command.nc")
    region = calotte.circle((-105, 40), math.degrees(1000 / 6371))
    counts = calotte.limited_area(tmp_path / "python.nc", region, 150.0)
    assert counts["cells"] == sum(counts["cells_by_mask"]) and len(counts["cells_by_mask"]) == 8
    with netcdf.Dataset(tmp_path / "command.nc") as a, netcdf.Dataset(tmp_path / "python.nc") as b:
        for name in ("xCell", "cellsOnCell", "bdyMaskCell", "meshDensity"):
            assert (a[name][:] == b[name][:]).all(), name


def test_topology_is_what_uxarray_takes():
    mesh = calotte.delaunay(calotte.fibonacci_sphere(200))
    topology = mesh.topology()
    faces = topology["face_node_connectivity"]
    assert faces.shape[0] == 200 and len(topology["node_lon"]) == 396
    assert ((faces >= -1) & (faces < 396)).all() and (faces[:, :3] >= 0).all()


def test_a_mesh_shows_itself():
    for mesh in (calotte.delaunay(calotte.random_points(100)),
                 calotte.delaunay(calotte.random_points(20000)),
                 calotte.delaunay(calotte.random_points(100)[:, :2], calotte.plane())):
        html = mesh._repr_html_()
        assert html.count("M") > 50 and len(html) < 150_000 and "nan" not in html
        assert f"{len(mesh)} sites" in repr(mesh)


def test_arrays_outlive_their_mesh_and_cannot_be_written():
    mesh = calotte.delaunay(calotte.random_points(5000))
    points, triangles = mesh.points, mesh.triangles
    sums = points.sum(), triangles.sum()
    del mesh
    gc.collect()
    calotte.delaunay(calotte.random_points(5000, seed=2))
    assert (points.sum(), triangles.sum()) == sums
    with pytest.raises(ValueError):
        points[0] = 0


def test_memory_does_not_grow():
    def make():
        mesh = calotte.delaunay(calotte.random_points(20000))
        calotte.voronoi(mesh)
        calotte.cvt(200)

    for _ in range(20):
        make()
    before = resident()
    for _ in range(100):
        make()
    assert resident() - before < 30e6


def test_no_copy_of_input_in_place():
    points = calotte.random_points(1000)
    points.flags.writeable = False  # accepted as it is
    assert (calotte.delaunay(points).points == points).all()
    assert (calotte.delaunay(np.asfortranarray(points)).points == points).all()
    single = points.astype(np.float32)
    assert (calotte.delaunay(single).points == single).all()


def test_four_threads_of_python_at_once():
    expected = calotte.cvt(500, density="x4").mesh.points
    results = [None] * 4

    def work(k):
        with calotte.threads(1 + k % 2):
            results[k] = calotte.cvt(500, density="x4").mesh.points

    workers = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert all((result == expected).all() for result in results)


def test_the_interpreter_runs_beside_a_run():
    ticks, done = [], threading.Event()

    def tick():
        while not done.wait(0.01):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    calotte.cvt(10242, density="x8")
    done.set()
    thread.join()
    assert len(ticks) > 5


def test_progress_ends_a_run():
    seen = []

    def progress(now):
        seen.append(now["iterations"])
        return len(seen) == 5

    grid = calotte.cvt(642, progress=progress)
    assert len(seen) == 5 and not grid.converged and len(grid.mesh) >= 12
    with pytest.raises(KeyError):
        calotte.cvt(642, progress=lambda now: now["no such word"])


def test_interrupt_ends_a_run():
    code = ("import calotte, sys\n"
            "try:\n"
            "    calotte.cvt(200000, density='x8', progress=lambda now: print(flush=True))\n"
            "except KeyboardInterrupt:\n"
            "    sys.exit(7)\n")
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=60) == 7
    process.stdout.close()
