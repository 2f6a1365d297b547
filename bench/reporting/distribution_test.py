# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured decompositions: python3 -m unittest reporting.distribution_test (in bench/)."""

import json
import unittest

from reporting.distribution import Decomposition, Grid
from reporting.makespan import Network
from reporting.samples import Results, Step, rows_of


def make_row(name, seconds):
    count = len(seconds)
    lists = {"seconds": seconds, "received": [24.0] * count, "sent": [48.0] * count}
    lists |= {"owned": [9.0] * count, "halo": [1.0] * count}
    return {"name": f"x8/n:10/round:0/{name}/iterations:1/manual_time", "real_time": 1.0,
            "time_unit": "s", "label": json.dumps(lists)}  # fmt: skip


def make_results(**rows_of_steps):
    """Steps of section distribution, of these rows."""
    steps = []
    for name, rows in rows_of_steps.items():
        output = {"benchmarks": rows}
        step = Step(name, "distribution", "run", "c", {}, "d", 1.0, 0.0, output)
        steps.append((step, *rows_of(output, name)))
    return Results(steps)


class Laws(unittest.TestCase):
    def test_workers_are_given_the_decomposition_that_serves_them_best(self):
        name = "iteration, {} regions, halo sort, default decomposition".format
        rows = [make_row(name(n), [8.0 / n] * n) for n in (1, 2, 8)]
        grid = Grid(make_results(a=rows), "x8", 10, Network())
        self.assertEqual([grid.scheduled(workers)[1] for workers in (2, 8)], [2, 8])
        self.assertEqual(grid.scheduled(9), (None, None))
        self.assertIsNone(grid.one_each(3))
        self.assertGreater(grid.one_each(2), 4.0)
        self.assertFalse(Grid(make_results(a=rows), "uniform", 10, Network()))


    def test_the_larger_of_bytes_sent_and_received_counts(self):
        (row,) = make_results(a=[make_row("iteration, 2 regions", [1.0, 2.0])]).rows
        found = Decomposition.of(row)
        self.assertEqual((found.sent, found.points, found.total), ([48.0] * 2, [10.0] * 2, 3.0))


if __name__ == "__main__":
    unittest.main()
