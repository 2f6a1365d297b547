# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of meshes that become finer or coarser, and what their files hold."""
import os
import pickle
import subprocess

import numpy as np
import pytest

import calotte
from calotte import widths

COMMAND = os.environ.get("CALOTTE_COMMAND", "calotte")
SPOT = "circle=10,50,1200km"


@pytest.fixture(scope="module", name="base")
def fixture_base():
    return calotte.cvt(2562).mesh  # cells of 480 km


@pytest.fixture(scope="module", name="file")
def fixture_file(base, tmp_path_factory):
    """A file of MPAS-Ocean with fields, as it is read."""
    path = tmp_path_factory.mktemp("changes") / "base.nc"
    x = base.points
    calotte.write(path, base, sphere_radius=6371220.0,
                  fields={"height": 3 * x[:, 0], "kind": np.round(3 * x[:, 2])})
    return path


def keeps(old, changed):
    """Sites that stayed have their bits and their order, before the new ones."""
    new_of_old, old_of_new = changed.new_of_old, changed.old_of_new
    assert new_of_old.dtype == old_of_new.dtype == np.int32
    assert new_of_old.shape == (len(old),) and old_of_new.shape == (len(changed.mesh),)
    kept = np.flatnonzero(new_of_old >= 0)
    assert (new_of_old[kept] == np.arange(len(kept))).all()
    assert (old_of_new[:len(kept)] == kept).all() and (old_of_new[len(kept):] == -1).all()
    assert (changed.mesh.points[:len(kept)] == old.points[kept]).all()
    assert (changed.width_ratio[:len(kept)] == 1).all()
    assert len(old) - len(kept) == sum(patch.removed for patch in changed.patches)
    assert len(changed.mesh) - len(kept) == sum(patch.added for patch in changed.patches)
    assert calotte.check(changed.mesh) or not calotte.check(old)  # a part of one is not convex


def spacing(mesh, centre):
    """The mean length of edges within 5 degrees of a point, km."""
    near = mesh.points @ calotte.from_lonlat(*centre)[0] > np.cos(np.radians(5))
    a, b = (mesh.points[mesh.triangles[:, k]] for k in (0, 1))
    ends = near[mesh.triangles[:, 0]]
    return 6371 * np.linalg.norm(a - b, axis=1)[ends].mean()


def test_the_shore_of_a_mesh_that_ends_at_generators():
    sea = calotte.cvt(surface="circle=10,10,1200km", cell_width=150, boundary="generators").mesh
    with pytest.warns(UserWarning, match="at the boundary"):
        assert calotte.refine(sea, region="circle=0,10,500km", factor=2, gradient=0.1).held > 0
    finer = calotte.refine(sea, region="circle=0,10,500km", factor=2, gradient=0.1, boundary="generators")
    assert finer.held == 0 and finer.well_centred
    assert spacing(sea, (0, 10)) / spacing(finer.mesh, (0, 10)) == pytest.approx(2, rel=0.1)
    with pytest.raises(calotte.Error, match="no boundary"):
        calotte.refine(calotte.cvt(642).mesh, region=SPOT, factor=2, boundary="generators")
    with pytest.raises(calotte.Error, match="no boundary shore; give one of: clip, generators"):
        calotte.refine(sea, region=SPOT, factor=2, boundary="shore")


def test_a_part_of_the_sphere(base):
    finer = calotte.refine(base, region=SPOT, factor=2)
    keeps(base, finer)
    assert spacing(base, (10, 50)) / spacing(finer.mesh, (10, 50)) == pytest.approx(2, rel=0.1)
    assert len(finer.patches) == 1 and finer.held == 0 and finer.converged and finer.well_centred
    assert repr(finer) == (f"<calotte.ChangedMesh: {len(finer.mesh)} cells, "
                           f"{finer.patches[0].added} new in 1 patch>")
    assert finer.width_ratio.min() == pytest.approx(0.5, rel=0.05)
    assert finer.mesh.fields == {} and finer.nearest == finer.left_out == ()
    coarser = calotte.coarsen(base, region=calotte.circle((10, 50), "3000km"), factor=1.6,
                              gradient=0.2)
    keeps(base, coarser)
    assert spacing(coarser.mesh, (10, 50)) > 1.2 * spacing(base, (10, 50))
    same = pickle.loads(pickle.dumps(finer))
    assert (same.mesh.points == finer.mesh.points).all() and same.patches == finer.patches


