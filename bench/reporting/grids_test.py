# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the tables of bench/widths: python3 -m unittest reporting.grids_test (in bench/)."""

import copy
import unittest

from reporting import grids

THEIRS = {
    "cells": 10237, "degrees": {"5": 70, "6": 10105, "7": 58, "8": 4}, "excess": 0.01, "obtuse": 3,
    "angles": {"min": 40.0, "max": 88.0}, "cell_quality": {"min": 0.3, "mean": 0.8},
    "sigma": {"mean": 0.9}, "triangle_quality": {"min": 0.9}, "dv_over_dc": {"min": 0.25},
    "dc_over_h": {"min": 0.78, "max": 1.4},
    "operators": {
        **{key: {"l2": 0.01, "max": 0.1} for key in grids.ERRORS},
        "dual_eigenvalue": 1e5, "wave_step_times_speed": 0.016,
    },
}  # fmt: skip


def better():
    """A report that is within all thresholds of THEIRS, all of which are bounds of ratios, but two."""
    info = copy.deepcopy(THEIRS)
    info["obtuse"] = 0
    for key in grids.ERRORS:
        info["operators"][key] = {"l2": 0.004, "max": 0.06}
    return info


def missed(name, change, ratio=30.0):
    """Titles of the thresholds that better() misses after a change."""
    info = better()
    change(info)
    return [bound.title for bound in grids.bounds(name, info, THEIRS, ratio) if not bound.met]


class Thresholds(unittest.TestCase):
    def test_the_same_numbers_as_jigsaw_meet_only_the_bounds_of_one(self):
        found = grids.bounds("x4", THEIRS, THEIRS, 1.0)
        self.assertEqual(
            [bound.title for bound in found if not bound.met],
            ["JIGSAW / Calotte", "obtuse", "tangential l2", "tangential max"]
            + ["divergence l2", "Laplacian l2", "kinetic energy l2"],
        )
        for bound in found[3:]:
            self.assertEqual(bound.value, 1, bound.title)

    def test_a_grid_within_all_meets_all(self):
        self.assertEqual(missed("x4", lambda info: None), [])

    def test_each_number_decides_its_threshold_alone(self):
        def error(key, norm, value):
            return lambda info: info["operators"][key].update({norm: value})

        changes = {
            "obtuse": lambda info: info.update(obtuse=1),
            "dv/dc min": lambda info: info["dv_over_dc"].update(min=0.17),
            "tangential l2": error("tangential", "l2", 0.0051),
            "tangential max": error("tangential", "max", 0.071),
            "divergence l2": error("divergence", "l2", 0.0061),
            "Laplacian l2": error("laplacian", "l2", 0.0061),
            "kinetic energy l2": error("kinetic_energy", "l2", 0.0061),
            "divergence max": error("divergence", "max", 0.101),
            "gradient max": error("gradient", "max", 0.101),
            "Laplacian max": error("laplacian", "max", 0.101),
            "kinetic energy max": error("kinetic_energy", "max", 0.101),
            "curl max": error("curl", "max", 0.101),
            "step of waves": lambda info: info["operators"].update(wave_step_times_speed=0.0159),
            "dual eigenvalue": lambda info: info["operators"].update(dual_eigenvalue=1.03e5),
            "dc/h min": lambda info: info["dc_over_h"].update(min=0.77),
            "dc/h max": lambda info: info["dc_over_h"].update(max=1.41),
            "excess": lambda info: info.update(excess=0.011),
            "defects": lambda info: info["degrees"].update({"8": 5}),
        }
        for title, change in changes.items():
            self.assertEqual(missed("x4", change), [title])
        titles = {bound.title for bound in grids.bounds("x4", THEIRS, THEIRS, 1.0)}
        self.assertEqual(titles, changes.keys() | {"JIGSAW / Calotte"})

    def test_coasts_may_take_longer(self):
        self.assertEqual(missed("x4", lambda info: None, ratio=15.0), ["JIGSAW / Calotte"])
        self.assertEqual(missed("coast", lambda info: None, ratio=15.0), [])
        self.assertEqual(missed("coast", lambda info: None, ratio=11.0), ["JIGSAW / Calotte"])

    def test_what_is_missed_is_bold(self):
        bad = better()
        bad["obtuse"] = 2
        text = grids.comparison([("x4", better(), THEIRS, (1, 30), 30.0), ("x8", bad, THEIRS, (1, 30), 30.0)])
        self.assertEqual(["**" in row for row in text.splitlines()[2:]], [False, True])
        self.assertIn("| x8 | 10 237 | 1 | 30 | 30.00 | **2** | 0.25 |", text)


class Tables(unittest.TestCase):
    def test_rows_have_as_many_columns_as_their_heads(self):
        def columns(text):
            return {row.count(" | ") for row in text.splitlines() if row.startswith("|")}

        for text in (
            grids.shapes_head() + "\n" + grids.shapes_row("x4", "JIGSAW", 2.0, None, THEIRS, ""),
            grids.comparison([("x4", better(), THEIRS, (1.0, 30.0), 30.0)]),
        ):
            self.assertEqual(len(columns(text)), 1, text)


class Remarks(unittest.TestCase):
    def test_a_run_within_all_limits_has_none(self):
        printed = "x8.vtp: 46497 cells, well-centred, 146 iterations, l2-scaled 8.3e-05, 0.71 s"
        self.assertEqual(grids.remark(0, printed), "")

    def test_faults_are_named_with_their_size(self):
        printed = (
            "x.vtp: 642 cells, not converged, 200 iterations, 12 generators more than 0.01 of the "
            "spacing from their centroids (at most 0.04), 0.10 s\ncalotte: not well-centred: 3 of 642 "
            "cells with shapes beyond their limits, the worst, 0.11 beyond, at cell 12\n"
        )
        self.assertEqual(
            grids.remark(1, printed),
            "not converged; a shape 0.11 beyond its limit; 12 generators displaced",
        )


if __name__ == "__main__":
    unittest.main()
