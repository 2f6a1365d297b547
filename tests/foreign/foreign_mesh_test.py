# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of others: every format, written here without Calotte, in every state in which they are
found, through info, check, convert and draw. Each is read right, by the truth made here, or refused
with a message that this test pins. Nothing may be silent and wrong.

foreign_mesh_test.py CALOTTE [WORD]     only the cases whose name holds the word
foreign_mesh_test.py CALOTTE --clients [WORD]     files that VTK and the NetCDF library write themselves;
exit code 77, which skips the test, where these are not installed, unless CALOTTE_CLIENTS is required."""
import copy
import math
import os
import random
import re
import subprocess
import sys
import tempfile

import formats
import netcdf3
import truth

CLIENTS = "--clients" in sys.argv[2:]
CALOTTE, ONLY = os.path.abspath(sys.argv[1]), "".join(word for word in sys.argv[2:] if word != "--clients")
WRITERS = formats
if CLIENTS:
    try:
        import formats_of_clients as WRITERS
    except ImportError as missing:
        print(f"{missing}: tools/setup --clients")
        sys.exit(1 if os.environ.get("CALOTTE_CLIENTS") == "required" else 77)
EARTH = 6371229.0
ORDERED = {"scrip.nc", "esmf.nc", "cells.nc", "minimal.nc", "full.nc", "ugrid.nc", "filled.nc",
           "fesom.mesh.diag.nc"}  # demand counter-clockwise cells
faults, cases = [], 0


class Case:
    """What a writer needs. `sites` are the unit vectors of the cells in the file's order."""

    def __init__(self, mesh):
        self.points = list(mesh.sites)
        self.triangles = [tuple(t) for t in mesh.triangles]
        self.corners, self.cells = list(mesh.corners), [list(c) for c in mesh.cells]
        self.centres, self.areas = list(mesh.sites), list(mesh.areas)
        self.base, self.radius = 0, 1.0


def clockwise(case):
    case.triangles = [(a, c, b) for a, b, c in case.triangles]
    case.cells = [c[::-1] for c in case.cells]


def half_turned(case):
    case.triangles = [(a, c, b) if k % 2 else (a, b, c) for k, (a, b, c) in enumerate(case.triangles)]
    case.cells = [c[::-1] if k % 2 else c for k, c in enumerate(case.cells)]


def rotated(case):
    case.triangles = [t[k % 3:] + t[:k % 3] for k, t in enumerate(case.triangles)]
    case.cells = [c[k % len(c):] + c[:k % len(c)] for k, c in enumerate(case.cells)]


def shuffled(case):
    random.seed(3)
    random.shuffle(case.triangles)
    order = list(range(len(case.cells)))
    random.shuffle(order)
    for name in ("cells", "centres", "areas"):
        setattr(case, name, [getattr(case, name)[k] for k in order])


def from_one(case):
    case.base = 1


def in_metres(case):
    case.radius = EARTH
    case.points = [tuple(EARTH * x for x in p) for p in case.points]


def in_kilometres(case):
    case.radius = EARTH / 1000
    case.points = [tuple(EARTH / 1000 * x for x in p) for p in case.points]


def opened(case):
    """Without a cap around the north pole and a notch, so that the boundary is not convex."""
    def kept(p):
        return p[2] < 0.6 and not (p[0] > 0.7 and abs(p[1]) < 0.3)
    units = [truth.unit(p) for p in case.points]
    case.triangles = [t for t in case.triangles if all(kept(units[i]) for i in t)]
    stay = [kept(p) for p in case.centres]
    for name in ("cells", "centres", "areas"):
        setattr(case, name, [v for v, keep in zip(getattr(case, name), stay) if keep])


def quads(case):
    case.corners, case.cells, case.centres = truth.cube_of_quads(4)
    case.areas = [truth.polygon_area([case.corners[k] for k in c]) for c in case.cells]


STATES = {"as is": lambda case: None, "clockwise": clockwise, "half turned": half_turned,
          "rotated": rotated, "shuffled": shuffled, "from one": from_one, "in metres": in_metres,
          "in kilometres": in_kilometres, "open": opened, "quads": quads}


