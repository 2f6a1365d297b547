#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges grids of the command by what a shallow-water model computes on them.

    shallow_water_test.py CALOTTE

CALOTTE is the path of the command. Exit code 77, which skips the test, where netCDF4 for Python is not
installed, unless the environment variable CALOTTE_CLIENTS is "required".
"""

import os
import subprocess
import sys
import tempfile

SKIPPED = 77
AXIS = (1.0, 1.0, 1.0)  # of the flow: not that of longitudes
X4 = ["--density", "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x4"]

# 1.3 times what pure CVTs gave when this test was written; twice what they gave for "tangential max", a value of
# one edge. 2 562 cells have 12 defects, from the icosahedron; 2 561 have no such start, and the
# default ends with a finish.
GRIDS = {
    "icosahedral": (["--cells", "2562"],
                    {"h l2": 2.9e-4, "h max": 7.9e-4, "vorticity l2": 0.070, "tangential max": 0.015}),
    "uniform": (["--cells", "2561", "--start", "multilevel"],
                {"h l2": 3.7e-4, "h max": 1.95e-3, "vorticity l2": 0.105, "tangential max": 0.034}),
    "x4": (["--cells", "2561", *X4],
           {"h l2": 1.09e-3, "h max": 4.9e-3, "vorticity l2": 0.24, "tangential max": 0.070}),
}
# A finish may cost this much. One that bent every cell at a dislocation cost 2.1, 2.8, 1.05 and 7.6.
OVER_PURE = {"h l2": 1.1, "h max": 1.3, "vorticity l2": 1.1, "tangential max": 1.5}

try:
    import shallow_water
except ImportError:
    shallow_water = None


def check(truth, message):
    if not truth:
        sys.exit(f"FAILED: {message}")


def errors_of(calotte, name, options):
    """The errors of a day on the grid that the command makes with the options."""
    path = f"{name}.nc"
    result = subprocess.run([calotte, "cvt", *options, "-o", path], capture_output=True, text=True, check=False)
    check(result.returncode == 0, f"{name}: {result.stderr}")
    errors = shallow_water.steady_flow(shallow_water.Grid(path), AXIS)
    print(f"{name}:", ", ".join(f"{key} {value:.3g}" for key, value in errors.items()))
    check(abs(errors["mass"]) < 1e-13, f"{name}: the mass changes by {errors['mass']}")
    check(abs(errors["energy"]) < 1e-12, f"{name}: the tendencies change the energy by {errors['energy']}")
    return errors


def require_below(name, errors, bounds):
    for key, bound in bounds.items():
        check(errors[key] <= bound, f"{name}: {key} is {errors[key]:.3g}, above {bound:.3g}")


def main():
    calotte = os.path.abspath(sys.argv[1])
    if shallow_water is None:
        print("netCDF4 for Python is not installed: tools/setup --clients")
        sys.exit(1 if os.environ.get("CALOTTE_CLIENTS") == "required" else SKIPPED)
    with tempfile.TemporaryDirectory(prefix="calotte-shallow-water-") as folder:
        os.chdir(folder)
        for name, (options, bounds) in GRIDS.items():
            errors = errors_of(calotte, name, options)
            require_below(name, errors, bounds)
            pure = errors_of(calotte, f"{name}, pure CVT", [*options, "--stop", "tolerance"])
            require_below(name, errors, {key: ratio * pure[key] for key, ratio in OVER_PURE.items()})
        os.chdir("/")


if __name__ == "__main__":
    main()
