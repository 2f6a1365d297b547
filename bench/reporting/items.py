# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's tables and figures, item by item, with its own figures where they are known here."""

from reporting.cells import (
    NONE,
    percent,
    ratio_cell,
    refused,
    seconds_cell,
    seconds_text,
    sites_text,
    table,
)
from reporting.distribution import WORKERS, Decomposition, Grid
from reporting.makespan import imbalance
from reporting.plan import COARSE, EVERY_SIZE, FINE, MEDIUM, SIDE_BY_SIDE

GRIDS = (COARSE, MEDIUM, FINE)
SETS = ("uniform", "x8")
LARGE = ("large-cgal", "large-stripack", "large-qhull")
FRESH = ("fresh-medium", "fresh-fine", "fresh-stripack")

# Jacobsen et al., 2013, on 96 processors: times STRIPACK of a triangulation and of an iteration, at
# 163 842 generators; seconds to the fine uniform grid from bisected starts.
PAPER_TRIANGULATION = 12.3
PAPER_ITERATION = {"uniform": 14.5, "x8": 9.8}
PAPER_FINE_SECONDS = 112.9


def by_name(rows):
    return {row.name: row for row in rows}


def compared(rows, base="calotte"):
    """Markdown: rows of one set, and how many times the library's seconds they take."""
    ours = by_name(rows).get(base)
    return table(
        ["run", "rounds", "median s", "us per site", f"time / {base}", "step"],
        [
            [
                row.name,
                len(row.seconds),
                seconds_cell(row),
                f"{1e6 * row.median() / row.sites:.3f}",
                "1" if row is ours else ratio_cell(row, ours),
                row.step,
            ]
            for row in rows
        ],
    )


def step_rows(results, step):
    return [row for row in results.rows if row.step == step]


def single(rows):
    """Those of one triangulation."""
    return [row for row in rows if row.name != SIDE_BY_SIDE]


def table_2(results):
    rows = single(results.find("triangulation", set="random", sites=MEDIUM))
    stripack = by_name(rows).get("STRIPACK")
    text = ""
    if rows:
        text = table(
            ["run", "median s", "STRIPACK's time / this time", "paper (96)", "step"],
            [
                [
                    row.name,
                    seconds_cell(row),
                    "1" if row is stripack else ratio_cell(stripack, row),
                    PAPER_TRIANGULATION if row.name == "calotte" else NONE,
                    row.step,
                ]
                for row in rows
            ],
        )
    orders = step_rows(results, "triangulation-orders")
    if orders:
        text += (
            "\nA bisected icosahedron in random order; for STRIPACK also in its natural order, coarse "
            "levels first:\n\n" + compared(orders)
        )
    for step in LARGE:
        rows = single(step_rows(results, step))
        if rows:
            warm = "" if step == "large-cgal" else ", with an untimed run before each of the library's"
            text += f"\nThe size of the fine grid, {sites_text(FINE)} random sites{warm}:\n\n"
            text += compared(rows)
    for step in FRESH:
        rows = step_rows(results, step)
        if rows:
            text += f"\n{sites_text(rows[0].sites)} random sites, each run in a new process:\n\n"
            text += compared(rows)
    return text


def shares(row, names):
    return [percent(row.median(name)) for name in names]


def table_3(results):
    rows = results.find("starts")
    return table(
        ["cells", "start, method", "whole run, s", "evaluations", "on the finest level"]
        + ["s per evaluation", "exchange", "triangulation (repair)", "integration", "final rms"]
        + ["paper (96), s", "step"],
        [
            [
                sites_text(row.sites),
                row.name,
                seconds_cell(row),
                f"{row.median('evaluations'):.0f}",
                f"{row.median('evaluations of the finest level'):.0f}",
                seconds_text(row.median("seconds an evaluation")),
                *shares(row, ("exchange", "repair", "moments")),
                f"{row.median('l2'):.1e}" + ("" if row.median("converged") else ", not reached"),
                PAPER_FINE_SECONDS
                if row.sites == FINE and row.name.startswith("bisection")
                else NONE,
                row.step,
            ]
            for row in rows
        ],
    )


def sort_of(row):
    """Sort and decomposition, of a row's name."""
    _, regions, sort, decomposition = row.name.split(", ")
    return int(regions.split()[0]), sort.split()[0], decomposition.split()[0]


