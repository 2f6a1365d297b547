# SPDX-License-Identifier: GPL-3.0-or-later
"""The same request gives the same bits to all callers: recipes_test.py SCRATCH NAME=PROGRAM...

A program makes a request and leaves the cells' generators in a file, 3 doubles each: PROGRAM REQUEST OUTPUT.
The name "command" stands for calotte itself, which gets words and files instead. The numbers of the requests are
in requests.h. To add a caller, write such a program."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np

# Name of each request, and what it asks for.
REQUESTS = {
    "uniform": "642 cells",
    "x8": "2562 cells, a density by a callback",
    "widths": "widths in km at 4 x 3 nodes, from which the number of cells follows",
    "rules": "rules for widths: by latitude and by distance, with a limited gradient",
    "region": "500 cells in a polygon on the sphere",
    "limited-area": "cells 200 km wide in a smaller polygon, with rings",
    "plane": "300 cells in the rectangle 0,0,2,1",
    "box": "400 cells in the periodic box 2 x 1",
    "walls": "300 cells in that box with walls in y",
    "fixed": "500 cells, 3 of them fixed",
    "points": "a start of 100 points",
    "pure": "642 cells, the density of x8, a pure CVT with the tolerance 1e-3",
    "well-centred": "642 cells, a well-centred end",
    "lloyd": "642 cells, that density, 20 iterations of Lloyd's method",
}

# The same in words of calotte cvt, with the suffix of the file that holds all generators in their order. A file of
# a limited area, and one between walls, holds a part of them. The command takes no callback.
WORDS = {
    "uniform": ("--cells 642", ".off"),
    "widths": ("--cell-width widths.nc", ".off"),
    "rules": ("--cell-width rules.toml", ".off"),
    "region": ("--cells 500 --region region.geojson", ".off"),
    "limited-area": ("--cell-width 200km --region small.geojson --limited-area", ".nc"),
    "plane": ("--cells 300 --rectangle 0,0,2,1", ".off"),
    "box": ("--cells 400 --periodic 2,1", ".nc"),
    "walls": ("--cells 300 --periodic 2,1 --walls y", ".nc"),
    "fixed": ("--cells 500 --fixed fixed.txt", ".off"),
    "points": ("start.txt", ".off"),
    "well-centred": ("--cells 642 --stop well-centred", ".off"),
}
PARTS = ("limited-area", "walls")

REGION = [(-115, 25), (-95, 25), (-85, 35), (-85, 45), (-95, 55), (-115, 55), (-125, 45), (-125, 35)]
SMALL = [(-110, 33), (-100, 33), (-95, 38), (-95, 42), (-100, 47), (-110, 47), (-115, 42), (-115, 38)]


def program(path):
    """A caller that runs PATH REQUEST OUTPUT; a Python program by this interpreter."""
    start = [sys.executable, "-B", path] if path.endswith(".py") else [path]

    def call(request, scratch):
        output = scratch / f"{request}.{Path(path).name}"
        subprocess.run([*start, request, output], check=True, cwd=scratch)
        return np.fromfile(output).reshape(-1, 3)

    return call


def write_inputs(scratch):
    """The texts that callers take: C reads rules.toml, the command all of them."""
    (scratch / "line.geojson").write_text(
        '{"type": "LineString", "coordinates": [[10, -20], [40, 30]]}')
    (scratch / "rules.toml").write_text("""[cell-width]
gradient = 0.1
minimum = [{by-latitude = [[-90, 900], [0, 700], [90, 900]]},
           {by-distance = "line.geojson", near = 300, far = 900, over = 4000}]
""")
    for name, ring in (("region", REGION), ("small", SMALL)):
        (scratch / f"{name}.geojson").write_text(
            json.dumps({"type": "Polygon", "coordinates": [[*ring, ring[0]]]}))
    (scratch / "fixed.txt").write_text("1 0 0\n0 1 0\n0 0.6 0.8\n")
    i = np.arange(100)[:, np.newaxis]
    modulus = np.array([101, 103, 107])
    start = ((i * [37, 59, 71] + [11, 5, 17]) % modulus - modulus // 2) / 8
    (scratch / "start.txt").write_text("".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in start.tolist()))


def write_raster(scratch):
    """The raster of widths, which the command alone takes as a file."""
    import netCDF4

    with netCDF4.Dataset(scratch / "widths.nc", "w") as file:
        for name, values in (("lat", [-60, 0, 60]), ("lon", [0, 90, 180, 270])):
            file.createDimension(name, len(values))
            file.createVariable(name, "f8", (name,))[:] = values
        width = file.createVariable("cellWidth", "f8", ("lat", "lon"))
        width.units = "km"
        width[:] = [[1200, 1000, 1100, 1300], [900, 800, 1000, 1200], [1100, 900, 1000, 1400]]


def points_of(path):
    """The points of an OFF file, or the cells of an MPAS file."""
    if path.suffix == ".off":
        lines = path.read_text().split("\n")
        count = int(lines[1].split()[0])
        return np.array([[float(word) for word in line.split()] for line in lines[2:2 + count]])
    import netCDF4

    with netCDF4.Dataset(path) as file:
        return np.stack([np.asarray(file[name][:]) for name in ("xCell", "yCell", "zCell")], axis=1)


def command(path):
    """calotte itself."""

    def call(request, scratch):
        if request not in WORDS:
            return None
        words, suffix = WORDS[request]
        output = scratch / f"{request}.command{suffix}"
        made = subprocess.run([path, "cvt", *words.split(), "-o", output.name], cwd=scratch,
                              capture_output=True, text=True)
        if made.returncode not in (0, 5): # 5: not well-centred, which the other callers tell otherwise
            sys.exit(f"calotte cvt {words}: {made.stderr}")
        return points_of(output)

    return call


def same(request, made, first):
    """True for the same bits; of a part for rows that are all among the others."""
    if request not in PARTS or len(made) == len(first):
        return made.tobytes() == first.tobytes()
    rows = {row.tobytes() for row in first}
    return 0 < len(made) < len(first) and all(row.tobytes() in rows for row in made)


def differs(request, scratch, callers):
    """True, with a line, unless all callers get the same."""
    results = {name: call(request, scratch) for name, call in callers.items()}
    first, *others = results
    if len(results[first]) == 0:
        print(f"{request}: {first} makes no cells")
        return True
    unlike = [name for name in others
              if results[name] is not None and not same(request, results[name], results[first])]
    for name in unlike:
        print(f"{request} ({REQUESTS[request]}): {first} makes {len(results[first])} cells and {name} "
              f"{len(results[name])}, which differ")
    return bool(unlike)


def main(scratch, *words):
    scratch = Path(scratch)
    scratch.mkdir(parents=True, exist_ok=True)
    callers = {}
    for word in words:
        name, path = word.split("=", 1)
        callers[name] = command(path) if name == "command" else program(path)
    write_inputs(scratch)
    if "command" in callers:
        write_raster(scratch)
    differences = sum(differs(request, scratch, callers) for request in REQUESTS)
    print(f"{len(REQUESTS)} requests, {len(callers)} callers, {differences} differences")
    return differences > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
