# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a request of tests/grids/recipes_test.py with the Python package.

    recipe_caller.py REQUEST OUTPUT

The output holds the cells' generators, 3 doubles each, in a plane with z = 0. The numbers are those of
tests/grids/requests.h: whole or made by + - * / and %, so that all callers have the same bits.
"""
import sys

import numpy as np

import calotte
from calotte import widths


def density(points):
    """Widths at the equator are half of those at the poles."""
    z = points[:, 2]
    root = 1 + 15 * (z * z)
    return 16 / (root * root)


def start():
    """100 directions, not on the unit sphere."""
    i = np.arange(100)[:, np.newaxis]
    modulus = np.array([101, 103, 107])
    return ((i * [37, 59, 71] + [11, 5, 17]) % modulus - modulus // 2) / 8


REGION = [(-115, 25), (-95, 25), (-85, 35), (-85, 45), (-95, 55), (-115, 55), (-125, 45), (-125, 35)]
SMALL = [(-110, 33), (-100, 33), (-95, 38), (-95, 42), (-100, 47), (-110, 47), (-115, 42), (-115, 38)]
WIDTHS = ([[1200, 1000, 1100, 1300], [900, 800, 1000, 1200], [1100, 900, 1000, 1400]],
          [0, 90, 180, 270], [-60, 0, 60])  # km; longitudes; latitudes
FIXED = [(1, 0, 0), (0, 1, 0), (0, 0.6, 0.8)]
BOX = calotte.periodic_box(2, 1)

REQUESTS = {
    "uniform": {"cells": 642},
    "x8": {"cells": 2562, "density": density},
    "widths": {"cell_width": WIDTHS},
    "rules": {"cell_width": widths.minimum(
        widths.by_latitude([(-90, 900), (0, 700), (90, 900)]),
        widths.by_distance([(10, -20), (40, 30)], near=300, far=900, over=4000)).limit_gradient(0.1)},
    "region": {"cells": 500, "surface": calotte.polygon(REGION)},
    "limited-area": {"cell_width": 200, "surface": calotte.polygon(SMALL), "limited_area": True},
    "plane": {"cells": 300, "surface": calotte.rectangle((0, 0), (2, 1))},
    "box": {"cells": 400, "surface": BOX},
    "walls": {"cells": 300, "surface": BOX, "walls": "y"},
    "fixed": {"cells": 500, "fixed": FIXED},
    "points": {"points": start()},
    "pure": {"cells": 642, "density": density, "well_centred": False, "tolerance": 1e-3},
    "well-centred": {"cells": 642, "well_centred": True},
    "lloyd": {"cells": 642, "density": density, "method": "lloyd", "iterations": 20},
}


def generators(request):
    points = calotte.cvt(**REQUESTS[request]).mesh.points
    if points.shape[1] == 3:
        return points
    return np.concatenate([points, np.zeros((len(points), 1))], axis=1)


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in REQUESTS:
        sys.exit(f"recipe_caller.py REQUEST OUTPUT; the requests are: {', '.join(REQUESTS)}")
    np.ascontiguousarray(generators(sys.argv[1])).tofile(sys.argv[2])
