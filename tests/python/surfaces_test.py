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
PLANE = calotte.delaunay([(0, 0), (1, 0), (0, 1), (3, 2)], plane=True).surface


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
    with pytest.raises(calotte.Error, match="n x 2 in the plane"):
        BASIN.contains(np.eye(3))


def test_a_surface_of_the_other_kind():
    mesh = calotte.delaunay(calotte.random_sphere(20))
    box = calotte.delaunay(calotte.random_places(200, BOX), period=(2, 1))
    for text, call in (
            (r"circle\(\), ellipse\(\)", lambda: calotte.cvt(100, region=BASIN)),
            (r"rectangle\(\)", lambda: calotte.cvt(100, domain=CAP)),
            (r"rectangle\(\)", lambda: calotte.random_places(10, CAP)),
            ("the surface is a plane", lambda: BASIN.widened(0.1)),
            ("the mesh is on the sphere", lambda: calotte.voronoi(mesh, BASIN)),
            ("different periods", lambda: calotte.quality(box, domain=BASIN)),
            ("no end", lambda: calotte.cvt(100, domain=PLANE)),
            ("two positive lengths", lambda: calotte.periodic_box(2, 0)),
            ("two positive lengths", lambda: calotte.delaunay(np.eye(3, 2), period=(0, 0))),
            ("a plane has none", box.topology)):
        with pytest.raises(calotte.Error, match=text):
            call()


@pytest.mark.parametrize("words, surface, line", [
    ({"region": CAP}, CAP, ", open"),
    ({"domain": BASIN}, BASIN, ", in a plane"),
    ({"domain": BOX}, BOX, ", in a plane, periodic in x and y"),
])
def test_the_mesh_of_a_run_has_its_surface(tmp_path, words, surface, line):
    mesh = calotte.cvt(200, **words).mesh
    assert mesh.surface == surface and repr(mesh).endswith(f" triangles{line}>")
    assert mesh.closed == (surface == BOX)
    again = pickle.loads(pickle.dumps(mesh))
    assert again.surface == surface and (again.points == mesh.points).all()
    rows = mesh.bisected_points()
    assert rows.shape[1] == mesh.points.shape[1] and (rows[:200] == mesh.points).all()
    assert surface.contains(rows).all()
    turned = mesh.renumbered("rcm")
    assert turned.surface == surface and len(turned.triangles) == len(mesh.triangles)
    if not surface.is_sphere:
        assert calotte.voronoi(mesh).cell_area.sum() == pytest.approx(surface.area)
        assert calotte.quality(mesh).cells_area == pytest.approx(1)
        calotte.write(tmp_path / "grid.nc", mesh)
        assert calotte.voronoi(calotte.read(tmp_path / "grid.nc")).cell_area.sum() == \
            pytest.approx(surface.area)


def test_a_domain_bounds_a_mesh_that_has_no_end():
    places = calotte.random_places(300, BASIN)
    mesh = calotte.delaunay(places, plane=True)
    assert calotte.voronoi(mesh, BASIN).cell_area.sum() == pytest.approx(BASIN.area)
    assert calotte.quality(mesh, domain=BASIN).cells == 300
    assert mesh.surface == PLANE


def test_points_of_a_plane_are_a_view():
    mesh = calotte.cvt(200, domain=BASIN).mesh
    points = mesh.points
    assert points.shape == (200, 2) and not points.flags.owndata and not points.flags.writeable
    assert np.shares_memory(points, mesh.points)
    assert calotte.random_places(5, BASIN).flags.c_contiguous
