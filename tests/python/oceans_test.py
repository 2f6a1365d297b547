# SPDX-License-Identifier: GPL-3.0-or-later
"""The sea of grids that end at the coast, and the files of such grids."""
import json
import os
import pickle
import subprocess
import warnings

import numpy as np
import pytest

import calotte
from calotte import widths

COMMAND = os.environ.get("CALOTTE_COMMAND", "calotte")
BAY, OCEAN = (180, 0), (0, 0)
WIDTH = 400  # km
STRAIT = [(180, 0), (-155, 0)]


@pytest.fixture
def land(tmp_path):
    """Land of 40 by 40 degrees over the date line, whose bay is reached by a strait of 71 km."""
    ring = [[160, -20], [-160, -20], [-160, -0.32], [-170, -0.32], [-170, -10], [170, -10], [170, 10], [-170, 10],
            [-170, 0.32], [-160, 0.32], [-160, 20], [160, 20], [160, -20]]
    return written(tmp_path / "land.geojson", {"type": "Polygon", "coordinates": [ring]})


def written(path, content):
    path.write_text(json.dumps(content))
    return path


def run(*words):
    result = subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return result.stdout


def test_a_strait_narrower_than_a_cell_is_closed_unless_it_is_a_passage(land):
    closed = calotte.generalised_sea(land, WIDTH)
    assert closed.sea.contains([OCEAN, BAY]).tolist() == [True, False]
    assert len(closed.parts) == len(closed.straits) == 1 and closed.stranded_passages == ()
    part, = closed.parts
    assert np.abs(np.subtract(part.at, BAY)).max() < 2  # where the bay is widest
    bay = calotte.box(170, -10, -170, 10).area
    assert bay / 2 < part.area < bay < closed.sea_to_land < 1.2 * bay
    assert closed.straits[0].area < part.area / 2 and 0 < closed.land_to_sea < closed.sea_to_land
    assert 0 < closed.usual_displacement <= closed.displacement < 1.5
    assert repr(closed).endswith("steradians, without 0 islands, 0 lakes, 1 part, 1 strait>")
    assert "usual_displacement" in closed._repr_html_()
    assert pickle.loads(pickle.dumps(closed)) == closed

    opened = calotte.generalised_sea(land, WIDTH, passages=[STRAIT])
    assert opened.sea.contains([OCEAN, BAY]).all() and opened.parts == opened.straits == ()
    inner = calotte.generalised_sea(land, WIDTH, seeds=part.at)
    assert inner.sea.contains([OCEAN, BAY]).tolist() == [False, True]
    assert calotte.generalised_sea(land, WIDTH, seeds=[OCEAN, BAY]).parts == ()


def test_the_region_is_that_of_the_command(tmp_path, land):
    strait = written(tmp_path / "strait.geojson", {"type": "LineString", "coordinates": STRAIT})
    island = written(tmp_path / "island.geojson", {"type": "Polygon", "coordinates": [
        [[-30, 10], [-20, 10], [-20, 20], [-30, 20], [-30, 10]]]})
    for options, arguments in (([], {}), (["--passage", strait], {"passages": strait}),
                               (["--passage", strait], {"passages": [calotte.from_lonlat(*np.transpose(STRAIT))]}),
                               (["--seed", "180,0", "--least-island", 10], {"seeds": BAY, "least_island": 10})):
        run("coast", land, island, "--cell-width", f"{WIDTH}km", "-o", tmp_path / "command.geojson", *options)
        made = calotte.generalised_sea([land, island], WIDTH, **arguments)
        assert made.islands == ("least_island" in arguments)
        made.sea.write(tmp_path / "python.geojson")
        assert (tmp_path / "python.geojson").read_text() == (tmp_path / "command.geojson").read_text()


def test_the_sea_of_a_part_of_the_sphere(tmp_path, land):
    part = "circle=%g,%g,900km" % OCEAN
    made = calotte.generalised_sea(land, WIDTH, region=part)
    assert made.sea.area < 1.1 * calotte.circle(OCEAN, "900km").area
    run("coast", land, "--cell-width", f"{WIDTH}km", "--region", part, "-o", tmp_path / "part.geojson")
    made.sea.write(tmp_path / "made.geojson")
    assert (tmp_path / "made.geojson").read_text() == (tmp_path / "part.geojson").read_text()
    with pytest.raises(calotte.Error, match="of the sphere"):
        calotte.generalised_sea(land, WIDTH, region=calotte.rectangle((0, 0), (1, 1)))


