#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests whether programs that call JIGSAW run on ours instead, and whether JIGSAW reads our meshes.

    jigsaw_test.py FOLDER

FOLDER holds the programs jigsaw and marche of this project. The callers are not installed by Debian;
these environment variables name their folders:

    CALOTTE_JIGSAWPY    jigsaw-python: the folder that holds jigsawpy
    CALOTTE_MPAS_TOOLS  MPAS-Tools: the folder that holds mpas_tools (conda_package)
    CALOTTE_JIGSAW      JIGSAW: the folder of its own programs jigsaw and tripod

Exit code 77, which skips the test, without the first. What the others are for is left out without
them.
"""

import os
import subprocess
import sys
import tempfile

SKIPPED = 77
RADIUS = 6371.22  # km


def check(truth, message):
    if not truth:
        sys.exit(f"FAILED: {message}")


def areas(points, triangles):
    """Twice the vectors of the triangles."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def options(name, **more):
    opts = jigsawpy.jigsaw_jig_t()
    opts.geom_file, opts.jcfg_file = name + "-GEOM.msh", name + ".jig"
    opts.mesh_file, opts.hfun_file = name + "-MESH.msh", name + "-HFUN.msh"
    opts.hfun_scal, opts.hfun_hmax, opts.hfun_hmin = "absolute", float("inf"), 0.0
    opts.mesh_dims, opts.optm_qlim, opts.verbosity = 2, 0.9375, 1
    for key, value in more.items():
        setattr(opts, key, value)
    return opts


def sphere_of_jigsawpy():
    """Widths by latitude, limited by marche, meshed by jigsaw: both as jigsawpy calls them."""
    opts = options("sphere")
    geom = jigsawpy.jigsaw_msh_t()
    geom.mshID, geom.radii = "ELLIPSOID-MESH", RADIUS * np.ones(3)
    jigsawpy.savemsh(opts.geom_file, geom)
    size = jigsawpy.jigsaw_msh_t()
    size.mshID, size.radii = "ELLIPSOID-GRID", geom.radii
    size.xgrid, size.ygrid = np.linspace(-np.pi, np.pi, 145), np.linspace(-np.pi / 2, np.pi / 2, 73)
    size.value = np.where(np.abs(size.ygrid)[:, None] < 0.4, 250.0, 600.0) * np.ones((1, 145))
    size.slope = np.full(size.value.shape, 0.05)
    jigsawpy.savemsh(opts.hfun_file, size)
    jigsawpy.cmd.marche(opts, size)
    steps = np.abs(np.diff(size.value, axis=0)) / (RADIUS * np.diff(size.ygrid)[:, None])
    check(steps.max() < 0.0505, f"marche leaves a gradient of {steps.max()}")
    check(size.value.min() == 250, "marche changes the least width")
    mesh = jigsawpy.jigsaw_msh_t()
    jigsawpy.cmd.jigsaw(opts, mesh)
    points, triangles = mesh.point["coord"], mesh.tria3["index"]
    check(points.shape[1] == 3 and len(triangles) == 2 * len(points) - 4, "no closed mesh")
    check(np.abs(np.linalg.norm(points, axis=1) - RADIUS).max() < 1e-9, "not on the sphere")
    outward = (areas(points, triangles) * points[triangles[:, 0]]).sum(axis=1)
    check((outward > 0).all(), "triangles are not counter-clockwise from outside")
    check(mesh.power.size == len(points) and not mesh.power.any(), "no weights of 0")
    return opts, mesh


def plane_of_jigsawpy():
    opts = options("plane")
    geom = jigsawpy.jigsaw_msh_t()
    geom.mshID = "EUCLIDEAN-MESH"
    corners = [(0, 0), (9, 0), (9, 9), (0, 9), (4, 4), (6, 4), (6, 6), (4, 6)]
    geom.vert2 = np.array([(p, 0) for p in corners], dtype=geom.VERT2_t)
    geom.edge2 = np.array([((4 * r + k, 4 * r + (k + 1) % 4), 0) for r in range(2)
                           for k in range(4)], dtype=geom.EDGE2_t)
    jigsawpy.savemsh(opts.geom_file, geom)
    size = jigsawpy.jigsaw_msh_t()
    size.mshID = "EUCLIDEAN-GRID"
    size.xgrid = size.ygrid = np.linspace(-1, 10, 45)
    x, y = np.meshgrid(size.xgrid, size.ygrid)
    size.value = 0.2 + 0.05 * np.hypot(x - 4.5, y - 4.5)
    jigsawpy.savemsh(opts.hfun_file, size)
    mesh = jigsawpy.jigsaw_msh_t()
    jigsawpy.cmd.jigsaw(opts, mesh)
    points = np.pad(mesh.point["coord"], ((0, 0), (0, 1)))
    area = areas(points, mesh.tria3["index"])[:, 2] / 2
    check((area > 0).all() and abs(area.sum() - 77) < 1e-9, f"the area is {area.sum()}, not 77")
    check(len(mesh.edge2) > 0, "no edges of the boundary")


