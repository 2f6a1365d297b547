# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured decompositions: python3 -m unittest reporting.distribution_test (in bench/)."""

import unittest

from reporting.distribution import Grid
from reporting.makespan import Network
from reporting.samples import Results, Step


def make_row(name, seconds):
    count = len(seconds)
    lists = {"seconds": [seconds], "received": [[24.0] * count], "owned": [[9.0] * count]}
    lists["halo"] = [[1.0] * count]
    return {"row": name, "rounds": [0], "seconds": [1.0], "counters": {}, "lists": lists}


def make_results(**rows_of_steps):
    """Steps of section fine, of these rows."""
    steps = []
    for name, rows in rows_of_steps.items():
        output = {"failures": [], "sets": [{"set": "x8", "sites": 10, "rows": rows}]}
        steps.append(Step(name, "fine", "run", "c", {}, "d", 1.0, 0.0, output))
    return Results(steps)


class Laws(unittest.TestCase):
    def test_a_decomposition_and_the_default_are_of_the_first_step_that_has_them(self):
        name = "triangulation, default regions, halo sort, default decomposition"
        first, second = [1.0, 2.0], [5.0, 5.0]
        results = make_results(a=[make_row(name, first)], b=[make_row(name, second)])
        grid = Grid(results, "triangulation", "x8", 10, Network())
        self.assertEqual(grid.default.seconds, first)
        self.assertEqual(grid.by_count[2].seconds, first)

    def test_workers_are_given_the_decomposition_that_serves_them_best(self):
        name = "iteration, {} regions, halo sort, default decomposition".format
        rows = [make_row(name(n), [8.0 / n] * n) for n in (1, 2, 8)]
        grid = Grid(make_results(a=rows), "iteration", "x8", 10, Network())
        self.assertEqual([grid.scheduled(workers)[1] for workers in (2, 8)], [2, 8])
        self.assertEqual(grid.scheduled(9), (None, None))
        self.assertIsNone(grid.one_each(3))
        self.assertGreater(grid.one_each(2), 4.0)
        self.assertFalse(Grid(make_results(a=rows), "iteration", "uniform", 10, Network()))


if __name__ == "__main__":
    unittest.main()
