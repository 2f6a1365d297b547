# SPDX-License-Identifier: GPL-3.0-or-later
"""The command and Python take the same words and make the same of them."""
import json
import math
import os
import subprocess

import numpy as np
import pytest

import calotte

COMMAND = os.environ.get("CALOTTE_COMMAND", "calotte")


def run(*words):
    return subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True)


def made(*words):
    result = run(*words)
    assert result.returncode in (0, 1), result.stderr
    return result


REGIONS = ["circle=-105,40,1000km", "circle=-105,40,1000 km", "circle=-105,40,1000000m",
           "circle=-105,40,9deg", "ellipse=138,38,1580km,1000km,45", "channel=-23.5,23.5",
           "box=-20,30,40,60", "box=170,-20,-170,0", "box=-20,60,40,90", "box=-180,10,180,50"]


@pytest.mark.parametrize("word", REGIONS)
def test_regions(tmp_path, word):
    made("cvt", "--cells", 60, "--region", word, "--max-iterations", 2, "-o", tmp_path / "a.vtp")
    file = calotte.read(tmp_path / "a.vtp")
    grid = calotte.cvt(60, surface=word, max_iterations=2)
    assert (file.points == grid.mesh.points).all()


@pytest.mark.parametrize("word", ["circle=-105,40", "circle=-105,40,1000", "circle=-105,95,10deg",
                                  "circle=-105,40,-3km", "circle=a,40,10km", "circle=0,0,10miles",
                                  "ellipse=138,38,1580km,1000km", "channel=10", "square=1,2",
                                  "box=0,40,20,20", "box=10,0,10,20", "box=-180,-90,180,90", "box=1,2,3",
                                  "circle(-105,40,1000km)", "bbox=0,0,20,20", "europe",
                                  "channel=-91,3"])
def test_words_that_are_no_region(word):
    result = run("cvt", "--cells", 60, "--region", word, "-o", "never.vtp")
    assert result.returncode != 0, "the command takes it"
    with pytest.raises(calotte.Error):
        calotte.cvt(60, surface=word)


def test_a_radius_has_the_units_of_the_command():
    degrees = 1000 / calotte._arguments.EARTH_RADIUS_KM * 180 / np.pi
    for radius in ("1000km", "1000 km", "1000000m", f"{degrees}deg", degrees):
        assert calotte.circle((-105, 40), radius).area == pytest.approx(
            calotte.circle((-105, 40), "1000km").area, rel=1e-12)
    assert calotte.circle((0, 0), "100km", earth_radius=1000).area == pytest.approx(
        calotte.circle((0, 0), 0.1 * 180 / np.pi).area, rel=1e-12)
    assert calotte.ellipse((0, 0), "1000km", "500km", 30).area == pytest.approx(
        calotte.ellipse((0, 0), degrees, degrees / 2, 30).area, rel=1e-12)
    for radius in ("1000", "10 miles", "-3km", "far", 0, -1.0):
        with pytest.raises(calotte.Error):
            calotte.circle((0, 0), radius)


def test_a_box_is_the_surface_of_its_word():
    assert calotte.box(-20, 30, 40, 60) == calotte._arguments.surface("box=-20,30,40,60")
    area = math.radians(60) * (math.sin(math.radians(60)) - math.sin(math.radians(30)))
    assert calotte.box(-20, 30, 40, 60).area == pytest.approx(area, rel=1e-7)


DENSITIES = [["uniform"], ["x8"], ["x4"], ["tanh:lon=0,lat=-20,beta=20deg,alpha=10deg,gamma=x3"],
             ["tanh:lon=100,lat=40,beta=0.5,alpha=0.2,gamma=0.01,stretch=2,azimuth=30"],
             ["x4", "tanh:lon=0,lat=-20,beta=20deg,alpha=0.2,gamma=x3"]]


