# SPDX-License-Identifier: GPL-3.0-or-later
"""What is required of the library, beside what was measured or modelled."""

from reporting.cells import NONE, percent, sites_text, table, values_cell
from reporting.distribution import Grid
from reporting.plan import FINE, MEDIUM, SIDE_BY_SIDE
from reporting.samples import is_disturbed, median

WORKERS = 96
EFFICIENCY = 0.92  # of two threads, or more
EMULATED = {MEDIUM: 0.6, FINE: 0.85}
IMBALANCE = 1.25


def verdict(value, required, aim, disturbed):
    if disturbed:
        return "disturbed"
    if value < required:
        return "**no**"
    return "yes" if aim is None else "yes, the aim too" if value >= aim else "yes, not the aim"


def ratio_line(what, row, base, required, aim):
    """How many times longer the row takes than the base, in the same rounds."""
    if not row or not base:
        return []
    values = row.ratios(base)
    met = verdict(median(values), required, aim, is_disturbed(values, (row, base)))
    return [[what, values_cell(values, (row, base)), f">= {required}", aim or NONE, met, row.step]]


def pair(results, peer, step, **where):
    """A peer's row and the library's of the same step."""
    section = step.split("-")[0]
    return [results.one(section, step=step, name=name, **where) for name in (peer, "calotte")]


def speed(results):
    lines = ratio_line(
        f"full triangulation, {sites_text(MEDIUM)} random sites: times STRIPACK",
        *pair(results, "STRIPACK", "triangulation-medium"), 9, 12.3,
    )
    lines += ratio_line(
        f"full triangulation, {sites_text(FINE)} random sites: times STRIPACK",
        *pair(results, "STRIPACK", "large-stripack"), 40, 60,
    )
    lines += ratio_line(
        f"full triangulation, {sites_text(FINE)} random sites: times CGAL",
        *pair(results, "CGAL", "large-cgal"), 2.5, 3,
    )
    for name, required, aim in (("uniform", 40, 60), ("x8", 8, 15)):
        lines += ratio_line(
            f"iteration, {name}, {sites_text(MEDIUM)} cells: times STRIPACK-based",
            *pair(results, "STRIPACK", f"iteration-{MEDIUM}", set=name), required, aim,
        )
    return lines


def side_by_side(results, section, ours, alone, threads):
    """The same of runs that do not wait for one another, and the library's beside theirs: a
    yardstick of the machine, no bound, as they use as many times the memory."""
    apart = results.one(
        section, set=ours.set, sites=ours.sites, name=SIDE_BY_SIDE, step=ours.step
    )
    if not apart:
        return []
    theirs = alone.ratios(apart)
    relative = [ratio / threads for ratio in apart.ratios(ours)]
    return [
        [what, values_cell(values, (apart, row), 3), NONE, NONE, NONE, ours.step]
        for what, values, row in (
            (f"- of {threads} independent runs on 1 thread each, side by side", theirs, alone),
            ("- the library's over theirs", relative, ours),
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
        lines.append(
            [what, values_cell(values, (alone, ours), 3), f">= {EFFICIENCY}", NONE, met, ours.step]
        )
        lines += side_by_side(results, section, ours, alone, threads)
    return lines


def emulated(results, network):
    lines = []
    for size, required in EMULATED.items():
        for set_name in ("uniform", "x8"):
            grid = Grid(results, "iteration", set_name, size, network)
            value, count = grid.efficiency(WORKERS) if grid else (None, None)
            if value is None:
                continue
            cut = grid.by_count[count]
            met = verdict(value, required, None, cut.disturbed)
            what = f"modelled efficiency, {WORKERS} workers, iteration, {set_name}, "
            what += sites_text(size)
            lines.append(
                [what, f"{percent(value)}, {count} regions", f">= {percent(required)}", NONE, met]
                + [cut.row.step]
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
                lines.append([what, f"{cut.imbalance:.2f}", f"<= {IMBALANCE}", NONE, met])
                lines[-1].append(cut.row.step)
    return lines


def requirements(results, network):
    """Markdown."""
    lines = speed(results) + parallel(results)
    lines += emulated(results, network) + balance(results, network)
    return table(["", "here", "required", "aim", "met", "step"], lines)
