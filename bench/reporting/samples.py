# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples of the benchmark programs, as their --json writes them, and what is said of them."""

import json
from dataclasses import dataclass
from pathlib import Path

# A row is disturbed when the quartiles of its measured ratio lie further apart than this part of
# their median; when, being serial, it had less than this part of a core; or when other programs, or
# the host of a virtual machine, took more than this part of all cores while its step ran.
WIDEST_SPREAD = 0.15
LEAST_CORE = 0.9
MOST_OTHERS = 0.05


def quantile(values, p):
    """Linear between neighbours."""
    values = sorted(values)
    place = p * (len(values) - 1)
    below = int(place)
    above = min(below + 1, len(values) - 1)
    return values[below] + (place - below) * (values[above] - values[below])


def median(values):
    return quantile(values, 0.5)


def spread(values):
    """The distance of the quartiles, in medians."""
    return (quantile(values, 0.75) - quantile(values, 0.25)) / median(values)


@dataclass(frozen=True)
class Row:
    """One row of one set of one step: a sample a round."""

    step: str
    set: str
    sites: int
    name: str
    seconds: dict  # by round
    counters: dict  # by name, a list of one value a round
    lists: dict  # by name, a list of one list a round
    others: float = 0.0  # the part of all cores that others took while the step ran

    @property
    def serial(self):
        """Whether it runs on one thread."""
        ours = self.name.startswith("calotte")
        return not ours or self.name.endswith(("1 thread", "one region"))

    @property
    def values(self):
        return list(self.seconds.values())

    def median(self, counter=None):
        """Of the seconds, or of a counter."""
        return median(self.values if counter is None else self.counters[counter])

    def by_region(self, name):
        """A list's medians over the rounds, one for each of its places."""
        return [median(values) for values in zip(*self.lists[name], strict=True)]

    def ratios(self, base):
        """Seconds over those of another row in the same rounds."""
        return [s / base.seconds[r] for r, s in self.seconds.items() if r in base.seconds]

    @property
    def starved(self):
        """Whether it had to share its core, or its machine."""
        if self.others > MOST_OTHERS:
            return True
        if not self.serial or "cpu" not in self.counters:
            return False
        shares = [c / s for c, s in zip(self.counters["cpu"], self.values, strict=True)]
        return median(shares) < LEAST_CORE


def is_disturbed(values, rows):
    """rows: those that the values are made of."""
    return spread(values) > WIDEST_SPREAD or any(row.starved for row in rows)


@dataclass(frozen=True)
class Step:
    """A program's run, as bench/report keeps it."""

    name: str
    section: str
    command: str
    commit: str
    machine: dict  # what it ran on: one line by name
    date: str
    seconds: float
    others: float  # the part of all cores that other programs took, or the host
    output: dict
    runs: int = 1  # how often it ran since the last whole report: the samples are the last run's

    @property
    def threads(self):
        """Those of the library's rows that do not say it."""
        arguments = self.output["arguments"]
        if "--threads" in arguments:
            return int(arguments[arguments.index("--threads") + 1])
        return self.output["hardware_threads"]


class BadSamples(Exception):
    """A file holds no samples, or those of an older bench/report."""


def load_step(file):
    try:
        return Step(**json.loads(file.read_text()))
    except (TypeError, ValueError):
        raise BadSamples(f"{file} holds no complete samples of this bench/report; remove it") from None


class Results:
    """All that was run: steps by name, and their rows."""

    def __init__(self, steps):
        self.steps = {step.name: step for step in steps}
        self.rows = [
            Row(
                step.name,
                group["set"],
                group["sites"],
                row["row"],
                dict(zip(row["rounds"], row["seconds"], strict=True)),
                row["counters"],
                row["lists"],
                step.others,
            )
            for step in steps
            for group in step.output["sets"]
            for row in group["rows"]
        ]

    @staticmethod
    def load(folder):
        """Of all files of a folder. Raises BadSamples."""
        return Results([load_step(file) for file in sorted(Path(folder).glob("*.json"))])

    def find(self, section, **wanted):
        """The rows of a section with these values of step, set, sites or name."""
        return [
            row
            for row in self.rows
            if self.steps[row.step].section == section
            and all(getattr(row, key) == value for key, value in wanted.items())
        ]

    def one(self, section, **wanted):
        """The only such row, the one with most rounds where several steps made it, or None."""
        return max(self.find(section, **wanted), key=lambda row: len(row.seconds), default=None)

    def failures(self):
        return [line for step in self.steps.values() for line in step.output["failures"]]