def table_4(results):
    lines = []
    for row in results.find("sorts"):
        regions, sort, decomposition = sort_of(row)
        cut = Decomposition.of(row)
        points = [owned + halo for owned, halo in zip(cut.owned, cut.halo)]
        lines.append(
            [
                f"{row.set}, {sites_text(row.sites)}",
                decomposition,
                regions,
                sort,
                f"{sum(points) / row.sites:.2f}",
                f"{min(points):.0f}",
                f"{sum(points) / len(points):.0f}",
                f"{max(points):.0f}",
                f"{imbalance(points):.2f}",
                seconds_text(cut.total),
                seconds_text(max(cut.seconds)),
                refused(f"{cut.imbalance:.2f}", cut.disturbed),
                row.step,
            ]
        )
    heads = ["sites", "decomposition", "regions", "sort", "points / sites"]
    heads += ["minimum points per region", "mean", "maximum", "maximum / mean"]
    heads += ["all regions, s", "longest, s", "longest / mean", "step"]
    return table(heads, lines)


def iteration_row(row, stripack, paper):
    if row is stripack:
        triangulation = row.median("triangulate") + row.median("lists")
    else:
        triangulation = row.median("repair")
    seconds = row.median()
    return [
        f"{row.set}, {'STRIPACK-based, serial' if row is stripack else row.name}",
        seconds_text(triangulation * seconds),
        seconds_text(row.median("moments") * seconds),
        seconds_text(seconds),
        "1" if row is stripack else ratio_cell(stripack, row),
        paper if row.name == "calotte" else NONE,
        row.step,
    ]


def table_5(results):
    lines = []
    for name in SETS:
        rows = step_rows(results, f"iteration-{MEDIUM}") + step_rows(results, "iteration-shuffled")
        rows = [row for row in rows if row.set == name]
        for step in dict.fromkeys(row.step for row in rows):
            mine = [row for row in rows if row.step == step]
            stripack = by_name(mine).get("STRIPACK")
            lines += [iteration_row(row, stripack, PAPER_ITERATION[name]) for row in mine]
    heads = ["run", "triangulation (repair), s", "integration, s", "iteration, s"]
    heads += ["STRIPACK-based time / this time", "paper (96)", "step"]
    return table(heads, lines)


def figure_6(results):
    lines = []
    for name in SETS:
        for size in EVERY_SIZE:
            row = results.one("iteration", set=name, sites=size, name="STRIPACK")
            if not row or row.step == "iteration-shuffled":
                continue
            shares_of = ("triangulate", "lists", "moments")
            parts = [row.median(part) * row.median() for part in shares_of]
            ours = results.one("iteration", set=name, sites=size, name="calotte", step=row.step)
            lines.append(
                [f"{name}, {sites_text(size)}", *map(seconds_text, parts), seconds_cell(row)]
                + [ratio_cell(row, ours), f"{row.counters['difference'][0]:.1e}", row.step]
            )
    heads = ["cells", "triangulation, s", "adjacency lists, s", "integration, s", "iteration, s"]
    return table(heads + ["time / calotte", "difference of generators", "step"], lines)


def size_rows(results, size):
    """Random sites of a size: all who were timed, in one step."""
    steps = [f"triangulation-{size}", "triangulation-medium", *LARGE]
    rows = [row for step in steps for row in step_rows(results, step)]
    found = {}
    for row in rows:
        if row.sites == size and row.set == "random":
            found.setdefault(row.name, row)
    return found


def figure_7(results):
    names = ("calotte 1 thread", "calotte one region", "CGAL", "STRIPACK", "Qhull")
    lines = []
    for size in EVERY_SIZE:
        rows = size_rows(results, size)
        if "calotte" not in rows:
            continue
        cells = []
        for name in names:
            row = rows.get(name)
            ours = row and results.one(
                results.steps[row.step].section, step=row.step, name="calotte", sites=size
            )
            cells.append(ratio_cell(row, ours))
        steps = ", ".join(dict.fromkeys(row.step for row in rows.values()))
        lines.append([sites_text(size), seconds_cell(rows["calotte"]), *cells, steps])
    heads = ["sites", "calotte, s", *(f"{name} / calotte" for name in names), "step"]
    return table(heads, lines)


