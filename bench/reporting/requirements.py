# SPDX-License-Identifier: GPL-3.0-or-later
"""The thresholds for the library, with the measured values."""

from statistics import median
from typing import NamedTuple

from reporting.cells import NONE, sites_text, table, values_cell
from reporting.plan import FINE, MEDIUM, SIDE_BY_SIDE
from reporting.samples import is_disturbed

EFFICIENCY = 0.92  # of two threads, or more

RATIOS = (  # peer, step, set, sites, threshold, target
    ("STRIPACK", "triangulation-medium", "random", MEDIUM, 12.33, 14),
    ("CGAL", "triangulation-medium", "random", MEDIUM, 3, 3.5),
    ("STRIPACK", "large-stripack", "random", FINE, 40, 60),
    ("CGAL", "large-cgal", "random", FINE, 3, 3.5),
    ("STRIPACK", "fresh-medium", "random", MEDIUM, 11, 14),
    ("CGAL", "fresh-medium", "random", MEDIUM, 2.5, 3.3),
    ("STRIPACK", "fresh-stripack", "random", FINE, 40, 60),
    ("CGAL", "fresh-fine", "random", FINE, 2.5, 3.3),
    ("STRIPACK", f"iteration-{MEDIUM}", "uniform", MEDIUM, 60, None),
    ("STRIPACK", f"iteration-{MEDIUM}", "x8", MEDIUM, 15, None),
)
PARALLEL = (  # step, set, sites
    ("triangulation-medium", "random", MEDIUM),
    ("large-cgal", "random", FINE),
    *((f"iteration-{n}", name, n) for n in (MEDIUM, FINE) for name in ("uniform", "x8")),
)


UNJUDGED = (  # step, set, row, base, quantity
    ("others-plane", "uniform", "CGAL", "calotte", "triangulation of the plane, CGAL's time / Calotte's"),
    ("others-files", "bisection", "write", "delaunay", "complete MPAS file, time / triangulation's"),
)


class Requirement(NamedTuple):
    """A line of the table of thresholds."""

    what: str
    measured: str
    threshold: str
    target: str
    met: str
    step: str


def verdict(value, threshold, target, disturbed):
    if disturbed:
        return "disturbed"
    if value < threshold:
        return "**no**"
    if target is None:
        return "yes"
    return "yes, and the target" if value >= target else "yes, but not the target"


def judged(what, values, rows, threshold, target=None, digits=2):
    """rows: those that the values are made of."""
    met = verdict(median(values), threshold, target, is_disturbed(values, rows))
    return Requirement(what, values_cell(values, rows, digits), f">= {threshold}",
                       target or NONE, met, rows[0].step)  # fmt: skip


def speed(results):
    lines = []
    for peer, step, name, sites, threshold, target in RATIOS:
        row, ours = (results.one(step, run, set=name) for run in (peer, "calotte"))
        if not row or not ours:
            continue
        if step.startswith("iteration"):
            what = f"iteration, {name}, {sites_text(sites)} cells, STRIPACK-based time / Calotte's"
        else:
            process = ", in a new process" if step.startswith("fresh") else ""
            what = f"triangulation, {sites_text(sites)} random sites{process}, {peer}'s time / Calotte's"
        lines.append(judged(what, row.ratios(ours), (row, ours), threshold, target))
    return lines


def unjudged(results):
    lines = []
    for step, name, run, other, what in UNJUDGED:
        row, base = (results.one(step, found, set=name) for found in (run, other))
        if row and base:
            measured = values_cell(row.ratios(base), (row, base))
            what = what.replace(",", f", {sites_text(row.sites)} {name} sites,")
            lines.append(Requirement(what, measured, NONE, NONE, NONE, step))
    return lines


def side_by_side(ours, alone, apart, threads):
    """The efficiency of independent runs, and the library's relative to it. It shows what the machine
    allows; it is no bound, because independent runs use more memory."""
    relative = [ratio / threads for ratio in apart.ratios(ours)]
    return [
        Requirement(what, values_cell(values, (apart, row), 3), NONE, NONE, NONE, ours.step)
        for what, values, row in (
            (f"- {threads} independent runs at the same time, 1 thread each", alone.ratios(apart), alone),
            ("- the library's efficiency / that of independent runs", relative, ours),
        )
    ]


def parallel(results):
    """1 thread over all threads, over their number."""
    lines = []
    for step, name, sites in PARALLEL:
        runs = ("calotte", "calotte 1 thread", SIDE_BY_SIDE)
        ours, alone, apart = (results.one(step, run, set=name) for run in runs)
        if not ours or not alone:
            continue
        threads = results.steps[step].threads
        values = [ratio / threads for ratio in alone.ratios(ours)]
        work = "iteration" if step.startswith("iteration") else "triangulation"
        what = f"parallel efficiency on {threads} threads, {work}, {name}, {sites_text(sites)}"
        lines.append(judged(what, values, (ours, alone), EFFICIENCY, digits=3))
        if apart:
            lines += side_by_side(ours, alone, apart, threads)
    return lines


def requirements(results):
    """All of which there are samples."""
    return speed(results) + parallel(results) + unjudged(results)


def required(lines):
    """Markdown."""
    return table(["quantity", "measured", "threshold", "target", "met", "step"], lines)


def verdicts(lines):
    """How many thresholds are met, and which are not."""
    lines = [line for line in lines if line.threshold != NONE]
    if not lines:
        return "none was measured"
    missed = [line for line in lines if not line.met.startswith("yes")]
    if not missed:
        return f"all {len(lines)} are met"
    names = "; ".join(f"{line.what} ({line.met})" for line in missed)
    return f"{len(lines) - len(missed)} of {len(lines)} are met. Not met: {names}"