def test_widths(base):
    """A number, a rule that says nothing elsewhere, a raster and a function."""
    for change, width in ((calotte.refine, 600.0), (calotte.coarsen, "300km")):
        met = change(base, width)
        assert met.patches == () and (met.mesh.points == base.points).all()
    lon, lat = np.arange(-180, 180, 2.0), np.linspace(-90, 90, 91)

    def width(lon, lat):
        return np.where(np.hypot(lon - 10, lat - 20) < 12, 250.0, 900.0)

    results = [calotte.refine(base, demand) for demand in (
        widths.around([(10, 20)], 250, 1300), width, (width(*np.meshgrid(lon, lat)), lon, lat))]
    for finer in results:
        keeps(base, finer)
        assert spacing(finer.mesh, (10, 20)) == pytest.approx(250, rel=0.12)
        assert len(finer.mesh) == pytest.approx(len(results[0].mesh), rel=0.05)
    with calotte.threads(1):
        again = calotte.refine(base, width, regions=3)
    assert (again.mesh.points == results[1].mesh.points).all()
    mars = calotte.refine(base, 250.0, earth_radius=3390.0)
    assert mars.patches == ()  # as cells are 255 km wide


def read_all(path):
    return calotte.read(path, fields="all")


@pytest.mark.parametrize("change, words, arguments", [
    (calotte.refine, ["--region", SPOT, "--factor", 2], {"region": SPOT, "factor": 2}),
    (calotte.refine, ["--cell-width", "380km", "--nearest", "kind"],
     {"cell_width": 380.0, "nearest": "kind"}),
    (calotte.refine, ["--region", SPOT, "--factor", 1.5, "--conservative", "height,kind"],
     {"region": SPOT, "factor": 1.5, "conservative": ["height", "kind"]}),
    (calotte.coarsen, ["--region", "circle=10,50,3200km", "--factor", 1.5, "--gradient", 0.2,
                       "--tolerance", 0.05],
     {"region": "circle=10,50,3200km", "factor": 1.5, "gradient": 0.2, "tolerance": 0.05})])
def test_files_are_those_of_the_command(file, tmp_path, change, words, arguments):
    base = read_all(file)
    changed = change(base, **arguments)
    changed.mesh.to_mpas(tmp_path / "python.nc")
    subprocess.run([COMMAND, change.__name__, file, *map(str, words), "-o", tmp_path / "command.nc"],
                   check=True, capture_output=True)
    ours, theirs = read_all(tmp_path / "python.nc"), read_all(tmp_path / "command.nc")
    assert (ours.points == theirs.points).all() and (ours.triangles == theirs.triangles).all()
    assert set(ours.fields) == set(theirs.fields) == {"height", "kind", "mapNewToBase"}
    for name, values in theirs.fields.items():
        assert (ours.fields[name] == values).all(), name
    assert (ours.fields["mapNewToBase"] == changed.old_of_new + 1).all()
    kept = changed.old_of_new >= 0
    assert (ours.fields["height"][kept] == base.fields["height"][changed.old_of_new[kept]]).all()
    assert changed.nearest == (("kind",) if "nearest" in arguments else ())
    if "nearest" in arguments:
        assert set(ours.fields["kind"]) <= {-3, -2, -1, 0, 1, 2, 3}


def test_methods_of_fields(file):
    base = read_all(file)
    with pytest.raises(calotte.Error, match="'kind' is to be both nearest and conservative"):
        calotte.refine(base, region=SPOT, factor=2, nearest="kind", conservative=["height", "kind"])
    with pytest.raises(calotte.Error, match="no field 'depth' at cells"):
        calotte.refine(base, region=SPOT, factor=2, conservative="depth")


def test_the_order_of_a_file(file, tmp_path):
    finer = calotte.refine(calotte.read(file), region=SPOT, factor=1.5)
    calotte.write(tmp_path / "new.nc", finer.mesh, order="curve")
    written = calotte.read(tmp_path / "new.nc")
    renumbered = finer.mesh.renumbered("curve")
    assert written.points == pytest.approx(renumbered.points, rel=1e-15)
    assert not (written.points == finer.mesh.points).all()
    with pytest.raises(calotte.Error, match="no order random; give curve or input"):
        calotte.write(tmp_path / "new.nc", finer.mesh, order="random")


def test_a_limited_area(base, tmp_path):
    base.to_mpas(tmp_path / "base.nc")
    calotte.cut(tmp_path / "base.nc", tmp_path / "area.nc", calotte.circle((10, 50), 40))
    area = read_all(tmp_path / "area.nc")
    finer = calotte.refine(area, region=SPOT, factor=2)
    keeps(area, finer)
    assert len(finer.mesh.cells) == len(finer.mesh) and finer.held == 0
    assert "bdyMaskCell" in finer.nearest and not set(finer.nearest) & set(finer.left_out)
    assert finer.mesh.cells.areas.sum() == pytest.approx(area.cells.areas.sum(), rel=1e-9)
    finer.mesh.to_mpas(tmp_path / "finer.nc")
    written = calotte.read(tmp_path / "finer.nc")
    assert (written.fields["bdyMaskCell"] == finer.mesh.fields["bdyMaskCell"]).all()
    beyond = calotte.refine(area, region="circle=10,50,80deg", factor=1.3)
    keeps(area, beyond)
    assert beyond.held > 0 and f", {beyond.held} held" in repr(beyond)