def test_a_written_region_is_a_surface(tmp_path, land):
    made = calotte.generalised_sea(land, WIDTH)
    made.sea.write(tmp_path / "sea.geojson")
    again = calotte.polygon(*made.sea.rings, inside=OCEAN)
    points = calotte.random_points(3000)
    assert (again.contains(points) == made.sea.contains(points)).all()
    plans = [calotte.plan(WIDTH, surface=surface).cells for surface in (made, made.sea, tmp_path / "sea.geojson")]
    assert plans == plans[:1] * 3
    assert made.sea.contains(calotte.random_points(50, made)).all()
    part = widths.where(made, WIDTH, 2 * WIDTH)
    assert part(*OCEAN) == WIDTH and part(*BAY) == 2 * WIDTH
    for surface, text in ((calotte.Surface(), "a part of the sphere"), (calotte.plane(), "a part of the sphere"),
                          (made.sea, "a name that ends in .geojson")):
        with pytest.raises(calotte.Error, match=text):
            surface.write(tmp_path / ("sea.nc" if surface is made.sea else "never.geojson"))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["land.geojson", "sea.geojson"]


def test_widths_vary_and_have_a_radius(land):
    rule = widths.by_latitude([(-90, 900), (0, 300), (90, 900)])
    made = calotte.generalised_sea(str(land), rule)
    rows = np.concatenate([calotte.to_lonlat(ring) for ring in made.sea.rings])
    assert len(rows) > 43 - 10 and made.displacement < 1.5
    small = calotte.generalised_sea(land, WIDTH / 2, earth_radius=calotte._arguments.EARTH_RADIUS_KM / 2)
    assert small.sea == calotte.generalised_sea(land, f"{WIDTH}km").sea


def test_passages_without_effect_are_told(land):
    with pytest.warns(UserWarning, match="no sea of the region reaches, without effect: 1; begin") as record:
        made = calotte.generalised_sea(land, WIDTH, passages=[STRAIT, [(165, -17), (166, -16)]])
    assert made.stranded_passages == (1,) and record[0].filename == __file__


@pytest.mark.parametrize("text, arguments", [
    ("coast is 7; give the name of a file", {"coast": 7}),
    ("coast holds a list; give the name of a file", {"coast": [[1.0, 2.0]]}),
    ("the coast has no shore", {"coast": []}),
    ("none.geojson: No such file", {"coast": "none.geojson"}),
    ("the cell width -3 is not a positive number", {"cell_width": -3}),
    ("give cell widths as a number of km", {"cell_width": None}),
    ("no rule gives a width", {"cell_width": widths.around([(0, 0), (1, 1)], 100, 100)}),
    ("cell_width is of a plane", {"cell_width": widths.around([(0, 0), (1, 1)], 1, 1, surface=calotte.plane())}),
    ("smaller than the least island", {"cell_width": 30000}),
    ("the least island has 0 cells; give 0.25 or more", {"least_island": 0}),
    ("least_island is 'a'; give a number", {"least_island": "a"}),
    ("seed 1 is on land; give a point in the sea", {"seeds": [OCEAN, (165, 0)]}),
    ("seeds must be numbers", {"seeds": "here"}),
    ("seeds have the shape (1, 4)", {"seeds": (0, 1, 2, 3)}),
    ("points of passages have the shape (2,)", {"passages": STRAIT}),
    ("passages: line 1, point 1 is opposite to the one before", {"passages": [STRAIT, [(180, 0), (0, 0)]]}),
    ("passages is 7; give the name of a file or a list", {"passages": 7}),
    ("passages: line 0, point 0 is no direction", {"passages": [[(np.nan, 0, 0), (1, 0, 0)]]}),
])
def test_what_is_refused(land, text, arguments):
    given = {"coast": land, "cell_width": WIDTH, **arguments}
    with pytest.raises(calotte.Error) as caught:
        calotte.generalised_sea(**given)
    assert text in str(caught.value) and "\n" not in str(caught.value)


# ---- Grids