def figure_8(results):
    lines = []
    for name in SETS:
        for size in EVERY_SIZE:
            step = f"iteration-{size}"
            rows = {row.name: row for row in step_rows(results, step) if row.set == name}
            if not rows:
                continue
            cells = []
            for run in ("STRIPACK", "calotte 1 thread", "calotte"):
                row = rows.get(run)
                cells.append(seconds_text(row.median("moments") * row.median()) if row else NONE)
            whole = [seconds_cell(rows.get(run)) for run in ("calotte 1 thread", "calotte")]
            ratio = ratio_cell(rows.get("calotte 1 thread"), rows.get("calotte"))
            lines.append([f"{name}, {sites_text(size)}", *cells, *whole, ratio, step])
    heads = ["cells", "serial, on STRIPACK's triangles, s", "calotte, 1 thread, s"]
    heads += ["calotte, all threads, s", "iteration, 1 thread, s", "iteration, all threads, s"]
    return table(heads + ["1 thread / all threads", "step"], lines)


def thread_rows(results, section, set_name, size):
    """Rows of the library by number of threads, from the step with most rounds."""
    base = results.one(section, set=set_name, sites=size, name="calotte")
    rows = results.find(section, set=set_name, sites=size, step=base.step) if base else []
    return [row for row in rows if row is base or row.name.endswith(("thread", "threads"))]


def figure_9_measured(results):
    lines = []
    groups = [("triangulation", "random"), ("large", "random")]
    groups += [("iteration", name) for name in SETS]
    for section, set_name in groups:
        for size in EVERY_SIZE:
            rows = thread_rows(results, section, set_name, size)
            ours = by_name(rows).get("calotte")
            work = "iteration" if section == "iteration" else "triangulation"
            for row in rows:
                if row is ours:
                    continue
                threads = int(row.name.split()[1])
                lines.append(
                    [f"{work}, {set_name}, {sites_text(size)}", threads, seconds_cell(row)]
                    + [seconds_cell(ours), ratio_cell(row, ours), row.step]
                )
    heads = ["work", "threads", "s", "s on all threads", "speed-up of all threads", "step"]
    return table(heads, lines)


def modelled(results, network, work, set_name):
    lines = []
    for size in GRIDS:
        grid = Grid(results, work, set_name, size, network)
        if not grid:
            continue
        for workers in WORKERS:
            seconds, count = grid.scheduled(workers)
            if seconds is None:
                continue
            alone = grid.one_each(workers)
            lines.append(
                [sites_text(size), workers, seconds_text(seconds), count]
                + [percent(grid.efficiency(workers)[0])]
                + [seconds_text(alone) if alone else NONE]
                + [percent(grid.serial / (workers * alone)) if alone else NONE]
                + [", ".join(sorted({found.row.step for found in grid.by_count.values()}))]
            )
    heads = ["sites", "workers", "list scheduling, s", "regions", "efficiency"]
    return table(heads + ["one region per worker, s", "efficiency", "step"], lines)


def figure_10(results, network):
    text = ""
    for work in ("iteration", "triangulation"):
        for set_name in SETS:
            rows = modelled(results, network, work, set_name)
            if rows.count("\n") > 2:
                text += f"\n**{work}, {set_name}**\n\n{rows}"
    return text


def decompositions(results, network):
    lines = []
    for work in ("iteration", "triangulation"):
        for set_name in SETS:
            for size in GRIDS:
                grid = Grid(results, work, set_name, size, network)
                for count, cut in sorted(grid.by_count.items()):
                    default = " (default)" if grid.default and count == grid.default.count else ""
                    lines.append(
                        [f"{work}, {set_name}, {sites_text(size)}", f"{count}{default}"]
                        + [seconds_text(cut.total), seconds_text(max(cut.seconds))]
                        + [refused(f"{cut.imbalance:.2f}", cut.disturbed)]
                        + [f"{imbalance(cut.owned):.2f}", f"{sum(cut.halo) / size:.3f}"]
                        + [f"{max(cut.sent) / 1000:.1f}", cut.row.step]
                    )
    heads = ["work", "regions", "all regions, s", "longest, s", "longest / mean"]
    heads += ["maximum / mean of owned sites", "halo / sites", "maximum kB exchanged", "step"]
    return table(heads, lines)


def others(results):
    text = ""
    for step, title, base in (
        ("others-plane", "The plane, compared with CGAL::Delaunay_triangulation_2", "calotte"),
        ("others-files", "A complete MPAS mesh, compared with its triangulation", "delaunay"),
    ):
        rows = step_rows(results, step)
        for set_name in dict.fromkeys(row.set for row in rows):
            mine = [row for row in rows if row.set == set_name]
            text += f"\n**{title}: {set_name}, {sites_text(mine[0].sites)}**\n\n"
            text += compared(mine, base)
    return text