def test_a_bounded_plane():
    lake = calotte.rectangle((0, 0), (30, 20))
    base = calotte.cvt(cell_width=1.0, surface=lake).mesh
    finer = calotte.refine(base, region=calotte.rectangle((12, 8), (18, 12)), factor=1.5, gradient=0.3)
    keeps(base, finer)
    assert finer.held == 0 and finer.mesh.surface.area == lake.area
    assert calotte.voronoi(finer.mesh).cell_area.sum() == pytest.approx(600)
    beside = calotte.refine(base, region=calotte.rectangle((12, 0), (18, 4)), factor=1.5, gradient=0.3)
    keeps(base, beside)
    assert beside.held > 0

    def width(x, y):
        return np.where(np.hypot(x - 15, y - 10) < 2, 0.7, 2)

    for demand in (width, widths.around([[(15, 10)]], 0.7, 2, surface=lake)):
        made = calotte.refine(base, demand, gradient=0.3)
        keeps(base, made)
        assert len(made.patches) == 1 and len(made.mesh) > len(base)


def test_a_file_of_a_plane(tmp_path):
    lake = calotte.rectangle((0, 0), (20, 14))
    base = calotte.cvt(cell_width=1.0, surface=lake).mesh
    base.to_mpas(tmp_path / "lake.nc", fields={"x": base.points[:, 0]})
    part = {"region": calotte.rectangle((8, 5), (12, 9)), "factor": 1.4, "gradient": 0.3}
    file = calotte.read(tmp_path / "lake.nc", fields="all")
    finer = calotte.refine(file, **part)
    keeps(file, finer)
    assert calotte.voronoi(finer.mesh).cell_area.sum() == pytest.approx(280)  # of the cells of the file
    same = calotte.refine(file, surface=lake, **part)
    assert (same.mesh.points == finer.mesh.points).all()
    finer.mesh.to_mpas(tmp_path / "finer.nc")
    written = calotte.read(tmp_path / "finer.nc", fields="all")
    assert (written.points == finer.mesh.points).all()
    assert written.fields["x"] == pytest.approx(written.points[:, 0], abs=1e-12)
    with pytest.raises(calotte.Error, match="different periods"):
        calotte.refine(file, surface=calotte.periodic_box(20, 14), **part)


def test_a_periodic_box():
    box = calotte.periodic_box(30, 26)
    base = calotte.cvt(780, surface=box).mesh
    finer = calotte.refine(base, region=calotte.rectangle((26, 8), (32, 14)), factor=1.8, gradient=0.1)
    keeps(base, finer)
    assert (finer.mesh.surface.period == (30, 26)).all() and len(finer.patches) == 1
    with pytest.raises(calotte.Error, match="leads around"):
        calotte.refine(base, region=calotte.rectangle((-1, 8), (31, 14)), factor=1.8)


def test_progress(base):
    seen = []
    calotte.refine(base, region=SPOT, factor=1.5, progress=seen.append)
    assert len(seen) > 5 and seen[0]["iterations"] == 1 and seen[-1]["cells"] > 100
    with pytest.raises(calotte.Error, match="cancelled") as caught:
        calotte.refine(base, region=SPOT, factor=1.5, progress=lambda now: now["iterations"] > 3)
    assert caught.value.code == "cancelled"


@pytest.mark.parametrize("arguments, words", [
    ({}, "neither widths nor a region; give one"),
    ({"region": SPOT}, "region and factor belong together"),
    ({"cell_width": 100.0, "factor": 2}, "region and factor belong together"),
    ({"cell_width": 100.0, "region": SPOT, "factor": 2}, "widths and a region; give one"),
    ({"region": SPOT, "factor": 1}, "the factor is 1; give more than 1"),
    ({"region": SPOT, "factor": 101}, "the factor is 101; give 1 to 100"),
    ({"region": SPOT, "factor": 2, "gradient": 0}, "the gradient is 0; give 0.001 to 1"),
    ({"region": SPOT, "factor": 2, "tolerance": 0.6}, "the tolerance is 0.6; give 0.01 to 0.5"),
    ({"region": SPOT, "factor": 2, "nearest": ["depth"]}, "no field 'depth' at cells; give"),
    ({"region": calotte.rectangle((0, 0), (1, 1)), "factor": 2}, "of the sphere"),
    ({"cell_width": "no-such.nc"}, "no-such.nc"),
    ({"cell_width": -5.0}, "-5"),
    ({"cell_width": 100.0, "earth_radius": 0}, "radius is 0; give a positive"),
    ({"region": SPOT, "factor": 2, "surface": "circle=0,0,1000km"}, "leave it out"),
])
def test_bad_demands(base, arguments, words):
    for change in (calotte.refine, calotte.coarsen):
        with pytest.raises(calotte.Error, match=words) as caught:
            change(base, **arguments)
        assert "\n" not in str(caught.value)


