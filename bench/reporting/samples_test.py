# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the statistics of samples: python3 -m unittest reporting.samples_test (in bench/)."""

import random
import tempfile
import unittest
from pathlib import Path

from reporting.samples import BadSamples, Results, Row, Step, is_disturbed, median, quantile, spread


def make_row(name, seconds, cpu=None, lists=None, others=0.0):
    counters = {"cpu": cpu} if cpu else {}
    return Row("step", "random", 10, name, seconds, counters, lists or {}, others)


class Laws(unittest.TestCase):
    def test_quantiles_are_between_the_least_and_the_greatest_and_ascend(self):
        for seed in range(50):
            engine = random.Random(seed)
            values = [engine.random() for _ in range(engine.randint(1, 20))]
            found = [quantile(values, p / 10) for p in range(11)]
            self.assertEqual(found, sorted(found))
            self.assertEqual((found[0], found[-1]), (min(values), max(values)))

    def test_a_median_has_as_many_on_either_side(self):
        self.assertEqual(median([5, 1, 3]), 3)
        self.assertEqual(median([4, 1, 3, 2]), 2.5)

    def test_a_spread_knows_no_unit(self):
        values = [random.Random(1).random() + 1 for _ in range(9)]
        self.assertAlmostEqual(spread(values), spread([1000 * v for v in values]))
        self.assertEqual(spread([2, 2, 2]), 0)

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

    def test_regions_have_their_own_medians(self):
        row = make_row("a", {0: 1.0}, lists={"seconds": [[1, 20], [3, 10], [2, 30]]})
        self.assertEqual(row.by_region("seconds"), [2, 20])

    def test_rows_are_found_by_what_they_are(self):
        output = {
            "failures": [],
            "sets": [
                {
                    "set": "random",
                    "sites": 10,
                    "rows": [
                        {"row": name, "rounds": [0], "seconds": [1.0], "counters": {}, "lists": {}}
                        for name in ("calotte", "CGAL")
                    ],
                }
            ],
        }
        results = Results([Step("s", "sizes", "run", "c", {}, "d", 1.0, 0.3, output)])
        self.assertEqual(results.one("sizes", name="CGAL").name, "CGAL")
        self.assertTrue(results.one("sizes", name="CGAL").starved)
        self.assertIsNone(results.one("sizes", name="CGAL", sites=11))
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
