# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of RESULTS.md, with the paper's own numbers where they are known here."""

from reporting.cells import (
    NONE,
    compared,
    percent,
    ratio_cell,
    refused,
    seconds_text,
    set_text,
    sites_text,
    table,
)
from reporting.distribution import Decomposition
from reporting.makespan import imbalance
from reporting.plan import FINE, MEDIUM, SIDE_BY_SIDE

SETS = ("uniform", "x8")

# Jacobsen et al., 2013, on 96 processors: times STRIPACK of a triangulation and of an iteration, at
# 163 842 generators; seconds to the fine uniform grid from bisected starts.
PAPER_TRIANGULATION = 12.3
PAPER_ITERATION = {"uniform": 14.5, "x8": 9.8}
PAPER_FINE_SECONDS = 112.9

STEP = {"step": lambda row: row.step}


def table_2(results):
    rows = [row for name in ("triangulation", "large", "fresh") for row in results.find(name)]

    def paper(row):
        known = (row.step, row.name) == ("triangulation-medium", "STRIPACK")
        return PAPER_TRIANGULATION if known else NONE

    rows = [row for row in rows if row.name != SIDE_BY_SIDE]
    return compared(rows, "calotte", {"paper (96)": paper} | STEP)


def table_3(results):
    heads = ["cells", "start, method", "whole run, s", "evaluations", "on the finest level"]
    heads += ["s per evaluation", "exchange", "triangulation (repair)", "integration", "final rms"]
    lines = []
    for row in results.find("starts"):
        bisected_fine = row.sites == FINE and row.name.startswith("bisection")
        lines.append(
            [sites_text(row.sites), row.name, seconds_text(row.median())]
            + [f"{row.median('evaluations'):.0f}"]
            + [f"{row.median('evaluations of the finest level'):.0f}"]
            + [seconds_text(row.median("seconds an evaluation"))]
            + [percent(row.median(part)) for part in ("exchange", "repair", "moments")]
            + [f"{row.median('l2'):.1e}" + ("" if row.median("converged") else ", not reached")]
            + [PAPER_FINE_SECONDS if bisected_fine else NONE, row.step]
        )
    return table(heads + ["paper (96), s", "step"], lines)


def sort_of(row):
    """Number of regions, sort and decomposition, of a row's name."""
    _, regions, sort, decomposition = row.name.split(", ")
    return int(regions.split()[0]), sort.split()[0], decomposition.split()[0]


def table_4(results):
    heads = ["sites", "decomposition", "regions", "sort", "points / sites"]
    heads += ["minimum points per region", "mean", "maximum", "maximum / mean"]
    heads += ["all regions, s", "longest, s", "longest / mean", "step"]
    lines = []
    for row in results.find("sorts"):
        regions, sort, decomposition = sort_of(row)
        cut = Decomposition.of(row)
        points = cut.points
        lines.append(
            [set_text(row), decomposition, regions, sort, f"{sum(points) / row.sites:.2f}"]
            + [f"{value:.0f}" for value in (min(points), sum(points) / len(points), max(points))]
            + [f"{imbalance(points):.2f}", seconds_text(cut.total), seconds_text(max(cut.seconds))]
            + [refused(f"{cut.imbalance:.2f}", cut.disturbed), row.step]
        )
    return table(heads, lines)


def table_5(results):
    heads = ["run", "triangulation (repair), s", "integration, s", "iteration, s"]
    heads += ["STRIPACK-based time / this time", "paper (96)", "step"]
    lines = []
    for name in SETS:
        for step in (f"iteration-{MEDIUM}", "iteration-shuffled"):
            stripack = results.one(step, "STRIPACK", set=name)
            for row in (row for row in results.of_step(step) if row.set == name):
                parts = ("triangulate", "lists") if row is stripack else ("repair",)
                label = "STRIPACK-based, serial" if row is stripack else row.name
                lines.append(
                    [f"{name}, {label}"]
                    + [seconds_text(sum(map(row.median, parts)) * row.median())]
                    + [seconds_text(row.median("moments") * row.median())]
                    + [seconds_text(row.median()), ratio_cell(stripack, row)]
                    + [PAPER_ITERATION[name] if row.name == "calotte" else NONE, row.step]
                )
    return table(heads, lines)


def others(results):
    """The plane, and files."""
    plane, files = results.of_step("others-plane"), results.of_step("others-files")
    return compared(plane, "calotte", STEP) + "\n" + compared(files, "delaunay", STEP)