@pytest.mark.parametrize("join", ["maximum", "sum"])
@pytest.mark.parametrize("words", DENSITIES)
def test_densities(tmp_path, words, join):
    if len(words) == 1 and join == "sum":
        return
    options = [option for word in words for option in ("--density", word)]
    made("cvt", "--cells", 200, *options, "--join", join, "--max-iterations", 3, "-o",
         tmp_path / "a.vtp")
    rho = words[0] if len(words) == 1 else calotte.density(*words, join=join)
    grid = calotte.cvt(200, density=rho, max_iterations=3)
    assert (calotte.read(tmp_path / "a.vtp").points == grid.mesh.points).all()


def test_densities_of_the_plane(tmp_path):
    word = "tanh:x=1.5,y=0.5,beta=0.3,alpha=0.2,gamma=x3,stretch=2,angle=30"
    made("cvt", "--cells", 200, "--rectangle", "0,0,2,1", "--density", word, "--max-iterations", 3,
         "-o", tmp_path / "a.vtp")
    grid = calotte.cvt(200, surface=calotte.rectangle((0, 0), (2, 1)), density=word,
                       max_iterations=3)
    file = np.array(subprocess.run(
        [COMMAND, "convert", "--plane", tmp_path / "a.vtp", tmp_path / "a.off"],
        capture_output=True, text=True).returncode)
    assert file == 0
    lines = (tmp_path / "a.off").read_text().split("\n")
    points = np.array([line.split()[:2] for line in lines[2:2 + 200]], dtype=float)
    assert (points == grid.mesh.points).all()


@pytest.mark.parametrize("word", ["y8", "x", "x1", "x0.5", "tanh:lon=0,lat=0,beta=1,alpha=1,gamma=2",
                                  "tanh:lon=0,lat=0,beta=-1,alpha=1,gamma=x2",
                                  "tanh:lon=0,lat=91,beta=1,alpha=1,gamma=x2",
                                  "tanh:lon=0,lat=0,beta=1,alpha=1,gamma=x2,stretch=2",
                                  "tanh:lon=0,lat=0,beta=1,alpha=1,gamma=x2,wide=2"])
def test_words_that_are_no_density(word):
    assert run("cvt", "--cells", 60, "--density", word, "-o", "never.vtp").returncode == 2
    with pytest.raises(calotte.Error):
        calotte.cvt(60, density=word)


@pytest.mark.parametrize("width, command", [("900km", "900km"), ("900 km", "900 km"),
                                            ("900", "900"), (900, "900km")])
def test_widths(tmp_path, width, command):
    made("cvt", "--cell-width", command, "--max-iterations", 2, "-o", tmp_path / "a.vtp")
    grid = calotte.cvt(cell_width=width, max_iterations=2)
    assert (calotte.read(tmp_path / "a.vtp").points == grid.mesh.points).all()


@pytest.mark.parametrize("width", ["900furlongs", "-3km", "0"])
def test_widths_of_no_length(width):
    assert run("cvt", "--cell-width", width, "-o", "never.vtp").returncode == 2
    with pytest.raises(calotte.Error):
        calotte.cvt(cell_width=width)


def rasters(folder, unit, lon, lat, scale=1.0):
    netcdf = pytest.importorskip("netCDF4")
    xarray = pytest.importorskip("xarray")
    values = (300 + lat[:, np.newaxis] + 0 * lon) * scale
    with netcdf.Dataset(folder / "widths.nc", "w") as file:
        file.createDimension("lat", len(lat))
        file.createDimension("lon", len(lon))
        file.createVariable("lat", "f8", ("lat",))[:] = lat
        file.createVariable("lon", "f8", ("lon",))[:] = lon
        variable = file.createVariable("cellWidth", "f8", ("lat", "lon"))
        variable[:] = values
        if unit is not None:
            variable.units = unit
    attributes = {} if unit is None else {"units": unit}
    return xarray.DataArray(values, dims=("lat", "lon"), coords={"lat": lat, "lon": lon},
                            attrs=attributes)


LON, LAT = np.arange(-180, 180, 10.0), np.linspace(-90, 90, 19)


