# SPDX-License-Identifier: GPL-3.0-or-later
"""Rules for cell widths: what their words say, and that the command makes the same grid of them."""
import json
import os
import pathlib
import re
import runpy
import subprocess

import numpy as np
import pytest

import calotte
from calotte import widths

COMMAND = os.environ.get("CALOTTE_COMMAND", "calotte")
ROOT = pathlib.Path(__file__).parents[2]
RADIUS = 6371.0
ROUND = [np.arange(0, 360, 30), np.linspace(-75, 75, 12)]


def test_rules_are_what_they_say():
    lon, lat = ROUND
    assert widths.by_latitude([(-90, 20), (90, 200)])(lon, lat) == pytest.approx(110 + lat, rel=1e-12)
    pole = widths.by_distance([(0, 90)], near=10, far=1010, over=RADIUS * np.pi)
    assert pole(lon, lat) == pytest.approx(10 + 1000 * (90 - lat) / 180, rel=1e-12)
    assert (widths.minimum(pole, 300)(lon, lat) == np.minimum(pole(lon, lat), 300)).all()
    assert (widths.maximum(pole, 300)(lon, lat) == np.maximum(pole(lon, lat), 300)).all()
    assert (widths.sum(pole, 300)(lon, lat) == pole(lon, lat) + 300).all()
    assert ((2 * pole)(lon, lat) == 2 * pole(lon, lat)).all()
    part = widths.where("circle=0,90,60deg", 10, 20)
    assert (part(lon, lat) == np.where(lat > 30, 10, 20)).all()
    limited = widths.by_distance([[(0, 0)], [(180, 0)]], profile=[(0, 10), (100, 300)]).limit_gradient(0.03)
    assert limited(45, 0) == pytest.approx(10 + 0.03 * RADIUS * np.pi / 4, rel=1e-12)


def test_files_name_rules_as_functions_do(tmp_path):
    path = written(tmp_path, "w.toml", "[cell-width]\nnone = 1")
    with pytest.raises(calotte.Error) as caught:
        widths.rule(path)
    keys = re.search("one of the keys (.*); this one has none", str(caught.value))[1].replace("-", "_").split(", ")
    values = {"width", "raster", "polygons"}  # a rule is one of them, or a function
    of_shares = {"where", "share"}  # "within" and "share" of a file
    assert set(keys) - values == set(widths.__all__) - {"Widths", "rule"} - of_shares


def test_functions_and_rasters_are_rules():
    function = widths.rule(lambda lon, lat: 100 + lat / 9)
    assert function(*ROUND) == pytest.approx(100 + ROUND[1] / 9, rel=1e-4)
    raster = widths.by_latitude([(-90, 100), (90, 300)]).to_xarray(1)
    assert raster.dims == ("lat", "lon") and raster.attrs["units"] == "km"
    assert widths.rule(raster)(*ROUND) == pytest.approx(200 + ROUND[1] / 0.9, rel=1e-3)


def test_the_command_makes_the_same_grid(tmp_path):
    line = [[-60, 20], [0, 40], [60, 20]]
    (tmp_path / "line.geojson").write_text(json.dumps({"type": "LineString", "coordinates": line}))
    (tmp_path / "w.toml").write_text("""
[cell-width]
gradient = 0.05
minimum = [900, {by-latitude = [[0, 900], [90, 600]]},
           {by-distance = "line.geojson", near = 300, far = 900, over = 2000}]
""")
    subprocess.run([COMMAND, "cvt", "--cell-width", str(tmp_path / "w.toml"), "-o", str(tmp_path / "a.vtp")],
                   check=True, capture_output=True)
    rule = widths.minimum(900, widths.by_latitude([(0, 900), (90, 600)]),
                          widths.by_distance(line, near=300, far=900, over=2000)).limit_gradient(0.05)
    grid = calotte.cvt(cell_width=rule)
    assert (calotte.read(tmp_path / "a.vtp").points == grid.mesh.points).all()
    assert calotte.quality(grid.mesh, cell_width=rule).obtuse == 0