def driver_of_mpas_tools():
    from mpas_tools.mesh.creation.jigsaw_driver import jigsaw_driver
    from mpas_tools.mesh.creation.jigsaw_to_netcdf import jigsaw_to_netcdf
    lon, lat = np.linspace(-180, 180, 37), np.linspace(-90, 90, 19)
    widths = 400.0 + 200.0 * np.abs(lat[:, None] / 90) * np.ones((1, 37))
    jigsaw_driver(widths, lon, lat, on_sphere=True, earth_radius=6371.0e3)
    jigsaw_to_netcdf("mesh-MESH.msh", "mesh_triangles.nc", on_sphere=True, sphere_radius=6371.0e3)
    with netCDF4.Dataset("mesh_triangles.nc") as file:
        cells, vertices = file.dimensions["nCells"].size, file.dimensions["nVertices"].size
        radius = np.hypot(np.hypot(file["xCell"][:], file["yCell"][:]), file["zCell"][:])
    check(vertices == 2 * cells - 4, "MPAS-Tools' mesh is not closed")
    check(np.abs(radius / 6371.0e3 - 1).max() < 1e-12, "its cells are not on the sphere, in metres")
    corners = np.array([[0.0, 0], [900, 0], [900, 300], [0, 300]])
    points = np.array([(p, 0) for p in corners], dtype=jigsawpy.jigsaw_msh_t.VERT2_t)
    edges = np.array([((k, (k + 1) % 4), 0) for k in range(4)],
                     dtype=jigsawpy.jigsaw_msh_t.EDGE2_t)
    jigsaw_driver(30.0 * np.ones((4, 10)), np.linspace(0, 900, 10), np.linspace(0, 300, 4),
                  on_sphere=False, geom_points=points, geom_edges=edges)
    jigsaw_to_netcdf("mesh-MESH.msh", "plane.nc", on_sphere=False)
    with netCDF4.Dataset("plane.nc") as file:
        check(file.dimensions["nCells"].size > 300, "no planar mesh")
        check(float(file["xCell"][:].max()) == 900, "the planar mesh does not reach its boundary")


def read_by_jigsaw(folder, opts, mesh):
    """JIGSAW's own programs start from our mesh."""
    opts.init_file, opts.mesh_iter, opts.verbosity = opts.mesh_file, 0, 0
    for program in ("tripod", "jigsaw"):
        opts.mesh_file = program + "-MESH.msh"
        jigsawpy.savejig(opts.jcfg_file, opts)
        subprocess.run([os.path.join(folder, program), opts.jcfg_file], check=True,
                       stdout=subprocess.DEVNULL)
        theirs = jigsawpy.jigsaw_msh_t()
        jigsawpy.loadmsh(opts.mesh_file, theirs)
        check(abs(len(theirs.point) / len(mesh.point) - 1) < 0.01,
              f"{program} makes {len(theirs.point)} points of {len(mesh.point)}")


if __name__ == "__main__":
    os.environ["PATH"] = sys.argv[1] + os.pathsep + os.environ["PATH"]
    for variable in ("CALOTTE_JIGSAWPY", "CALOTTE_MPAS_TOOLS"):
        sys.path.insert(0, os.environ.get(variable, ""))
    try:
        import jigsawpy
        import netCDF4
        import numpy as np
    except ImportError as error:
        print(f"skipped: {error}; see the text of this test")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as scratch:
        os.chdir(scratch)
        jig, made = sphere_of_jigsawpy()
        plane_of_jigsawpy()
        done = ["jigsawpy"]
        if os.environ.get("CALOTTE_MPAS_TOOLS"):
            driver_of_mpas_tools()
            done.append("MPAS-Tools")
        if theirs_at := os.environ.get("CALOTTE_JIGSAW"):
            read_by_jigsaw(theirs_at, jig, made)
            done.append("JIGSAW")
    print("passed:", ", ".join(done))