@pytest.fixture(scope="module")
def island_grid():
    """A mesh that ends at generators on the coast of a sea with an island."""
    rings = [calotte.circle(OCEAN, radius).rings[0] for radius in (14, 5)]
    sea = calotte.polygon(*rings, inside=(9, 0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return calotte.cvt(cell_width=200, surface=sea, boundary="generators").mesh


def test_a_mesh_of_a_generalised_sea_ends_at_it(land):
    made = calotte.generalised_sea(land, WIDTH, passages=[STRAIT])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        grid = calotte.cvt(cell_width=WIDTH, surface=made, boundary="generators")
    assert grid.off_boundary == 0 and grid.mesh.surface == made.sea
    outer = (grid.mesh.neighbours < 0).sum()
    assert outer >= 0.7 * sum(len(ring) for ring in made.sea.rings)


@pytest.mark.parametrize("name", ["hgrid.gr3", "fort.14", "sea.2dm", "nod2d.out"])
def test_depths_of_coastal_models(tmp_path, island_grid, name):
    depth = 100.0 + np.arange(len(island_grid))
    levels = {"depth_levels": [0, 100, 1000, 6000]} if name == "nod2d.out" else {}
    calotte.write(tmp_path / name, island_grid, fields={"depth": depth}, **levels)
    read = calotte.read(tmp_path / name)
    assert (np.abs(read.fields["depth"]) == depth).all()
    assert len(read.triangles) == len(island_grid.triangles)
    assert run("check", tmp_path / name).endswith("passed\n")
    if levels:
        assert len((tmp_path / "aux3d.out").read_text().split()) == 1 + 4 + len(depth)
        (tmp_path / "again").mkdir()
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)
            warnings.filterwarnings("ignore", message=".* the format does not hold coast$")
            calotte.write(tmp_path / "again" / name, read, **levels)
        assert (tmp_path / "again/aux3d.out").read_text() == (tmp_path / "aux3d.out").read_text()


def test_a_mesh_for_fesom_is_one_that_it_reads(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # shapes in corners of 90 degrees
        mesh = calotte.cvt(cell_width=300, surface="box=0,-20,30,20", boundary="generators").mesh
    calotte.write(tmp_path / "box.gr3", mesh)
    depth = 1000.0 + np.round(mesh.lat)
    for grid in (mesh, calotte.read(tmp_path / "box.gr3", fields="none")):
        with pytest.warns(UserWarning, match="nod2d.out: without [1-4] triangles? of fewer than two neighbours, and "
                                             "without the [1-4] sites? that .*: FESOM refuses them") as record:
            calotte.write(tmp_path / "nod2d.out", grid, fields={"depth": depth}, depth_levels=[0, 10, 2000])
        assert record[0].filename == __file__
        read = calotte.read(tmp_path / "nod2d.out")
        assert len(mesh) - 4 <= len(read) < len(mesh)
        assert np.abs(np.abs(read.fields["depth"]) - 1000 - read.lat).max() < 0.51
        assert run("check", tmp_path / "nod2d.out").endswith("passed\n")


@pytest.mark.parametrize("name, text, options", [
    ("nod2d.out", "FESOM's depths need layers; give depth_levels", {"fields": {"depth": 5.0}}),
    ("nod2d.out", "depth_levels needs depths", {"depth_levels": [0, 10, 100]}),
    ("hgrid.gr3", "depth_levels applies to FESOM", {"fields": {"depth": 5.0}, "depth_levels": [0, 10, 100]}),
    ("nod2d.out", "depth_levels have the shape (1, 2)", {"fields": {"depth": 5.0}, "depth_levels": [[0, 10]]}),
    ("nod2d.out", "the levels of depth are fewer than 3", {"fields": {"depth": 5.0}, "depth_levels": [0, 10]}),
    ("nod2d.out", "depth_levels must be numbers", {"fields": {"depth": 5.0}, "depth_levels": "0,10,100"}),
])
def test_depths_that_are_refused(tmp_path, island_grid, name, text, options):
    options = {**options, "fields": {key: np.full(len(island_grid), value)
                                     for key, value in options.get("fields", {}).items()}}
    with pytest.raises(calotte.Error) as caught:
        calotte.write(tmp_path / name, island_grid, **options)
    assert text in str(caught.value) and "\n" not in str(caught.value) and not list(tmp_path.iterdir())


def test_cells_that_a_coast_hides_are_told(tmp_path, land, island_grid):
    with pytest.warns(UserWarning, match="the coast leaves [0-9]+ cells? behind a bend of the coast, .* of the file; "
                                         "make the region by generalised_sea") as record:
        calotte.write(tmp_path / "hidden.nc", island_grid)
    assert record[0].filename == __file__ and (tmp_path / "hidden.nc").exists()
    made = calotte.generalised_sea(land, WIDTH)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        calotte.write(tmp_path / "sea.nc", calotte.cvt(cell_width=WIDTH, surface=made).mesh, cell_width=WIDTH,
                      model="mpas-ocean")
    assert run("check", tmp_path / "sea.nc", "--for", "mpas-ocean").endswith("passed\n")