@pytest.mark.parametrize("unit, scale", [(None, 1), ("km", 1), ("kilometers", 1), ("m", 1000),
                                         ("metres", 1000)])
def test_units_of_widths(tmp_path, unit, scale):
    array = rasters(tmp_path, unit, LON, LAT, scale)
    expected = calotte.plan(rasters(tmp_path, None, LON, LAT)).cells
    array = rasters(tmp_path, unit, LON, LAT, scale)
    assert calotte.plan(array).cells == calotte.plan(tmp_path / "widths.nc").cells == expected


@pytest.mark.parametrize("unit", ["degrees", "radians", "furlongs", "K"])
def test_units_that_are_no_length(tmp_path, unit):
    array = rasters(tmp_path, unit, LON, LAT)
    for widths in (array, tmp_path / "widths.nc"):
        with pytest.raises(calotte.Error, match=unit):
            calotte.plan(widths)
    assert run("plan", "--cell-width", tmp_path / "widths.nc").returncode == 2


def test_widths_must_cover_what_is_asked(tmp_path):
    array = rasters(tmp_path, "km", np.arange(0, 61, 5.0), np.arange(0, 61, 5.0))
    file = tmp_path / "widths.nc"
    inside, outside = "circle=30,30,20deg", "circle=80,30,20deg"
    for widths in (array, (array.values, array.lon.values, array.lat.values), file):
        assert calotte.plan(widths, surface=inside).cells >= 12
        for region in (None, outside):
            with pytest.raises(calotte.Error):
                calotte.plan(widths, surface=region)
    made("cvt", "--cell-width", file, "--region", inside, "-o", tmp_path / "a.vtp")
    assert run("plan", "--cell-width", file).returncode == 2
    assert run("cvt", "--cell-width", file, "--region", outside, "-o", "never.vtp").returncode == 2


def test_fixed_generators(tmp_path):
    stay = calotte.cvt(162).mesh.points[:20]
    np.savetxt(tmp_path / "fixed.txt", stay, fmt="%.17g")
    made("cvt", "--cells", 200, "--fixed", tmp_path / "fixed.txt", "--max-iterations", 20, "-o",
         tmp_path / "a.vtp")
    grid = calotte.cvt(200, fixed=stay, max_iterations=20)
    assert (calotte.read(tmp_path / "a.vtp").points == grid.mesh.points).all()
    assert (grid.mesh.points[:20] == stay).all()
    places = np.array([(0.5, 0.5), (1.5, 0.5)])
    plane = calotte.cvt(100, surface=calotte.rectangle((0, 0), (2, 1)), fixed=places)
    assert (plane.mesh.points[:2] == places).all() and len(plane.mesh) == 100


