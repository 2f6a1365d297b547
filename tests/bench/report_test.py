# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/report makes tables of samples: python3 report_test.py bench/report"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REPORT = sys.argv.pop()


def make_run(name, seconds, **more):
    """As Google Benchmark writes it."""
    return {"name": f"{name}/iterations:1/manual_time", "real_time": seconds, "time_unit": "s", **more}


def tables(program, runs):
    """The exit code, the lines of the tables, and what is printed of errors."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "medium.json")
        context = {"executable": f"build/{program}_bench", "compiler": "12", "peer CGAL": "5.5"}
        file.write_text(json.dumps({"context": context, "benchmarks": runs}), encoding="utf-8")
        done = subprocess.run([sys.executable, "-B", REPORT, file], capture_output=True, text=True, check=False)
    return done.returncode, [line for line in done.stdout.splitlines() if line.startswith("| ")][2:], done.stderr


class Tables(unittest.TestCase):
    def test_ratios_are_of_the_same_round_and_starved_rows_are_disturbed(self):
        name = "random/n:163842/round:{}/{}".format
        runs = [make_run(name(k, "calotte"), s, cpu=2 * s) for k, s in ((0, 1.0), (1, 2.0), (2, 4.0))]
        runs += [make_run(name(k, "CGAL"), s, cpu=s) for k, s in ((2, 12.0), (0, 3.0), (1, 6.0))]
        runs += [make_run(name(k, "STRIPACK"), s, cpu=s / 2) for k, s in ((0, 8.0), (1, 16.0), (2, 32.0))]
        self.assertEqual(tables("delaunay", runs), (0, [
            "| random, 163 842 | calotte | 3 | 2.000 | 1 | - | medium |",
            "| random, 163 842 | CGAL | 3 | 6.000 | 3.00 (3.00 - 3.00) | - | medium |",
            "| random, 163 842 | STRIPACK | 3 | 16.00 | disturbed: 8.00 (8.00 - 8.00) | 12.3 | medium |",
        ], ""))  # fmt: skip

    def test_a_wrong_result_is_an_error_and_in_no_table(self):
        runs = [make_run("random/n:10/round:0/calotte", 1.0),
                make_run("random/n:10/round:0/CGAL", 0.0, error_occurred=True, error_message="other triangles")]  # fmt: skip
        code, lines, errors = tables("delaunay", runs)
        self.assertEqual((code, len(lines)), (1, 1))
        self.assertIn("random/n:10/round:0/CGAL: other triangles", errors)

    def test_regions_count_with_their_medians(self):
        name = "x8/n:10/round:{}/triangulation, 2 regions, halo sort, uniform decomposition".format
        lists = [{"owned": [4, 6], "halo": [2, 3], "seconds": s} for s in ([1, 5], [2, 4], [4, 2])]
        runs = [make_run(name(k), 6.0, label=json.dumps(found)) for k, found in enumerate(lists)]
        self.assertEqual(tables("distribution", runs)[1], [
            "| x8, 10 | uniform | 2 | halo | 1.50 | 6 | 8 | 9 | 1.20 | 6.000 | 4.000 | 1.33 | medium |"
        ])  # fmt: skip


if __name__ == "__main__":
    unittest.main()
