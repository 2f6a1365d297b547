# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints a benchmark program's samples as a table, for bench/run: python3 -m reporting.show FILE."""

import json
import sys
from pathlib import Path

from reporting.cells import NONE, compared, seconds_text
from reporting.distribution import Decomposition
from reporting.samples import peers_of, rows_of


def counter_column(name):
    return lambda row: f"{row.median(name):.4g}" if name in row.counters else NONE


def show(output):
    """Markdown: seconds, ratios to the library's row, and medians of all counters."""
    rows, _ = rows_of(output)
    base = next((row.name for row in rows if row.name in ("calotte", "delaunay")), None)
    columns = {name: counter_column(name) for row in rows for name in row.counters}
    if any(row.lists for row in rows):
        columns |= {
            "regions": lambda row: Decomposition.of(row).count,
            "all regions, s": lambda row: seconds_text(Decomposition.of(row).total),
            "longest / mean": lambda row: f"{Decomposition.of(row).imbalance:.2f}",
        }
    context = output["context"]
    facts = ["compiler " + context["compiler"], *peers_of(context)]
    return (
        "Medians of the rounds, with quartiles of the ratios of times of the same round; columns beyond are "
        f"counters. {'; '.join(facts)}.\n\n" + compared(rows, base, columns)
    )


if __name__ == "__main__":
    print("\n" + show(json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))), end="")
