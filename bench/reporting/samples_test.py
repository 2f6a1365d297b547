# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the statistics of samples: python3 -m unittest reporting.samples_test (in bench/)."""

import json
import random
import tempfile
import unittest
from pathlib import Path

from reporting.samples import BadSamples, Results, Row, Step, is_disturbed, rows_of, spread


def make_row(name, seconds, cpu=None, others=0.0):
    return Row("step", "random", 10, name, seconds, {"cpu": cpu} if cpu else {}, others=others)


def make_run(row, number, seconds, **more):
    """As Google Benchmark writes it."""
    name = f"random/n:10/round:{number}/{row}/iterations:1/manual_time"
    return {"name": name, "iterations": 1, "real_time": seconds, "time_unit": "s", **more}


class Laws(unittest.TestCase):
    def test_a_spread_knows_no_unit(self):
        values = [random.Random(seed).random() + 1 for seed in range(9)]
        self.assertAlmostEqual(spread(values), spread([1000 * v for v in values]))
        self.assertEqual(spread([2, 2, 2]), 0)
        self.assertEqual(spread([2]), 0)

    def test_ratios_are_of_the_same_round(self):
        row, base = make_row("a", {0: 2.0, 1: 9.0, 3: 8.0}), make_row("b", {0: 1.0, 3: 2.0, 2: 5.0})
        self.assertEqual(row.ratios(base), [2.0, 4.0])

    def test_a_wide_spread_is_a_disturbance_and_a_single_outlier_is_not(self):
        self.assertFalse(is_disturbed([1, 1.01, 1.02, 1.01, 9], []))
        self.assertTrue(is_disturbed([1, 1.3, 1.6, 1.1, 1.2], []))

    def test_a_serial_row_without_its_core_is_disturbed(self):
        seconds = {0: 1.0, 1: 1.0}
        self.assertFalse(is_disturbed([1, 1], [make_row("CGAL", seconds, [0.99, 1.0])]))
        self.assertTrue(is_disturbed([1, 1], [make_row("CGAL", seconds, [0.8, 0.7])]))
        self.assertTrue(is_disturbed([1, 1], [make_row("calotte 1 thread", seconds, [0.8, 0.7])]))
        self.assertFalse(is_disturbed([1, 1], [make_row("calotte", seconds, [0.8, 0.7])]))

    def test_a_step_beside_other_programs_is_disturbed(self):
        for others, disturbed in ((0.0, False), (0.04, False), (0.3, True)):
            row = make_row("calotte", {0: 1.0}, others=others)
            self.assertEqual(is_disturbed([1, 1], [row]), disturbed)


class Samples(unittest.TestCase):
    def test_rows_are_made_of_rounds_counters_and_lists(self):
        runs = [
            make_run("a", number, seconds, cpu=0.5, label=json.dumps({"seconds": values}))
            for number, seconds, values in ((0, 2.0, [1, 20]), (1, 3.0, [3, 10]), (2, 4.0, [2, 30]))
        ]
        (row,), failures = rows_of({"benchmarks": runs})
        self.assertEqual((row.set, row.sites, row.name), ("random", 10, "a"))
        self.assertEqual(row.seconds, {0: 2.0, 1: 3.0, 2: 4.0})
        self.assertEqual(row.counters, {"cpu": [0.5] * 3})
        self.assertEqual(row.by_region("seconds"), [2, 20])
        self.assertEqual((row.median(), row.median("cpu"), failures), (3.0, 0.5, []))

    def test_a_wrong_result_is_a_failure_and_no_row(self):
        run = make_run("CGAL", 1, 0.0, error_occurred=True, error_message="other triangles")
        rows, failures = rows_of({"benchmarks": [run, make_run("calotte", 1, 1.0)]})
        self.assertEqual([row.name for row in rows], ["calotte"])
        self.assertEqual(failures, ["random/n:10/round:1/CGAL: other triangles"])

    def test_rows_are_found_by_what_they_are(self):
        output = {"benchmarks": [make_run(name, 0, 1.0) for name in ("calotte", "CGAL")]}
        step = Step("s", "sizes", "run", "c", {}, "d", 1.0, 0.3, output)
        results = Results([(step, *rows_of(output, step.name, step.others))])
        self.assertEqual(results.one("s", "CGAL").name, "CGAL")
        self.assertTrue(results.one("s", "CGAL", set="random").starved)
        self.assertIsNone(results.one("s", "CGAL", sites=11))
        self.assertEqual(len(results.find("sizes", set="random")), 2)
        self.assertEqual(results.find("others"), [])

    def test_a_file_that_holds_no_samples_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(Results.load(folder).steps, {})
            for text in ('{"name": "s", "section"', "{}", "[1]"):
                Path(folder, "cut.json").write_text(text)
                with self.assertRaisesRegex(BadSamples, "cut.json"):
                    Results.load(folder)


if __name__ == "__main__":
    unittest.main()
