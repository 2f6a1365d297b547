#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares conservative interpolation with that of CDO, on cells of a mesh and boxes of a raster.

    interpolate_test.py CALOTTE

CDO's operator remapycon (YAC) clips cells on the sphere, with parallels as small circles. Weights
are exchanged in SCRIP's format, in both directions. Exit code 77, which skips the test, where CDO
or netCDF4 is not installed, unless the environment variable CALOTTE_CLIENTS is "required".
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import netCDF4
    import numpy as np
except ImportError:
    netCDF4 = np = None

SKIPPED = 77


def run(*command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    assert result.returncode == 0, (command, result.stdout, result.stderr)
    return result.stdout


def smooth(longitude, latitude):
    x, y = np.radians(longitude), np.radians(latitude)
    return 2 + np.cos(y) ** 2 * np.cos(2 * x) + 0.3 * np.sin(3 * y)


def make_raster(path, columns, rows):
    with netCDF4.Dataset(path, "w") as file:
        for name, size, first, step, unit, standard in (
                ("lat", rows, -90, 180 / rows, "degrees_north", "latitude"),
                ("lon", columns, 0, 360 / columns, "degrees_east", "longitude")):
            file.createDimension(name, size)
            axis = file.createVariable(name, "f8", (name,))
            axis.units, axis.standard_name = unit, standard
            axis[:] = first + step * (np.arange(size) + 0.5)
        field = file.createVariable("f", "f8", ("lat", "lon"))
        field[:] = smooth(file["lon"][:][np.newaxis], file["lat"][:][:, np.newaxis])


def add_field(path):
    """A field of the cells of a SCRIP file."""
    with netCDF4.Dataset(path, "a") as file:
        field = file.createVariable("f", "f8", ("grid_size",))
        field.coordinates = "grid_center_lat grid_center_lon"
        field[:] = smooth(file["grid_center_lon"][:], file["grid_center_lat"][:])


def values(path):
    with netCDF4.Dataset(path) as file:
        return np.ma.filled(file["f"][:], np.nan).ravel()


def check_integral(weights, source, target):
    """The laws of the weights, and the integral of the field."""
    with netCDF4.Dataset(weights) as file:
        area_a, area_b = file["area_a"][:], file["area_b"][:]
        sums = np.bincount(file["row"][:] - 1, file["S"][:])
        assert np.abs(sums - 1).max() < 1e-12
        assert abs(area_a.sum() - 4 * np.pi) < 1e-11 and abs(area_b.sum() - 4 * np.pi) < 1e-11
        before, after = (area_a * source).sum(), (area_b * target).sum()
        assert abs(after - before) < 1e-12 * abs(before), (before, after)
        return abs(after - before) / before


def compare(calotte, source, target, name):
    """From one grid to the other, by both programs."""
    run(calotte, "interpolate", source, target, "--fields", "f", "-o", f"{name}.nc", "--weights", f"{name}_w.nc")
    run("cdo", "-s", f"remapycon,{target}", "-selname,f", source, f"{name}_cdo.nc")
    ours, theirs = values(f"{name}.nc"), values(f"{name}_cdo.nc")
    difference = np.abs(ours - theirs).max()
    change = check_integral(f"{name}_w.nc", values(source), ours)
    assert difference < 1e-7, difference
    # CDO applies our weights, and we apply its.
    run(calotte, "interpolate", source, target, "--weights", f"{name}_s.nc", "--weights-format", "scrip")
    run("cdo", "-s", f"remap,{target},{name}_s.nc", "-selname,f", source, f"{name}_ours.nc")
    assert np.abs(values(f"{name}_ours.nc") - ours).max() < 1e-13
    run("cdo", "-s", f"genycon,{target}", "-selname,f", source, f"{name}_g.nc")
    run(calotte, "interpolate", source, target, "--fields", "f", "-o", f"{name}_theirs.nc", "--apply", f"{name}_g.nc")
    assert np.abs(values(f"{name}_theirs.nc") - theirs).max() < 1e-13
    print(f"{name}: differs from cdo remapycon by {difference:.2g}, the integral changes by {change:.1g}")


def main(calotte):
    if shutil.which("cdo") is None or netCDF4 is None:
        print("cdo or netCDF4 for Python is not installed")
        return 1 if os.environ.get("CALOTTE_CLIENTS") == "required" else SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        run(calotte, "points", "fibonacci", 4000, "-o", "points.txt")
        run(calotte, "delaunay", "points.txt", "-o", "mesh.nc")
        run(calotte, "convert", "mesh.nc", "cells.nc", "--format", "scrip")
        add_field("cells.nc")
        make_raster("raster.nc", 72, 36)
        compare(calotte, "raster.nc", "cells.nc", "to_cells")
        compare(calotte, "cells.nc", "raster.nc", "to_raster")
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
