# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of other programs that are no mesh of the whole sphere, or no mesh that can be read: channels,
grids of rows and columns, files without records. What is read is compared with truth made here; what is
not is named, with its remedy.

odd_files_test.py CALOTTE [WORD]     only the cases whose name holds the word"""
import math
import os
import subprocess
import sys
import tempfile

import formats
import netcdf3
import truth
from hexagons import Hexagons

CALOTTE, ONLY = os.path.abspath(sys.argv[1]), "".join(sys.argv[2:])
faults, cases = [], []


def case(function):
    cases.append(function)
    return function


class Bench:
    def __init__(self, folder, name):
        self.folder, self.name = folder, name

    def path(self, name):
        return os.path.join(self.folder, name)

    def text(self, name, *lines):
        formats.text(self.path(name), lines)

    def require(self, holds, what, detail=""):
        if not holds:
            faults.append(f"{self.name}: {what} {detail}".rstrip())

    def run(self, *words):
        done = subprocess.run([CALOTTE, *words], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=60)
        return done.returncode, done.stdout, done.stderr

    def passes(self, *words):
        code, out, err = self.run(*words)
        self.require(code == 0 and not err, " ".join(words), out + err)
        return out

    def refuses(self, words, *messages):
        code, out, err = self.run(*words)
        self.require(code == 2 and not out and err.count("\n") == 1, " ".join(words), out + err)
        for message in messages:
            self.require(message in err, " ".join(words) + " says", err)

    def row(self, out, name):
        for line in out.splitlines():
            if line.startswith(name):
                return line[len(name):].split()
        self.require(False, "no row " + name, out)
        return ["nan"] * 3

    def close(self, value, right, what, tolerance=1e-5):
        self.require(abs(float(value) - right) <= tolerance * abs(right), what, f"{value} instead of {right}")


# ---- Records

@case
def files_without_records(bench):
    mesh = truth.Mesh()
    n, m = len(mesh.sites), len(mesh.triangles)
    places = {axis + "Cell": (("nCells",), [p[k] for p in mesh.sites], {}) for k, axis in enumerate("xyz")}
    places["cellsOnVertex"] = (("nVertices", "three"), [i + 1 for t in mesh.triangles for i in t], {})
    for version in (1, 2, 5):
        for count in (1, 2, 3):
            for records in (0, 1, 2):
                fields = {f"u{k}": (("Time", "nCells"), [0.5] * (n * records), {}) for k in range(count)}
                name = f"v{version}_{count}_{records}.nc"
                netcdf3.write(bench.path(name), {"Time": None, "nCells": n, "nVertices": m, "three": 3},
                              {**fields, **places}, {"on_a_sphere": "YES", "sphere_radius": 1.0}, version, records)
                bench.require(bench.row(bench.passes("info", name), "cells ") == [str(n)], "cells of " + name)
                with open(bench.path(name), "r+b") as file:
                    file.truncate(os.path.getsize(file.name) - 8)
                bench.refuses(["info", name], "it is cut short")


# ---- The plane

def check_channel(bench, mesh, name, area):
    out = bench.passes("check", name, "--plane")
    n = len(mesh.cells)
    bench.require(bench.row(out, "sites") == [str(n)], "sites", out)
    bench.require(bench.row(out, "triangles") == [str(mesh.triangles())], "triangles", out)
    bench.require(bench.row(out, "boundary edges") == [str(mesh.boundary())], "boundary edges", out)
    out = bench.passes("info", name, "--plane")
    bench.require(bench.row(out, "cells") == [str(n)], "cells", out)
    bench.require(bench.row(out, "boundary edges") == [str(mesh.boundary())], "boundary edges", out)
    for value in bench.row(out, "spacing"):
        bench.close(value, mesh.dc, "spacing")
    for value in bench.row(out, "dv / dc"):
        bench.close(value, 1 / math.sqrt(3), "dv / dc")
    for value in bench.row(out, "cell area"):
        bench.close(value, area, "cell area")
    report = bench.path("report.json")
    bench.passes("info", name, "--plane", "--report", "report.json")
    with open(report, encoding="ascii") as file:
        bench.require(f'"cells": {n},' in file.read(), "the report")
    bench.passes("convert", name, "copy.nc", "--plane")
    copy = netcdf3.File(bench.path("copy.nc"))
    bench.require(copy.attributes["is_periodic"] == "YES", "is_periodic")
    period = mesh.period[::-1] if mesh.turned else mesh.period
    for k, axis in enumerate("xy"):
        bench.require(copy.attributes[axis + "_period"] == period[k], axis + "_period")
    bench.require(copy.dimensions["nEdges"] == len(mesh.edges), "nEdges", str(copy.dimensions))
    bench.require(copy.dimensions["nVertices"] == len(mesh.corners), "nVertices", str(copy.dimensions))
    for variable, right in (("areaCell", area), ("dcEdge", mesh.dc), ("dvEdge", mesh.dc / math.sqrt(3))):
        for value in copy.values(variable):
            bench.close(value, right, variable + " of the copy", 1e-12)
    bench.require(list(copy.values("bottomDepth")) == [float(i) for i in range(n)], "a field")
    bench.passes("check", "copy.nc", "--plane")
    bench.passes("convert", name, "cells.vtp", "--plane", "--format", "vtp-cells")
    bench.passes("convert", name, "grid.nc", "--plane", "--format", "ugrid")
    grid = netcdf3.File(bench.path("grid.nc"))
    for value in grid.values("cell_area"):
        bench.close(value, area, "the area of a copied cell", 1e-12)
    bench.refuses(["convert", name, "triangles.vtp", "--plane"], "a periodic plane")
    for what in ("cells", "triangles", "both"):
        bench.passes("draw", name, "-o", what + ".png", "--plane", "--what", what, "--size", "300")
    bench.passes("draw", name, "-o", "valence.png", "--plane", "--what", "cells", "--colour", "valence",
                 "--size", "300")
    code, out, err = bench.run("view", name, "-o", "page.html", "--plane")  # says what reading changed
    bench.require(code == 0 and f"page of {n} cells" in out, "view", out + err)
    out = bench.passes("info", name, "--plane", "--cell", str(n - 1))
    bench.close(bench.row(out, "area")[0], area, "the area of a cell", 1e-3)


def channel(bench, **choice):
    mesh = Hexagons(10, 6, 5000.0, **choice)
    mesh.write(bench.path("mesh.nc"))
    area = math.sqrt(3) / 2 * 5000.0 ** 2
    check_channel(bench, mesh, "mesh.nc", area)


@case
def channel_along_x(bench):
    channel(bench)


@case
def channel_along_y(bench):
    channel(bench, turned=True)


@case
def channel_with_an_island_at_the_seam(bench):
    channel(bench, culled={(0, 2), (9, 2), (9, 3)})


@case
def channel_with_a_bay(bench):
    channel(bench, culled={(4, 0), (4, 1), (5, 1)})


@case
def box_with_a_lake(bench):
    channel(bench, box=True, culled={(0, 0), (1, 0)})


@case
def channel_that_is_not_culled_yet(bench):
    mesh = Hexagons(10, 6, 5000.0, box=True)
    mesh.period[1] = 0.0
    mesh.write(bench.path("mesh.nc"))
    bench.refuses(["info", "mesh.nc", "--plane"], "y_period is 0", "cells join its walls")


@case
def jigsaw_without_a_kind(bench):
    for head in ("mshid=1", "MSHID=3", "mshid=3;", "MSHID=3;EUCLIDEAN-MESH"):
        bench.text("plane.msh", head, "ndims=2", "point=4", "0;0;0", "1;0;0", "1.1;1;0", "0;1;0", "tria3=2",
                   "0;1;3;0", "1;2;3;0")
        bench.require(bench.row(bench.passes("check", "plane.msh", "--plane"), "sites") == ["4"], head)


GMSH_SQUARE = ("$Nodes", "4", "1 0 0 0", "2 1 0 0", "3 1.1 1 0", "4 0 1 0", "$EndNodes")


@case
def gmsh_of_the_plane(bench):
    bench.text("plane.msh", "$MeshFormat", "2.2 0 8", "$EndMeshFormat", *GMSH_SQUARE, "$Elements", "3",
               "1 1 2 0 1 1 2", "2 2 2 0 1 1 2 4", "3 2 0 2 3 4", "$EndElements")
    bench.require(bench.row(bench.passes("check", "plane.msh", "--plane"), "triangles") == ["2"], "triangles")


@case
def gmsh_that_is_not_read(bench):
    def refused(message, *lines):
        bench.text("mesh.msh", *lines)
        bench.refuses(["info", "mesh.msh"], message)

    head = ("$MeshFormat", "2.2 0 8", "$EndMeshFormat", *GMSH_SQUARE)
    refused("Mesh.Binary=0", "$MeshFormat", "2.2 1 8")
    refused("version 1", "$NOD", "1")
    refused("Mesh.MshFileVersion", "$MeshFormat", "3 0 8", "$EndMeshFormat")
    refused("a quadrangle", *head, "$Elements", "1", "1 3 0 1 2 3 4", "$EndElements")
    refused("of type 4", *head, "$Elements", "1", "1 4 0 1 2 3 4", "$EndElements")
    refused("without triangles", *head)
    refused("the node 9", *head, "$Elements", "1", "1 2 0 1 2 9", "$EndElements")
    refused("cut short", *head, "$Elements", "2", "1 2 0 1 2 3")
    refused("more lines than it announces", *head, "$Elements", "1", "1 2 0 1 2 3", "2 2 0 2 3 4", "$EndElements")
    refused("comes twice", "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", "2", "1 0 0 1", "1 0 1 0",
            "$EndNodes")


# ---- The sphere

@case
def three_points(bench):
    bench.text("three.txt", "0 0", "90 0", "0 90")
    bench.passes("delaunay", "three.txt", "--lonlat", "-o", "three.off")
    out = bench.passes("check", "three.off")
    bench.require(bench.row(out, "boundary edges") == ["3"], "boundary edges", out)
    out = bench.passes("info", "three.off")
    bench.close(bench.row(out, "triangles / 4 pi")[0], 1 / 8, "an octant", 1e-12)
    bench.text("line.txt", "0 0", "90 0", "45 0")
    bench.refuses(["delaunay", "line.txt", "--lonlat", "-o", "line.off"], "one great circle")
    bench.text("two.txt", "0 0", "90 0", "0 0")
    bench.refuses(["delaunay", "two.txt", "--lonlat", "-o", "two.off"], "needs at least 3")


def curvilinear(path, rows, columns, pad):
    """A patch of latitudes and longitudes as CMIP6 holds the grid of an ocean."""
    corner = lambda j, i: (10.0 * i, 5.0 * j)
    at = [(j, i) for j in range(rows) for i in range(columns)]
    rings = [[corner(j, i), corner(j, i + 1), corner(j + 1, i + 1), corner(j + 1, i)] for j, i in at]
    most = 4 + (1 if pad else 0)
    filled = {"_FillValue": 1e20} if pad else {}
    values = lambda k: [p[k] for ring in rings for p in ring + [(1e20, 1e20)] * (most - 4)]
    dims = ("j", "i")
    netcdf3.write(path, {"j": rows, "i": columns, "vertices": most},
                  {"latitude": (dims, [5.0 * j + 2.5 for j, _ in at],
                                {"units": "degrees_north", "bounds": "vertices_latitude"}),
                   "longitude": (dims, [10.0 * i + 5 for _, i in at],
                                 {"units": "degrees_E", "bounds": "vertices_longitude"}),
                   "vertices_latitude": ((*dims, "vertices"), values(1), filled),
                   "vertices_longitude": ((*dims, "vertices"), values(0), filled),
                   "depth": (dims, [1.0] * len(at), {})})
    unit = lambda p: tuple(f(math.radians(p[0]), math.radians(p[1])) for f in (
        lambda e, n: math.cos(n) * math.cos(e), lambda e, n: math.cos(n) * math.sin(e), lambda e, n: math.sin(n)))
    return sum(truth.polygon_area([unit(p) for p in ring]) for ring in rings)


@case
def rows_of_cells_with_four_corners(bench):
    for pad in (False, True):
        area = curvilinear(bench.path("ocean.nc"), 3, 4, pad)
        out = bench.passes("info", "ocean.nc")
        bench.require(bench.row(out, "cells ") == ["12"], "cells", out)
        bench.passes("convert", "ocean.nc", "copy.nc", "--format", "scrip")
        bench.close(sum(netcdf3.File(bench.path("copy.nc")).values("grid_area")), area, "the area", 1e-12)
        bench.passes("draw", "ocean.nc", "-o", "ocean.png", "--what", "cells", "--size", "100")


@case
def fesom_channel(bench):
    nodes = [(0.45 * i, 0.3 * j) for j in range(4) for i in range(10)]
    at = lambda i, j: j * 10 + i % 10 + 1
    squares = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(3) for i in range(10)]
    triangles = [t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))]
    bench.text("nod2d.out", "40", *(f"{k + 1} {x:.4f} {y:.4f} 1" for k, (x, y) in enumerate(nodes)))
    bench.text("elem2d.out", "60", *(formats.line(t) for t in triangles))
    for words in (["info", "nod2d.out"], ["check", "nod2d.out"], ["convert", "nod2d.out", "out.off"]):
        bench.refuses(words, "6 triangles join both ends of a channel", "4.5 degrees", "cyclic_length")
    bench.text("elem2d.out", "54", *(formats.line(t) for t in triangles if max(t) - min(t) < 15 and
                                     max((x - 1) % 10 for x in t) - min((x - 1) % 10 for x in t) < 5))
    out = bench.passes("info", "nod2d.out")
    bench.require(bench.row(out, "triangles ") == ["54"], "triangles", out)


@case
def files_that_are_no_mesh(bench):
    east = {"units": "degrees_east", "standard_name": "longitude"}
    north = {"units": "degrees_north", "standard_name": "latitude"}

    def refused(variables, *messages):
        netcdf3.write(bench.path("file.nc"), {"n": 4, "k": 3, "two": 2}, variables)
        for words in (["info", "file.nc"], ["draw", "file.nc", "-o", "file.png"]):
            bench.refuses(words, *messages)
        bench.require(not os.path.exists(bench.path("file.png")), "a picture was drawn")

    places = {"lon": (("n",), [0.0, 1.0, 2.0, 3.0], east), "lat": (("n",), [0.0] * 4, north)}
    refused({**places, "faces": (("n", "k"), [0] * 12, {"cf_role": "face_node_connectivity"})},
            "faces of UGRID", 'cf_role "mesh_topology"')
    refused({**places, "elements": (("k", "n"), [1] * 12, {}), "edge_cross_dxdy": (("n",), [0.0] * 4, {})},
            "FESOM", "nod2d.out")
    refused({**places, "nv": (("k", "n"), [1] * 12, {}), "lonc": (("n",), [0.0] * 4, {})}, "FVCOM",
            "start_index 1")
    refused({"lon": (("n",), [0.0, 1.0, 2.0, 3.0], {**east, "bounds": "lon_bnds"}),
             "lat": (("k",), [0.0, 1.0, 2.0], {**north, "bounds": "lat_bnds"}),
             "lon_bnds": (("n", "two"), [0.0] * 8, {}), "lat_bnds": (("k", "two"), [0.0] * 6, {})},
            "rows and columns", "setgridtype")
    refused(places, "without bounds", "calotte delaunay")
    grid = {f"{model}.{what}": (("k", "n") if what.startswith("c") else ("n",),
                                [0.0] * (12 if what.startswith("c") else 4), {})
            for model in ("ocea", "atmo") for what in ("lon", "lat", "clo", "cla")}
    refused(grid, "several models (ocea, atmo)", "ncks -v ocea.lon")
    refused({"a": (("n",), [1.0] * 4, {})}, "no mesh of MPAS, UGRID")
    netcdf3.write(bench.path("out.nc"), {"nCells": 4}, {"u": (("nCells",), [0.0] * 4, {})})
    bench.refuses(["info", "out.nc"], "fields of MPAS without the mesh", "ncks -A")


count = 0
for function in cases:
    title = function.__name__.replace("_", " ")
    if ONLY not in title:
        continue
    count += 1
    with tempfile.TemporaryDirectory() as directory:
        try:
            function(Bench(directory, title))
        except OSError as missing:
            faults.append(f"{title}: {missing}")
for fault in faults[:int(os.environ.get("FAULTS", "40"))]:
    print(fault)
print(f"{count} cases, {len(faults)} faults")
sys.exit(1 if faults or not count else 0)
