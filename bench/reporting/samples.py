# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples of the benchmark programs, as Google Benchmark writes them, and their statistics.

A benchmark is called set/n:SITES/round:ROUND/row. Its label holds lists as JSON, such as one number
a region.
"""

import json
import re
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median, quantiles

# A row is disturbed when the quartiles of its measured ratio lie further apart than this part of
# their median; when, being serial, it had less than this part of a core; or when other programs, or
# the host of a virtual machine, took more than this part of all cores while its step ran.
WIDEST_SPREAD = 0.15
LEAST_CORE = 0.9
MOST_OTHERS = 0.05

NAME = re.compile(r"(?P<set>[^/]+)/n:(?P<sites>\d+)/round:(?P<round>\d+)/(?P<row>[^/]+)")


def quartiles(values):
    """The lower, the median and the upper one."""
    return quantiles(values, n=4, method="inclusive") if len(values) > 1 else 3 * list(values)


def spread(values):
    """The distance of the quartiles, in medians."""
    low, middle, high = quartiles(values)
    return (high - low) / middle


@dataclass(frozen=True)
class Row:
    """One row of one set of one step: a sample a round."""

    step: str
    set: str
    sites: int
    name: str
    seconds: dict = field(default_factory=dict)  # by round
    counters: dict = field(default_factory=dict)  # by name, a list of one value a round
    lists: dict = field(default_factory=dict)  # by name, a list of one list a round
    others: float = 0.0  # the part of all cores that others took while the step ran

    @property
    def serial(self):
        """Whether it runs on one thread."""
        ours = self.name.startswith("calotte")
        return not ours or self.name.endswith(("1 thread", "one region"))

    def median(self, counter=None):
        """Of the seconds, or of a counter."""
        return median(self.counters[counter] if counter else self.seconds.values())

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
        shares = zip(self.counters["cpu"], self.seconds.values(), strict=True)
        return median(cpu / seconds for cpu, seconds in shares) < LEAST_CORE

    def add(self, number, run):
        """Adds a run, as Google Benchmark reports it, of a round."""
        self.seconds[number] = run["real_time"]
        for name, values in json.loads(run.get("label") or "{}").items():
            self.lists.setdefault(name, []).append(values)
        own = list(run)[list(run).index("time_unit") + 1 :]
        for name in own:
            if name != "label":
                self.counters.setdefault(name, []).append(run[name])


def is_disturbed(values, rows):
    """rows: those that the values are made of."""
    return spread(values) > WIDEST_SPREAD or any(row.starved for row in rows)


def rows_of(output, step="", others=0.0):
    """The rows of a program's output, in the order of their first run, and a line for each failure."""
    rows, failures = {}, []
    for run in output["benchmarks"]:
        name = NAME.match(run["name"])
        if run.get("error_occurred"):
            failures.append(f"{name[0]}: {run['error_message']}")
            continue
        key = (name["set"], int(name["sites"]), name["row"])
        row = rows.setdefault(key, Row(step, *key, others=others))
        row.add(int(name["round"]), run)
    return list(rows.values()), failures


def peers_of(context):
    """The programs compared, with their versions, of the context of an output."""
    names = (name for name in context if name.startswith("peer "))
    return [f"{name.removeprefix('peer ')} {context[name]}".strip() for name in names]


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
        return int(self.machine["threads"])


class BadSamples(Exception):
    """A file holds no samples, or those of an older bench/report."""


def load_step(file):
    try:
        step = Step(**json.loads(file.read_text()))
        return step, *rows_of(step.output, step.name, step.others)
    except (AttributeError, KeyError, TypeError, ValueError):
        raise BadSamples(f"{file} holds no complete samples of this bench/report; remove it") from None


class Results:
    """All that was run: steps by name, their rows and their failures."""

    def __init__(self, steps):
        """steps: of each its rows and failures, too."""
        self.steps = {step.name: step for step, _, _ in steps}
        self.rows = [row for _, rows, _ in steps for row in rows]
        self.failures = [line for _, _, lines in steps for line in lines]

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

    def of_step(self, step):
        return [row for row in self.rows if row.step == step]

    def one(self, step, name, **wanted):
        """The only such row of a step, or None."""
        for row in self.of_step(step):
            if all(getattr(row, key) == value for key, value in (wanted | {"name": name}).items()):
                return row
        return None
