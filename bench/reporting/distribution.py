# SPDX-License-Identifier: GPL-3.0-or-later
"""Measured decompositions of one grid, and what they would take on some workers."""

from dataclasses import dataclass

from reporting.makespan import imbalance, makespan
from reporting.samples import Row, is_disturbed

WORKERS = (1, 2, 4, 8, 16, 32, 64, 96, 128, 192, 256, 384, 512, 1024)


@dataclass(frozen=True)
class Decomposition:
    """Regions one by one."""

    row: Row
    seconds: list
    sent: list  # bytes, or those received where these are more
    owned: list
    halo: list

    @staticmethod
    def of(row):
        exchanged = zip(row.by_region("sent"), row.by_region("received"), strict=True)
        bytes_each = list(map(max, exchanged))
        return Decomposition(
            row, row.by_region("seconds"), bytes_each, row.by_region("owned"), row.by_region("halo")
        )

    @property
    def count(self):
        return len(self.seconds)

    @property
    def total(self):
        return sum(self.seconds)

    @property
    def points(self):
        """Owned sites and halo sites, by region."""
        return [owned + halo for owned, halo in zip(self.owned, self.halo, strict=True)]

    @property
    def imbalance(self):
        return imbalance(self.seconds)

    @property
    def disturbed(self):
        return is_disturbed([sum(seconds) for seconds in self.row.lists["seconds"]], [self.row])


class Grid:
    """All decompositions by the library's own centres and sort of one set of sites, of an iteration."""

    def __init__(self, results, set_name, sites, network):
        rows = results.find("distribution", set=set_name, sites=sites)
        found = [Decomposition.of(row) for row in rows]
        self.by_count = {decomposition.count: decomposition for decomposition in found}
        self.network = network

    def __bool__(self):
        return bool(self.by_count)

    @property
    def serial(self):
        """Seconds of the best serial run: of the decomposition with the least sum."""
        return min(found.total for found in self.by_count.values())

    def one_each(self, workers):
        """Seconds with exactly a region a worker; None where that was not measured."""
        found = self.by_count.get(workers)
        return found and makespan(found.seconds, found.sent, workers, self.network)

    def scheduled(self, workers):
        """Least seconds of list scheduling, and the number of regions that it takes."""
        times = [
            (makespan(found.seconds, found.sent, workers, self.network), count)
            for count, found in self.by_count.items()
            if count >= workers
        ]
        return min(times, default=(None, None))
