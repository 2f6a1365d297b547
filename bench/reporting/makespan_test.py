# SPDX-License-Identifier: GPL-3.0-or-later
"""The laws of the model: python3 -m unittest reporting.makespan_test (in bench/)."""

import itertools
import random
import unittest

from reporting.makespan import Network, imbalance, list_schedule, makespan

FREE = Network(latency=0, bandwidth=float("inf"), reductions=0)


def random_regions(seed):
    """Seconds and bytes of 1 to 60 regions, of times from 1 to 1000."""
    engine = random.Random(seed)
    count = engine.randint(1, 60)
    seconds = [10 ** engine.uniform(-6, -3) for _ in range(count)]
    sent = [engine.randint(0, 100000) for _ in range(count)]
    return seconds, sent


def least_load(costs, workers):
    """By trying all."""
    best = float("inf")
    for owners in itertools.product(range(workers), repeat=len(costs)):
        loads = [0.0] * workers
        for owner, cost in zip(owners, costs):
            loads[owner] += cost
        best = min(best, max(loads))
    return best


class Laws(unittest.TestCase):
    def test_one_worker_takes_the_sum_and_exchanges_nothing(self):
        for seed in range(100):
            seconds, sent = random_regions(seed)
            self.assertAlmostEqual(makespan(seconds, sent, 1), sum(seconds), places=12)

    def test_never_below_the_mean_or_the_longest(self):
        for seed in range(100):
            seconds, sent = random_regions(seed)
            for workers in (1, 2, 3, 7, 64, 1000):
                took = makespan(seconds, sent, workers)
                self.assertGreaterEqual(took * (1 + 1e-12), sum(seconds) / workers)
                self.assertGreaterEqual(took, max(seconds))

    def test_a_worker_each_takes_the_longest_and_more_workers_change_nothing(self):
        for seed in range(100):
            seconds, sent = random_regions(seed)
            for workers in (len(seconds), len(seconds) + 1, 5000):
                self.assertEqual(makespan(seconds, sent, workers, FREE), max(seconds))

    def test_no_more_than_a_third_above_the_best(self):
        for seed in range(40):
            engine = random.Random(seed)
            costs = [engine.randint(1, 20) for _ in range(engine.randint(1, 8))]
            best = least_load(costs, 3)
            took = list_schedule(costs, 3)
            self.assertGreaterEqual(took, best)
            self.assertLessEqual(took, (4 / 3 - 1 / 9) * best)

    def test_equal_regions_are_dealt_out_evenly(self):
        for regions, workers in ((12, 4), (12, 5), (7, 7), (1, 3)):
            took = makespan([2.0] * regions, [0] * regions, workers, FREE)
            self.assertAlmostEqual(took, 2.0 * -(-regions // workers))

    def test_the_network_costs_what_it_says(self):
        seconds, sent = [1.0, 1.0], [3e9, 1e9]
        network = Network(latency=0.25, bandwidth=1e9, reductions=2)
        self.assertAlmostEqual(makespan(seconds, sent, 2, network), 1 + 3 + 0.25 * (1 + 2 * 1))
        self.assertAlmostEqual(makespan(seconds, sent, 5, network), 1 + 3 + 0.25 * (1 + 2 * 3))

    def test_order_of_regions_does_not_matter(self):
        for seed in range(50):
            seconds, sent = random_regions(seed)
            pairs = list(zip(seconds, sent))
            random.Random(seed).shuffle(pairs)
            shuffled = [list(part) for part in zip(*pairs)]
            self.assertAlmostEqual(makespan(seconds, sent, 6), makespan(*shuffled, 6), places=15)

    def test_nonsense_is_refused(self):
        for seconds, sent, workers in (([], [], 1), ([1.0], [0], 0), ([1.0], [], 2)):
            with self.assertRaises(ValueError):
                makespan(seconds, sent, workers)

    def test_imbalance_is_the_longest_over_the_mean(self):
        self.assertEqual(imbalance([3.0, 3.0, 3.0]), 1)
        self.assertEqual(imbalance([1.0, 3.0]), 1.5)


if __name__ == "__main__":
    unittest.main()
