# SPDX-License-Identifier: GPL-3.0-or-later
"""What a distributed run would take, from the measured seconds and bytes of each region.

The model: a worker computes its regions one after another, and exchanges positions with others once
an iteration. All of its messages are under way together, so they cost one latency and their bytes
over the bandwidth; bytes between two regions of one worker are counted, too, which is more than it
would send. A sum over all workers, such as the norm that ends a run, goes up a binary tree.
"""

import heapq
import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Network:
    latency: float = 2e-6  # seconds
    bandwidth: float = 10e9  # bytes a second, in each direction
    reductions: int = 1  # sums over all workers in an iteration

    def waiting(self, workers):
        """The seconds that no work fills."""
        if workers == 1:
            return 0.0
        return self.latency * (1 + self.reductions * math.ceil(math.log2(workers)))

    def costs(self, seconds, sent, workers):
        """The seconds of each region's work and messages."""
        if workers == 1:
            return list(seconds)
        return [s + b / self.bandwidth for s, b in zip(seconds, sent, strict=True)]


def list_schedule(costs, workers):
    """The load of the fullest of some workers: longest first, each to the one that is free first
    (Graham, SIAM J. Appl. Math. 17, 1969: at most 4/3 of the best)."""
    loads = [0.0] * min(workers, len(costs))
    for cost in sorted(costs, reverse=True):
        heapq.heapreplace(loads, loads[0] + cost)
    return max(loads)


def makespan(seconds, sent, workers, network=Network()):
    """Seconds of an iteration on some workers, which may have several regions each.

    seconds, sent: of each region, its work and the bytes that it exchanges.
    """
    if workers < 1 or not seconds:
        raise ValueError("a makespan needs a worker and a region")
    return list_schedule(network.costs(seconds, sent, workers), workers) + network.waiting(workers)


def imbalance(loads):
    """The longest over the mean."""
    return max(loads) * len(loads) / sum(loads)