def calotte(folder, *words):
    done = subprocess.run([CALOTTE, *words], cwd=folder, capture_output=True, text=True, check=False,
                          timeout=60)
    return done.returncode, done.stdout, done.stderr


def require(holds, what, detail=""):
    if not holds:
        faults.append(f"{current}: {what} {detail}".rstrip())


def format_of(name):
    """The row of the same contents."""
    return name.removeprefix("netcdf4-")


def row(text, name):
    """The words of a table's row after its name."""
    for line in text.splitlines():
        if line.startswith(name):
            return line[len(name):].split()
    return []


def close(a, b, tolerance):
    return abs(a - b) <= tolerance * max(abs(a), abs(b), 1e-300)


# ---- What must be true of an MPAS file

def check_mpas(path, case, radius):
    file = netcdf3.File(path)
    n = file.dimensions["nCells"]
    get = file.values
    require(n == len(case.centres), "MPAS has another number of cells", str(n))
    require(close(file.attributes["sphere_radius"], radius, 1e-9), "sphere_radius",
            str(file.attributes["sphere_radius"]))
    place = lambda kind, i: tuple(get(a + kind)[i] / radius for a in "xyz")
    # Cells are numbered anew: find each by its place, coarsely, which is exact below.
    key = lambda p: tuple(round(x, 4) for x in p)
    index = {key(p): k for k, p in enumerate(case.centres)}
    width = file.dimensions["maxEdges"]
    for i in range(n):
        centre = place("Cell", i)
        k = index.get(key(centre))
        if k is None:
            k = min(range(n), key=lambda j: -truth.dot(case.centres[j], centre))
        require(truth.dot(case.centres[k], centre) > 1 - 1e-12, "a cell moved", str(i))
        require(close(get("areaCell")[i] / radius ** 2, case.areas[k], 1e-6), "areaCell", f"{i}")
        if "size" in file.variables:
            require(close(get("size")[i], case.areas[k], 1e-12), "the field size", str(i))
        count = get("nEdgesOnCell")[i]
        ring = [get("verticesOnCell")[width * i + j] - 1 for j in range(count)]
        require(truth.polygon_area([place("Vertex", v) for v in ring]) > 0, "verticesOnCell is clockwise",
                str(i))
    for v in range(file.dimensions["nVertices"]):
        a, b, c = (place("Cell", get("cellsOnVertex")[3 * v + j] - 1) for j in range(3))
        require(truth.area(a, b, c) > 0, "cellsOnVertex is clockwise", str(v))
    for e in range(file.dimensions["nEdges"]):
        c1, c2 = (place("Cell", get("cellsOnEdge")[2 * e + j] - 1) for j in range(2))
        v1, v2 = (place("Vertex", get("verticesOnEdge")[2 * e + j] - 1) for j in range(2))
        require(truth.dot(truth.cross(truth.minus(c2, c1), truth.minus(v2, v1)), c1) > 0,
                "an edge's normal and tangent", str(e))
        if "flow" in file.variables:
            require(abs(get("flow")[e] - case.radius * (c2[0] - c1[0])) < 1e-9 * case.radius,
                    "the field flow along an edge", str(e))
        p = truth.unit(tuple(x + y for x, y in zip(c1, c2)))
        east = truth.unit((-p[1], p[0], 0.0))
        north = truth.cross(p, east)
        normal = truth.minus(c2, c1)
        angle = math.atan2(truth.dot(normal, north), truth.dot(normal, east))
        off = (get("angleEdge")[e] - angle + math.pi) % (2 * math.pi) - math.pi
        require(abs(off) < 0.05, "angleEdge", f"{e}: {off}")
        require(close(get("dcEdge")[e] / radius, math.acos(max(-1.0, min(1.0, truth.dot(c1, c2)))), 1e-6),
                "dcEdge", str(e))


# ---- What must be said

