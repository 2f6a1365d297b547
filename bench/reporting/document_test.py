# SPDX-License-Identifier: GPL-3.0-or-later
"""The text of RESULTS.md: python3 -m unittest reporting.document_test (in bench/)."""

import unittest

from reporting.cells import NONE
from reporting.document import compose
from reporting.requirements import Requirement, requirements, verdicts
from reporting.samples import Results, Step, rows_of

MACHINE = {name: f"some {name}" for name in ("processor", "memory", "system")} | {"threads": "2"}


def make_results(name, section, rows, set_name="random"):
    """A step of 163 842 sites; rows: seconds of three rounds by name."""
    runs = [
        {"name": f"{set_name}/n:163842/round:{k}/{row}/x", "real_time": s, "time_unit": "s", "cpu": s}
        for row, seconds in rows.items()
        for k, s in enumerate(seconds)
    ]
    output = {"context": {"compiler": "1.2", "peer CGAL": "5.5"}, "benchmarks": runs}
    step = Step(name, section, "bench/run this", "abc", MACHINE, "2026-11-27 10:00", 9.0, 0.0, output)
    return Results([(step, *rows_of(output, name))])


def make_line(what, met="yes"):
    return Requirement(what, "1.0", NONE if met == NONE else ">= 9", NONE, met, "step")


class Laws(unittest.TestCase):
    def test_all_thresholds_are_met_or_the_others_are_named(self):
        self.assertIn("none was measured", verdicts([make_line("a", NONE)]))
        lines = [make_line("fast"), make_line("faster", "yes, and the target"), make_line("a", NONE)]
        self.assertIn("all 2 are met", verdicts(lines))
        lines += [make_line("slow", "**no**"), make_line("unsure", "disturbed")]
        self.assertIn("2 of 4 are met. Not met: slow (**no**); unsure (disturbed)", verdicts(lines))

    def test_ratios_and_efficiencies_are_judged(self):
        rows = {"calotte": [1.0] * 3, "calotte 1 thread": [1.9] * 3, "CGAL": [2.0] * 3}
        found = requirements(make_results("triangulation-medium", "triangulation", rows))
        self.assertEqual([(line.measured, line.met) for line in found],
                         [("2.00 (2.00 - 2.00)", "**no**"), ("0.950 (0.950 - 0.950)", "yes")])

    def test_what_has_no_threshold_is_not_judged(self):
        rows = {"delaunay": [1.0] * 3, "write": [3.0] * 3}
        results = make_results("others-files", "others", rows, "bisection")
        self.assertEqual([(line.measured, line.met) for line in requirements(results)],
                         [("3.00 (3.00 - 3.00)", NONE)])

    def test_the_text_has_what_was_measured_and_no_more(self):
        rows = {"calotte": [1.0] * 3, "CGAL": [2.0, 2.0, 9.0]}
        text = compose(make_results("triangulation-medium", "triangulation", rows))
        for part in (
            "CGAL 5.5", *MACHINE.values(), "g++ 1.2", "abc", "`bench/run this`", "## Other measurements",
            "| random, 163 842 | calotte | 3 | 1.000 | 1 | - | triangulation-medium |",
            "| random, 163 842 | CGAL | 3 | 2.000 | disturbed: 2.00 (2.00 - 5.50) |",
        ):  # fmt: skip
            self.assertIn(part, text)
        self.assertNotIn("Table 3", text)


if __name__ == "__main__":
    unittest.main()
