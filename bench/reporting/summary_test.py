# SPDX-License-Identifier: GPL-3.0-or-later
"""What RESULTS.md opens with: python3 -m unittest reporting.summary_test (in bench/)."""

import unittest

from reporting.cells import NONE
from reporting.requirements import Requirement, required
from reporting.summary import summary

NAMES = ("peers", "processor", "threads", "memory", "system", "compiler", "commits", "dates")
FACTS = {name: f"some {name}" for name in NAMES}


def make_line(what, met="yes", main=True):
    threshold = NONE if met == NONE else ">= 9"
    return Requirement(what, "12.01 (11.27 - 12.72)", threshold, NONE, met, "step", main)


class Laws(unittest.TestCase):
    def test_all_that_was_compared_is_named(self):
        text = summary(FACTS, [])
        for name, fact in FACTS.items():
            self.assertIn(fact, text, name)
        self.assertIn("none was measured", text)

    def test_all_thresholds_are_met_or_the_others_are_named(self):
        lines = [make_line("fast"), make_line("faster", "yes, and the target"), make_line("a", NONE)]
        self.assertIn("all 2 are met", summary(FACTS, lines))
        lines += [make_line("slow", "**no**"), make_line("unsure", "disturbed")]
        self.assertIn(
            "2 of 4 are met. Not met: slow (**no**); unsure (disturbed)", summary(FACTS, lines)
        )

    def test_main_results_alone_are_repeated_in_at_most_twenty_lines(self):
        lines = [make_line(f"ratio {k}") for k in range(11)]
        lines += [make_line(f"model {k}", main=False) for k in range(30)]
        text = summary(FACTS, lines)
        self.assertLessEqual(len(text.splitlines()), 20)
        self.assertIn("- ratio 10: 12.01 (11.27 - 12.72)", text)
        self.assertNotIn("model", text)

    def test_the_table_has_all_of_them_without_the_mark(self):
        lines = [make_line("fast"), make_line("model", main=False)]
        rows = required(lines).splitlines()[2:]
        self.assertEqual(len(rows), 2)
        self.assertTrue(all(row.count("|") == 7 for row in rows))


if __name__ == "__main__":
    unittest.main()