def read_right(folder, name, options, case, radius, turned):
    n = len(case.centres)
    code, out, err = calotte(folder, "info", name, *options)
    require(code == 0, "info", err)
    require(row(out, "cells ") == [str(n)], "info counts cells", out)
    require(turned == bool(re.search(r"turned \d+ clockwise", out)), "info says what was turned", out)
    require(close(float((row(out, "cells / 4 pi") or [0])[0]), 1, 1e-9), "info's area", out)
    code, out, err = calotte(folder, "check", name, *options)
    if turned and format_of(name) in ORDERED:
        require(code == 1 and "counter-clockwise" in out
                and "deviate" in err, "check tells of the order", out + err)
    else:
        require(code == 0, "check", out + err)
    require(row(out, "sites") == [str(n)], "check counts sites", out)
    require(close(float((row(out, "area / 4 pi") or [0])[0]), 1, 1e-9), "check's area", out)
    code, out, err = calotte(folder, "convert", name, "out.nc", *options)
    require(code == 0, "convert", err)
    require(turned == bool(re.search(r"turned \d+ clockwise", out)), "convert says what was turned", out)
    if code == 0:
        check_mpas(os.path.join(folder, "out.nc"), case, radius)
    draw(folder, name, options, "cells")


def draw(folder, name, options, what):
    code, _, err = calotte(folder, "draw", name, "-o", "out.png", "--what", what, "--size", "64", "--no-coastlines",
                           *options)
    require(code == 0 and os.path.getsize(os.path.join(folder, "out.png")) > 500, "draw", err)


def refused(folder, name, options, words, commands=("info", "check", "convert", "draw")):
    outputs = {"convert": ["out.nc"], "draw": ["-o", "out.png"]}
    for command in commands:
        code, out, err = calotte(folder, command, name, *outputs.get(command, []), *options)
        require(code != 0 and err.count("\n") == 1 and words in err, command + " refuses", str(code) + err + out)
        require(not os.path.exists(os.path.join(folder, "out.nc")), command + " wrote something")


def read_open(folder, name, options, case):
    code, out, err = calotte(folder, "info", name, *options)
    require(code == 0 and "the mesh is open" in out, "info", out + err)
    require(row(out, "triangles ") == [str(len(case.triangles))], "info counts triangles", out)
    area = sum(truth.area(*(truth.unit(case.points[i]) for i in t)) for t in case.triangles)
    require(close(float((row(out, "triangles / 4 pi") or [0])[0]) * 4 * math.pi, area, 1e-9), "area", out)
    code, out, err = calotte(folder, "check", name, *options)
    if name == "nod2d.out":  # FESOM refuses triangles at corners, and nodes without triangles
        require(code == 1 and "triangles: each has two neighbours or more" in out
                and "nodes: each is in a triangle" in out, "check tells of FESOM's rules", out + err)
    else:
        require(code == 0 and "every edge" in out, "check", out + err)
    sides = {}
    for a, b, c in case.triangles:
        for side in ((a, b), (b, c), (c, a)):
            key = (min(side), max(side))
            sides[key] = sides.get(key, 0) + 1
    boundary = sum(1 for count in sides.values() if count == 1)
    require(row(out, "boundary edges") == [str(boundary)], "boundary edges", out)
    refused(folder, name, options, "the mesh is open", ("convert",))
    draw(folder, name, options, "triangles")


def to_open_mpas(folder, name, case):
    """Voronoi cells with a boundary go to MPAS as they are."""
    code, out, err = calotte(folder, "convert", name, "open.nc")
    require(code == 0, "convert to MPAS", err)
    if code != 0:
        return
    areas = netcdf3.File(os.path.join(folder, "open.nc")).values("areaCell")
    require(len(areas) == len(case.areas) and all(map(lambda a, b: close(a, b, 1e-9), areas, case.areas)),
            "areaCell of an open mesh")
    code, out, err = calotte(folder, "check", "open.nc")
    require(code == 0, "check of the open mesh", out + err)
    for made in ("open.nc", "open.graph.info"):
        os.remove(os.path.join(folder, made))


