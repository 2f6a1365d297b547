# SPDX-License-Identifier: GPL-3.0-or-later
"""Where points live, and meshes there."""
import math
import pickle

import numpy as np
import pytest

import calotte

CAP = calotte.circle((-105, 40), 20)
BASIN = calotte.planar_polygon([(0, 0), (4, 0), (4, 2), (0, 2)],
                               [(1, 0.7), (1.8, 0.7), (1.8, 1.3), (1, 1.3), (1, 0.7)])
BOX = calotte.periodic_box(2, 1)
PLANE = calotte.plane()


@pytest.mark.parametrize("surface, line, area, corners", [
    (calotte.Surface(), "the whole sphere", 4 * math.pi, []),
    (CAP, "1 ring, 360 corners, 0.3789 steradians", 2 * math.pi * (1 - math.cos(math.pi / 9)),
     [(360, 3)]),
    (BASIN, "2 rings, 8 corners, area 7.52 in a plane", 7.52, [(4, 2), (4, 2)]),
    (BOX, "periodic box 2 x 1", 2, []),
    (PLANE, "the whole plane", math.inf, []),
])
def test_what_surfaces_are(surface, line, area, corners):
    assert repr(surface) == f"<calotte.Surface: {line}>"
    assert surface.area == pytest.approx(area, rel=1e-3)
    assert [ring.shape for ring in surface.rings] == corners
    assert surface.is_bounded == bool(corners)
    assert surface.is_sphere == ("sphere" in line or "steradians" in line)
    assert surface.period.tolist() == ([2, 1] if surface == BOX else [0, 0])
    again = pickle.loads(pickle.dumps(surface))
    assert again == surface and again.area == surface.area
    assert [other == surface for other in (calotte.Surface(), CAP, BASIN, BOX, PLANE)].count(True) == 1


def test_what_surfaces_contain():
    assert CAP.contains([(-105, 40), (-105, 59), (-105, 61)]).tolist() == [True, True, False]
    assert CAP.contains(3 * calotte.from_lonlat(-105, 40)).tolist() == [True]
    assert BASIN.contains([(1.2, 1), (0.5, 1), (4, 1), (5, 1)]).tolist() == [False, True, True, False]
    assert BOX.contains([(0, 0), (2, 0)]).tolist() == [True, False]
    assert CAP.widened(0.1).contains([(-105, 61), (-105, 70)]).tolist() == [True, False]
    with pytest.raises(calotte.Error, match="n x 2 for a surface in the plane"):
        BASIN.contains(np.eye(3))


def test_a_surface_of_the_other_kind():
    mesh, flat = calotte.delaunay(calotte.random_points(20)), calotte.delaunay(np.eye(3, 2), calotte.plane())
    box = calotte.delaunay(calotte.random_points(200, BOX), BOX)
    for text, call in (
            (r"surface is 7; give one of the sphere: .*, or of a plane: ",
             lambda: calotte.cvt(100, surface=7)),
            (r"in a plane>; give one of the sphere: Surface\(\), circle",
             lambda: calotte.limited_area("never.nc", BASIN, 100.0)),
            ("box 2 x 1>; give one of the sphere", lambda: calotte.cut("globe.nc", "never.nc", BOX)),
            (r"surface is <calotte.Surface: 1 ring.*>; give one of a plane: rectangle\(\)",
             lambda: calotte.hexagonal_lattice(10, CAP)),
            ("give one of a plane", lambda: calotte.voronoi(flat, CAP)),
            ("surface circle=0,0,1: ", lambda: calotte.random_points(10, "circle=0,0,1")),
            ("the surface is a plane", lambda: BASIN.widened(0.1)),
            ("the mesh is on the sphere", lambda: calotte.voronoi(mesh, BASIN)),
            ("different periods", lambda: calotte.quality(box, surface=BASIN)),
            ("no end", lambda: calotte.cvt(100, surface=PLANE)),
            ("two positive lengths", lambda: calotte.periodic_box(2, 0)),
            ("a plane has none", box.topology)):
        with pytest.raises(calotte.Error, match=text):
            call()


@pytest.mark.parametrize("surface, line", [
    (CAP, ", open"), (BASIN, ", in a plane"), (BOX, ", in a plane, periodic in x and y"),
])
def test_the_mesh_of_a_run_has_its_surface(tmp_path, surface, line):
    mesh = calotte.cvt(200, surface=surface).mesh
    assert mesh.surface == surface and repr(mesh).endswith(f" triangles{line}>")
    assert mesh.closed == (surface == BOX)
    again = pickle.loads(pickle.dumps(mesh))
    assert again.surface == surface and (again.points == mesh.points).all()
    rows = mesh.bisected_points()
    assert rows.shape[1] == mesh.points.shape[1] and (rows[:200] == mesh.points).all()
    assert surface.contains(rows).all()
    turned = mesh.renumbered("curve")
    assert turned.surface == surface and len(turned.triangles) == len(mesh.triangles)
    if not surface.is_sphere:
        assert calotte.voronoi(mesh).cell_area.sum() == pytest.approx(surface.area)
        assert calotte.quality(mesh).cells_area == pytest.approx(1)
        calotte.write(tmp_path / "grid.nc", mesh)
        assert calotte.voronoi(calotte.read(tmp_path / "grid.nc")).cell_area.sum() == \
            pytest.approx(surface.area)


def test_a_surface_of_a_file(tmp_path):
    (tmp_path / "basin.txt").write_text("0 0\n4 0\n4 2\n0 2\n")
    ring = '{"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 2], [0, 2], [0, 0]]]}'
    (tmp_path / "basin.geojson").write_text(ring)
    whole = calotte.rectangle((0, 0), (4, 2))
    for file in (tmp_path / "basin.txt", str(tmp_path / "basin.geojson")):
        surface = calotte.planar_polygon(file)
        assert surface.area == whole.area and not surface.is_sphere
        mesh = calotte.delaunay(calotte.random_points(300, whole), calotte.plane())
        assert calotte.voronoi(mesh, file).cell_area.sum() == pytest.approx(8)
        assert len(calotte.hexagonal_lattice(100, file)) == len(calotte.hexagonal_lattice(100, whole))
    on_sphere = calotte.random_points(9, tmp_path / "basin.geojson")
    assert calotte.polygon([(0, 0), (4, 0), (4, 2), (0, 2)]).contains(on_sphere).all()
    with pytest.raises(calotte.Error, match="no format of regions.*planar_polygon") as caught:
        calotte.cvt(100, surface=tmp_path / "basin.txt")
    assert caught.value.code == "invalid_argument"
    with pytest.raises(calotte.Error, match="no.geojson: "):
        calotte.cvt(100, surface="no.geojson")


def test_a_surface_bounds_a_mesh_that_has_no_end():
    points = calotte.random_points(300, BASIN)
    mesh = calotte.delaunay(points, PLANE)
    assert calotte.voronoi(mesh, BASIN).cell_area.sum() == pytest.approx(BASIN.area)
    assert calotte.quality(mesh, surface=BASIN).cells == 300
    assert mesh.surface == PLANE
    bounded = calotte.delaunay(points, BASIN)
    assert bounded.surface == BASIN and (bounded.triangles == mesh.triangles).all()
    assert calotte.quality(bounded).cells == 300


def test_points_of_a_plane_are_a_view():
    mesh = calotte.cvt(200, surface=BASIN).mesh
    points = mesh.points
    assert points.shape == (200, 2) and not points.flags.owndata and not points.flags.writeable
    assert np.shares_memory(points, mesh.points)
    assert calotte.random_points(5, BASIN).flags.c_contiguous
