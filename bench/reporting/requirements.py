# SPDX-License-Identifier: GPL-3.0-or-later
"""The thresholds for the library, with the measured or modelled values."""

from typing import NamedTuple

from reporting.cells import NONE, percent, sites_text, table, values_cell
from reporting.distribution import Grid
from reporting.plan import FINE, MEDIUM, SIDE_BY_SIDE
from reporting.samples import is_disturbed, median

WORKERS = 96
EFFICIENCY = 0.92  # of two threads, or more
EMULATED = {MEDIUM: 0.6, FINE: 0.85}
IMBALANCE = 1.25


class Requirement(NamedTuple):
    """A line of the table of thresholds: texts, and whether the summary repeats it."""

    what: str
    measured: str
    threshold: str
    target: str
    met: str
    step: str
    main: bool = False


def verdict(value, threshold, target, disturbed):
    if disturbed:
        return "disturbed"
    if value < threshold:
        return "**no**"
    if target is None:
        return "yes"
    return "yes, and the target" if value >= target else "yes, but not the target"


def ratio_line(what, row, base, threshold, target):
    """How many times longer the row takes than the base, in the same rounds."""
    if not row or not base:
        return []
    values = row.ratios(base)
    met = verdict(median(values), threshold, target, is_disturbed(values, (row, base)))
    measured = values_cell(values, (row, base))
    return [Requirement(what, measured, f">= {threshold}", target, met, row.step, main=True)]


def pair(results, peer, step, **where):
    """A peer's row and the library's of the same step."""
    section = step.split("-")[0]
    return [results.one(section, step=step, name=name, **where) for name in (peer, "calotte")]


RATIOS = (  # peer, step, sites, threshold, target
    ("STRIPACK", "triangulation-medium", MEDIUM, 12.33, 14),
    ("CGAL", "triangulation-medium", MEDIUM, 3, 3.5),
    ("STRIPACK", "large-stripack", FINE, 40, 60),
    ("CGAL", "large-cgal", FINE, 3, 3.5),
    ("STRIPACK", "fresh-medium", MEDIUM, 11, 14),
    ("CGAL", "fresh-medium", MEDIUM, 2.5, 3.3),
    ("STRIPACK", "fresh-stripack", FINE, 40, 60),
    ("CGAL", "fresh-fine", FINE, 2.5, 3.3),
)


def speed(results):
    lines = []
    for peer, step, sites, threshold, target in RATIOS:
        process = ", in a new process" if step.startswith("fresh") else ""
        lines += ratio_line(
            f"triangulation, {sites_text(sites)} random sites{process}, {peer}'s time / Calotte's",
            *pair(results, peer, step), threshold, target,
        )
    for name, threshold in (("uniform", 60), ("x8", 15)):
        lines += ratio_line(
            f"iteration, {name}, {sites_text(MEDIUM)} cells, STRIPACK-based time / Calotte's",
            *pair(results, "STRIPACK", f"iteration-{MEDIUM}", set=name), threshold, None,
        )
    return lines


def side_by_side(results, section, ours, alone, threads):
    """The efficiency of independent runs, and the library's relative to it. It shows what the machine
    allows; it is no bound, because independent runs use more memory."""
    apart = results.one(
        section, set=ours.set, sites=ours.sites, name=SIDE_BY_SIDE, step=ours.step
    )
    if not apart:
        return []
    theirs = alone.ratios(apart)
    relative = [ratio / threads for ratio in apart.ratios(ours)]
    return [
        Requirement(what, values_cell(values, (apart, row), 3), NONE, NONE, NONE, ours.step)
        for what, values, row in (
            (f"- {threads} independent runs at the same time, 1 thread each", theirs, alone),
            ("- the library's efficiency / that of independent runs", relative, ours),
        )
    ]


def parallel(results):
    """1 thread over all threads, over their number."""
    lines = []
    places = [("triangulation", "random", MEDIUM), ("large", "random", FINE)]
    places += [("iteration", name, size) for size in (MEDIUM, FINE) for name in ("uniform", "x8")]
    for section, set_name, size in places:
        ours = results.one(section, set=set_name, sites=size, name="calotte")
        alone = ours and results.one(
            section, set=set_name, sites=size, name="calotte 1 thread", step=ours.step
        )
        if not alone:
            continue
        threads = results.steps[ours.step].threads
        values = [ratio / threads for ratio in alone.ratios(ours)]
        work = "iteration" if section == "iteration" else "triangulation"
        met = verdict(median(values), EFFICIENCY, None, is_disturbed(values, (alone, ours)))
        what = f"parallel efficiency on {threads} threads, {work}, {set_name}, {sites_text(size)}"
        measured = values_cell(values, (alone, ours), 3)
        lines.append(
            Requirement(what, measured, f">= {EFFICIENCY}", NONE, met, ours.step, main=True)
        )
        lines += side_by_side(results, section, ours, alone, threads)
    return lines


def emulated(results, network):
    lines = []
    for size, threshold in EMULATED.items():
        for set_name in ("uniform", "x8"):
            grid = Grid(results, "iteration", set_name, size, network)
            value, count = grid.efficiency(WORKERS) if grid else (None, None)
            if value is None:
                continue
            cut = grid.by_count[count]
            met = verdict(value, threshold, None, cut.disturbed)
            what = f"modelled efficiency, {WORKERS} workers, iteration, {set_name}, "
            what += sites_text(size)
            measured = f"{percent(value)}, {count} regions"
            lines.append(
                Requirement(what, measured, f">= {percent(threshold)}", NONE, met, cut.row.step)
            )
    return lines


def balance(results, network):
    lines = []
    for work in ("iteration", "triangulation"):
        for size in EMULATED:
            for set_name in ("uniform", "x8"):
                cut = Grid(results, work, set_name, size, network).default
                if cut is None:
                    continue
                met = verdict(-cut.imbalance, -IMBALANCE, None, cut.disturbed)
                what = f"imbalance of the default decomposition, {work}, {set_name}, "
                what += f"{sites_text(size)}: longest / mean of {cut.count} regions"
                measured = f"{cut.imbalance:.2f}"
                lines.append(
                    Requirement(what, measured, f"<= {IMBALANCE}", NONE, met, cut.row.step)
                )
    return lines


def requirements(results, network):
    """All of which there are samples."""
    measured = speed(results) + parallel(results)
    return measured + emulated(results, network) + balance(results, network)


def required(lines):
    """Markdown."""
    heads = ["quantity", "measured", "threshold", "target", "met", "step"]
    return table(heads, [line[: len(heads)] for line in lines])