def read_cells(folder, name, case, words, voronoi):
    """Cells that are no Voronoi cells of the whole sphere, carried as they are."""
    total = sum(case.areas) / (4 * math.pi)
    code, out, err = calotte(folder, "info", name)
    require(code == 0 and words in out, "info", out + err)
    require(row(out, "cells ") == [str(len(case.cells))], "info counts cells", out)
    require(close(float((row(out, "cells / 4 pi") or [0])[0]), total, 1e-9), "info's area", out)
    code, out, err = calotte(folder, "check", name)
    require(code == 0 and ("yes, inside the boundary" if voronoi else words) in out, "check", out + err)
    if voronoi:
        to_open_mpas(folder, name, case)
    else:
        refused(folder, name, [], "MPAS needs Voronoi cells", ("convert",))
    code, out, err = calotte(folder, "convert", name, "copy.nc", "--format", "scrip" if "centres" not in words
                             else "ugrid")
    require(code == 0, "convert to cells", err)
    if code == 0 and "centres" not in words:
        file = netcdf3.File(os.path.join(folder, "copy.nc"))
        corners, most = len(case.cells), file.dimensions["grid_corners"]
        place = lambda k: tuple(map(float, to_unit(file.values("grid_corner_lon")[k],
                                                   file.values("grid_corner_lat")[k])))
        for i in range(corners):
            area = truth.polygon_area([place(i * most + k) for k in range(most)])
            require(close(area, case.areas[i], 1e-9), "the area of a copied cell", str(i))
        os.remove(os.path.join(folder, "copy.nc"))
    draw(folder, name, [], "cells")


def to_unit(east, north):
    east, north = math.radians(east), math.radians(north)
    return (math.cos(north) * math.cos(east), math.cos(north) * math.sin(east), math.sin(north))


def run_triangles(folder, name, state, case):
    options = ["--points", "mesh.points.txt"] if name == "mesh.tri" else []
    if name == "SaveVertices" and state in ("clockwise", "half turned"):
        read_right(folder, name, options, case, 1.0, False)  # its triangles have no turning
    elif name == "SaveVertices" and state == "open":
        triangulated_anew(folder, name, case)
    elif state == "half turned":
        refused(folder, name, options, "run the other way, so the file contradicts itself")
    elif state == "open":
        read_open(folder, name, options, case)
    else:
        radius = EARTH if state in ("in metres", "in kilometres") else 1.0
        read_right(folder, name, options, case, radius, state == "clockwise")


def triangulated_anew(folder, name, case):
    """MPI-SCVT's triangles are taken where they close the sphere; other ones are said to be left."""
    for words in (["info", name], ["check", name], ["convert", name, "out.nc"]):
        code, out, err = calotte(folder, *words)
        require(code == 0 and f"{name}: triangulated {len(case.points)} points" in out, words[0], out + err)


def run_cells(folder, name, state, case):
    without_centres = name in WRITERS.WITHOUT_CENTRES
    if state == "half turned" and name not in formats.FREE_TURNING:
        refused(folder, name, [], "the file contradicts itself")
    elif state in ("open", "quads") or without_centres:
        read_cells(folder, name, case, "the cells have no centres" if without_centres else
                   "the mesh is open" if state == "open" else "Voronoi",
                   state == "open" and not without_centres)
    else:
        read_right(folder, name, [], case, 1.0, state in ("clockwise", "half turned"))


mesh = truth.Mesh()
for kind, writers in (("triangles", WRITERS.TRIANGLES), ("cells", WRITERS.CELLS)):
    for name, write in writers.items():
        for state, change in STATES.items():
            current = f"{name}, {state}"
            if ONLY not in current:
                continue
            if state == "quads" and kind == "triangles":
                continue
            if state == "from one" and format_of(name) not in formats.FREE_BASE:
                continue
            if state in ("in metres", "in kilometres") and (kind == "cells" or format_of(name) in formats.ANGLES):
                continue
            if state == "open" and format_of(name) == "full.nc":
                continue  # check_open_mpas_test has whole files of open meshes
            if state == "clockwise" and name == "bare.nc":
                continue  # as that of filled.nc
            if CLIENTS and state in ("rotated", "shuffled", "in metres"):
                continue  # a writer has no part in these
            case = Case(mesh)
            change(case)
            cases += 1
            with tempfile.TemporaryDirectory() as folder:
                write(os.path.join(folder, name), copy.copy(case))
                (run_triangles if kind == "triangles" else run_cells)(folder, name, state, case)

for fault in faults[:int(os.environ.get("FAULTS", "40"))]:
    print(fault)
print(f"{cases} cases, {len(faults)} faults")
sys.exit(1 if faults or not cases else 0)
