# SPDX-License-Identifier: GPL-3.0-or-later
"""What bench/report runs: python3 -m unittest reporting.plan_test (in bench/)."""

import unittest

from reporting import plan


class Laws(unittest.TestCase):
    def test_the_steps_of_all_sections_are_those_of_each(self):
        for quick in (False, True):
            for threads in (1, 2, 64):
                one_by_one = [
                    step
                    for section in plan.SECTIONS
                    for step in plan.steps(threads, quick, (section,))
                ]
                self.assertEqual(plan.steps(threads, quick, plan.SECTIONS), one_by_one)
                self.assertEqual(len({step.name for step in one_by_one}), len(one_by_one))

    def test_named_steps_are_those_of_the_whole_in_its_order(self):
        every = plan.steps(2, False, plan.SECTIONS)
        for k in range(1, len(every)):
            for few in ([every[k]], every[: k + 1 : 2]):
                names = [step.name for step in reversed(few)]
                self.assertEqual(plan.steps(2, False, plan.SECTIONS, names), few)

    def test_unknown_names_are_refused_by_name(self):
        with self.assertRaisesRegex(LookupError, "no step nowhere"):
            plan.steps(2, False, plan.SECTIONS, ("nowhere",))
        with self.assertRaisesRegex(LookupError, "no section nowhere"):
            plan.steps(2, False, ("nowhere",))
        with self.assertRaisesRegex(LookupError, "no step sizes-iteration-2562"):  # of another section
            plan.steps(2, False, ("large",), ("sizes-iteration-2562",))


if __name__ == "__main__":
    unittest.main()