def test_culls_by_every_kind_of_land(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    calotte.cvt(642).mesh.to_mpas(tmp_path / "globe.nc")
    lon, lat = np.arange(-175, 180, 10.0), np.arange(-85, 90, 10.0)
    height = np.where(np.abs(lat[:, np.newaxis]) + 0 * lon < 40, 100.0, -100.0)
    with netcdf.Dataset(tmp_path / "raster.nc", "w") as file:
        file.createDimension("lat", len(lat))
        file.createDimension("lon", len(lon))
        file.createVariable("lat", "f8", ("lat",))[:] = lat
        file.createVariable("lon", "f8", ("lon",))[:] = lon
        file.createVariable("z", "f8", ("lat", "lon"))[:] = height
    (tmp_path / "barrier.geojson").write_text(json.dumps(
        {"type": "LineString", "coordinates": [[-60, 60], [60, 60]]}))
    island, continent = ([[[a, b], [a + w, b], [a + w, b + w], [a, b + w], [a, b]]]
                         for a, b, w in ((100, 0, 2), (0, 0, 40)))
    (tmp_path / "land.geojson").write_text(json.dumps(
        {"type": "MultiPolygon", "coordinates": [island, continent]}))
    lands = []
    for options, words in (
            (["--raster", tmp_path / "raster.nc", "--raster-variable", "z"],
             {"raster": tmp_path / "raster.nc"}),
            (["--land", tmp_path / "land.geojson", "--least-area", "100000", "--land-fraction", "0"],
             {"land": tmp_path / "land.geojson", "least_area": 1e5, "land_fraction": 0}),
            (["--field", "latCell", "--sea-below", "0.5"], {"field": "latCell", "sea_below": 0.5}),
            (["--field", "lonCell", "--sea-from", "3", "--sea-ice-latitude", "20", "--land-mesh",
              tmp_path / "others.nc"],
             {"field": "lonCell", "sea_from": 3, "sea_ice_latitude": 20,
              "land_mesh": tmp_path / "others.nc"}),
            (["--field", "latCell", "--sea-from", "0.5", "--barrier",
              tmp_path / "barrier.geojson"],
             {"field": "latCell", "sea_from": 0.5, "barriers": [tmp_path / "barrier.geojson"]})):
        made("cull", tmp_path / "globe.nc", *options, "-o", tmp_path / "command.nc")
        report = calotte.cull(tmp_path / "globe.nc", tmp_path / "python.nc", **words)
        with netcdf.Dataset(tmp_path / "command.nc") as a, \
                netcdf.Dataset(tmp_path / "python.nc") as b:
            assert (a["areaCell"][:] == b["areaCell"][:]).all()
            assert a.dimensions["nCells"].size == report["cells"] < 642
        assert sum(cells for cells, _, _ in report["severed_parts"]) <= report["severed"]
        lands.append(report["land"])
    all_land = calotte.cull(tmp_path / "globe.nc", tmp_path / "python.nc",
                            land=tmp_path / "land.geojson", land_fraction=0)
    assert all_land["land"] > lands[1]  # with the island


def values_of(report, name=""):
    """Numbers of a report, by the names of attributes."""
    if isinstance(report, dict):
        for key, value in report.items():
            yield from values_of(value, f"{name}.{key}" if name else key)
    else:
        yield name, report


RENAMED = {"short_voronoi_edges": "short_edges", "rms": "l2"}


def attribute(value, name):
    for word in name.split("."):
        value = getattr(value, RENAMED.get(word, word))
    return value


def test_measures_have_the_names_and_units_of_a_report(tmp_path):
    """Radians and steradians in both; the report has km beside them."""
    grid = calotte.cvt(642)
    grid.mesh.to_mpas(tmp_path / "grid.nc", sphere_radius=6371229.0)
    made("info", tmp_path / "grid.nc", "--operators", "--report", tmp_path / "report.json")
    report = json.loads((tmp_path / "report.json").read_text())
    mesh = calotte.read(tmp_path / "grid.nc")
    errors, quality = calotte.operator_errors(mesh), calotte.quality(mesh)
    compared = 0
    for name, value in values_of(report):
        if name.startswith("operators.") and "_step_" not in name:
            assert attribute(errors, name.removeprefix("operators.")) == pytest.approx(
                tuple(value) if isinstance(value, list) else value, rel=1e-9), name
        elif not name.startswith("operators.") and hasattr(quality, RENAMED.get(
                name.split(".")[0], name.split(".")[0])) and not name.startswith("degrees"):
            assert attribute(quality, name) == pytest.approx(value, rel=1e-9, abs=1e-14), name
        else:
            continue
        compared += 1
    assert compared > 60
    steps = report["operators"]
    assert errors.wave_step(1.0) == pytest.approx(steps["wave_step_times_speed"])
    assert errors.wave_step(200.0, 6371229.0) == pytest.approx(
        steps["wave_step_times_speed"] * 6371229.0 / 200)
    assert errors.diffusion_step(1.0) == pytest.approx(steps["divergence_step_times_viscosity"])
    assert errors.diffusion_step(10.0, 2.0, of="vorticity") == pytest.approx(
        steps["vorticity_step_times_viscosity"] * 4 / 10)
    with pytest.raises(calotte.Error, match="divergence or vorticity"):
        errors.diffusion_step(1.0, of="heat")