def written(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    return tmp_path / name


def test_rules_by_a_coast(tmp_path):
    square = [[[-10, -10], [10, -10], [10, 10], [-10, 10], [-10, -10]]]
    coast = written(tmp_path, "c.geojson", json.dumps({"type": "Polygon", "coordinates": square}))
    sides = widths.by_distance(coast, profile=[(-20015, 20115), (0, 100), (20015, 20115)])
    km = RADIUS * np.pi / 180
    assert sides([15, 7], [0, 0]) == pytest.approx([100 + 5 * km, 100 + 3 * km], rel=1e-9)
    sea = widths.by_distance(coast, near=10, far=60, over=600, side="sea")
    assert np.isnan(sea(0, 0)) and sea(10, 0) == pytest.approx(10, abs=1e-3) and sea(50, 0) == 60
    land = widths.by_distance(coast, near=10, far=60, over=600, side="land")
    assert land(0, 0) == 60 and np.isnan(land(50, 0))
    assert np.isnan(widths.by_channel(coast, 5, cells=4)(0, 0))
    islet = [[[60, 0], [61, 0], [61, 1], [60, 1], [60, 0]]]
    both = written(tmp_path, "b.geojson", json.dumps({"type": "MultiPolygon", "coordinates": [square, islet]}))
    near = dict(near=10, far=60, over=600)
    assert widths.by_distance(both, **near)(60, 0) == pytest.approx(10, abs=1e-3)
    assert widths.by_distance(both, least_area=2e4, **near)(60, 0) == 60
    assert widths.by_distance(both, least_area=2e4, side="sea", **near)(60.5, 0.5) == 60
    with pytest.raises(calotte.Error, match="no area"):
        widths.by_distance([(0, 0), (1, 1)], least_area=5, **near)
    band = widths.around([(-10, 0), (10, 0)], 5, 200)
    assert band(0, 1) == 5 and np.isnan(band(0, 2))


def test_a_place_without_a_width_is_refused():
    alone = widths.around([(-10, 0), (10, 0)], 50, 500)
    for refused in (lambda: calotte.cvt(cell_width=alone), lambda: calotte.plan(alone), alone.sampled,
                    lambda: calotte.cvt(cell_width=alone, surface="circle=0,0,20deg")):
        with pytest.raises(calotte.Error, match="no rule gives a width at longitude .* latitude"):
            refused()
    assert calotte.plan(alone, surface="circle=0,0,2deg").widths == (50, 50)


def test_two_rules_blend():
    lon, lat = ROUND
    region = "circle=0,90,60deg"
    assert (widths.blend(20, 10, region)(lon, lat) == widths.where(region, 10, 20)(lon, lat)).all()
    t = widths.share(region, over=3335.8)  # 30 degrees
    assert widths.blend(20, 10, t)(0, 15) == pytest.approx(15, abs=0.01)
    t = widths.share(region, profile=[(-3335.8, 1), (0, 0)])
    assert widths.blend(20, 10, t)(0, 45) == pytest.approx(15, abs=0.01)


def test_the_share_of_a_coast(tmp_path):
    square = [[[-10, -10], [10, -10], [10, 10], [-10, 10], [-10, -10]]]
    coast = written(tmp_path, "c.geojson", json.dumps({"type": "Polygon", "coordinates": square}))
    km = RADIUS * np.pi / 180
    t = widths.share(coast, profile=[(-5 * km, 1), (0, 0)], least_area=1)
    assert widths.blend(30, 10, t)([0, 8, 12], [0, 0, 0]) == pytest.approx([10, 22, 30], rel=1e-9)
    with pytest.raises(calotte.Error, match="over or a profile"):
        widths.share(coast, least_area=1)


def test_the_manual_has_one_ocean_in_toml_and_in_python(tmp_path, monkeypatch):
    page = (ROOT / "tools/manual/cell-widths.md").read_text()
    for name in ("ocean.toml", "straits.geojson", "ocean.py"):
        text = re.search(rf"`{name}`:\n\n```\w+\n(.*?)^```$", page, re.M | re.S)[1]
        written(tmp_path, name, text.replace("[cell-width]", "[cell-width]\nstep = 0.25"))
    (tmp_path / "tools").symlink_to(ROOT / "tools")
    monkeypatch.chdir(tmp_path)
    rule = runpy.run_path("ocean.py")["rule"]
    subprocess.run([COMMAND, "plan", "--cell-width", "ocean.toml", "--raster", "w.nc", "--report", "plan.json"],
                   check=True, capture_output=True)
    raster = widths.rule("w.nc").sampled()
    same = rule.sampled(0.25)
    assert np.array(raster.widths) == pytest.approx(np.array(same.widths), rel=1e-12)
    rules = json.loads((tmp_path / "plan.json").read_text())["rules"]
    names = [one["name"].split()[0] for one in rules]
    assert names == ["by-latitude", "by-distance", "by-channel", "around", "by-depth"]
    assert all(one["area"] > 0 for one in rules) and np.sum([one["cells"] for one in rules]) == pytest.approx(1)


def test_files_of_rules_are_rules(tmp_path):
    written(tmp_path, "l.geojson", '{"type":"LineString","coordinates":[[0,0],[10,0]]}')
    path = written(tmp_path, "w.toml", "[cell-width]\nstep = 1\ngradient = 0.2\nminimum = [900, "
                   '{by-distance = "l.geojson", near = 300, far = 800, over = 2000}]')
    made = widths.minimum(900, widths.by_distance([(0, 0), (10, 0)], 300, 800, 2000)).limit_gradient(0.2)
    lon, lat = np.meshgrid(np.linspace(-180, 180, 37), np.linspace(-90, 90, 19))
    assert (widths.rule(path)(lon, lat) == made(lon, lat)).all()
    assert (np.array(widths.rule(path).sampled().widths) == np.array(made.sampled(1).widths)).all()
    # The command's grid, on another planet.
    for radius in (6371.0, 3389.5):
        subprocess.run([COMMAND, "plan", "--cell-width", path, "--earth-radius", str(radius), "--report",
                        tmp_path / "plan.json"], check=True, capture_output=True)
        assert calotte.plan(path, earth_radius=radius).cells == json.loads((tmp_path / "plan.json").read_text())["cells"]
        assert calotte.plan(made.on_sphere(radius).sampled(1), earth_radius=radius).cells == \
            calotte.plan(path, earth_radius=radius).cells
    distance = np.radians(17) * 3389.5
    rule = widths.by_distance([(0, 0), (10, 0)], 50, 400, 2000)
    assert rule.on_sphere(3389.5)(5, 17) == pytest.approx(50 + 350 * distance / 2000, rel=1e-3)
    plane = calotte.rectangle((0, 0), (40, 30))
    path = written(tmp_path, "p.toml", "[cell-width]\ngradient = 0.1\nminimum = [3, "
                   '{by-distance = "l.geojson", near = 1, far = 3, over = 5}]')
    assert calotte.plan(path, surface=plane).widths == pytest.approx((1, 3))
    with pytest.raises(calotte.Error, match="plane|domain"):
        widths.rule(path).sampled(surface=plane)


@pytest.mark.parametrize("make, words", [
    (lambda: widths.by_latitude([1, 2]), "pairs"),
    (lambda: widths.by_latitude([(0, 10), (100, 20)]), "outside -90 to 90"),
    (lambda: widths.by_distance([(0, 0)], near=1), "near, far and over"),
    (lambda: widths.by_distance([(0, 0)], 1, 2, 3, profile=[(0, 1)]), "not both"),
    (lambda: widths.rule(-5), "-5 is not a positive number"),
    (lambda: widths.minimum(), "no widths"),
    (lambda: widths.by_distance([(0, 0)], 1, 2, 3, side="sea"), "lines have no side"),
    (lambda: widths.by_distance("a.nc", 1, 2, 3, side="left"), "neither sea nor land"),
    (lambda: widths.share("circle=0,90,60deg", 5, profile=[(0, 1)]), "not both"),
    (lambda: widths.share("circle=0,90,60deg", profile=[(0, 2)]), "share 2, which is not a fraction from 0 to 1"),
    (lambda: widths.rule(5).limit_gradient(0), "gradient"),
])
def test_what_is_no_rule(make, words):
    with pytest.raises(calotte.Error, match=words):
        make()


def test_rules_of_a_plane():
    lake = calotte.rectangle((0, 0), (4, 3))
    shore = widths.by_distance([[(0, 0), (4, 0)], [(0, 3), (4, 3)]], 0.1, 0.4, 1, surface=lake)
    rule = widths.minimum(shore, widths.around([[(2, 1.5)]], 0.12, 0.3, surface=lake))
    assert rule.of_plane and not widths.rule(60).of_plane
    x, y = np.meshgrid(np.linspace(0, 4, 41), np.linspace(0, 3, 31))
    exact = np.minimum(0.1 + 0.3 * np.minimum(y, 3 - y), 0.4)
    exact[np.hypot(x - 2, y - 1.5) <= 0.3] = 0.12
    assert np.abs(rule(x, y) - exact).max() < 1e-12
    grid = calotte.cvt(cell_width=shore, surface=lake)
    near = grid.mesh.points[:, 1] < 0.5
    assert near.sum() > 0.25 * len(near)
    same = calotte.cvt(cell_width=lambda x, y: np.minimum(0.1 + 0.3 * np.minimum(y, 3 - y), 0.4),
                       surface=lake)
    assert len(same.mesh) == pytest.approx(len(grid.mesh), rel=0.01)
    with pytest.raises(calotte.Error, match="some widths are of the sphere"):
        widths.minimum(shore, widths.by_latitude([(0, 60)]))