def test_rotations(file, tmp_path):
    base = read_all(file)
    there = calotte.rotate(base, from_=(10, 20), to=(-105, 40), bearing=30)
    assert (there.triangles == base.triangles).all() and bool(calotte.check(there))
    assert (there.fields["height"] == base.fields["height"]).all()
    boulder = calotte.from_lonlat(-105, 40)
    moved = calotte.rotate(calotte.delaunay(calotte.from_lonlat([10, 0, 90, -130], [20, 90, 0, -30])),
                           from_=(10, 20), to=(-105, 40))
    assert abs(moved.points[0] - boulder).max() < 1e-15
    back = calotte.rotate(there, from_=(-105, 40), to=(10, 20), bearing=-30)
    assert abs(back.points / 6371220 - base.points / 6371220).max() <= 3e-16
    assert there._order == "input"
    there.to_mpas(tmp_path / "python.nc")
    subprocess.run([COMMAND, "rotate", file, "--from", "10,20", "--to", "-105,40", "--bearing", "30", "-o",
                    tmp_path / "command.nc"], check=True, capture_output=True)
    ours, theirs = read_all(tmp_path / "python.nc"), read_all(tmp_path / "command.nc")
    assert (ours.points == theirs.points).all() and (ours.triangles == theirs.triangles).all()


def test_rotated_directions(tmp_path):
    base = calotte.cvt(642).mesh
    x = base.points
    east = np.stack([-x[:, 1], x[:, 0], 0 * x[:, 0]], axis=1)
    base.to_mpas(tmp_path / "winds.nc", fields={"windZonal": np.hypot(x[:, 0], x[:, 1]), "windMeridional": 0 * x[:, 0],
                                                "stressZonal": x[:, 0]})
    with pytest.warns(UserWarning, match="not turned, and wrong at the new place: stressZonal"):
        there = calotte.rotate(read_all(tmp_path / "winds.nc"), from_=(0, 90), to=(0, 0))
    wind = np.cross([1, 0, 0], there.points)   # the axis of rotation moved with the mesh
    to_east = np.stack([-there.points[:, 1], there.points[:, 0], 0 * east[:, 0]], axis=1)
    to_east /= np.linalg.norm(to_east, axis=1)[:, None]
    assert abs(there.fields["windZonal"] - (wind * to_east).sum(axis=1)).max() < 1e-14


@pytest.mark.parametrize("arguments, words", [
    ({"from_": (0, 91), "to": (0, 0)}, "the latitude 91; give finite degrees"),
    ({"from_": (0, 0, 1), "to": (0, 0)}, "from_ is .0, 0, 1.; give .longitude, latitude. in degrees"),
    ({"from_": "0,0", "to": (0, 0)}, "from_ must be numbers"),
    ({"from_": (0, 0), "to": (0, 0), "bearing": np.inf}, "the bearing is"),
])
def test_bad_rotations(base, arguments, words):
    with pytest.raises(calotte.Error, match=words) as caught:
        calotte.rotate(base, **arguments)
    assert "\n" not in str(caught.value)
    plane = calotte.cvt(100, surface=calotte.rectangle((0, 0), (1, 1))).mesh
    with pytest.raises(calotte.Error, match="a mesh of the sphere"):
        calotte.rotate(plane, from_=(0, 0), to=(1, 1))


def test_other_grids(tmp_path):
    channel = calotte.cvt(200, surface=calotte.periodic_box(2, 1), walls="y")
    with pytest.raises(calotte.Error, match="polygons have no triangles; give a mesh"):
        calotte.refine(channel.cells, 0.05)
    with pytest.raises(calotte.Error, match="the mesh is str; give a Mesh"):
        calotte.refine("base.nc", 0.05)
    plane = calotte.delaunay(np.random.default_rng(1).random((300, 2)), calotte.plane())
    with pytest.raises(calotte.Error, match="of a plane: rectangle"):
        calotte.refine(plane, region=SPOT, factor=2)
