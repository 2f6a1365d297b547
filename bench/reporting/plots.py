# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's figures from the samples: PNG by matplotlib, and their points as CSV."""

import csv

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402: the backend comes first

from reporting.cells import sites_text
from reporting.distribution import WORKERS, Decomposition, Grid
from reporting.items import SETS, sort_of
from reporting.plan import COARSE, FINE, MEDIUM

COLORS = {"halo": "C0", "distance": "C1", "voronoi": "C2"}


def axes(count, **options):
    figure, found = pyplot.subplots(1, count, figsize=(5.2 * count, 4.2), squeeze=False, **options)
    return figure, found[0]


def finish(figure, places, file):
    """Writes the figure and its points where anything was drawn in it, or takes an older one away."""
    # Rows that were not run leave empty lines.
    for line in [line for place in places for line in place.lines if not len(line.get_xdata())]:
        line.remove()
    drawn = any(place.lines for place in places)
    if drawn:
        for place in places:
            place.grid(alpha=0.3)
            if place.lines:
                place.legend(fontsize=7)
        figure.tight_layout()
        figure.savefig(file, dpi=110)
        with open(file.with_suffix(".csv"), "w", encoding="utf-8", newline="") as out:
            for place in places:
                for line in place.lines:
                    for point in zip(*line.get_data()):
                        csv.writer(out).writerow([place.get_title(), line.get_label(), *point])
    else:
        file.unlink(missing_ok=True)
    pyplot.close(figure)


def rows_by_size(results, set_name):
    """By size and name, the rows of triangulations of random sites, or of iterations of a set."""
    found = {}
    for section in ("triangulation", "large", "iteration", "sizes"):
        for row in results.find(section, set=set_name):
            if row.step != "iteration-shuffled":
                found.setdefault(row.sites, {}).setdefault(row.name, row)
    return dict(sorted(found.items()))


def named(results, set_name, name):
    """Of those, the rows of that name."""
    return [rows[name] for rows in rows_by_size(results, set_name).values() if name in rows]


def by_size(place, title, ylabel):
    place.set(title=title, xlabel="cells", ylabel=ylabel, xscale="log", yscale="log")


def figure_3(results, _, file):
    """Points a region, most first."""
    rows = results.find("sorts")
    panels = list(dict.fromkeys((row.set, sort_of(row)[2]) for row in rows))
    figure, places = axes(max(1, len(panels)))
    for place, (set_name, decomposition) in zip(places, panels):
        for row in rows:
            regions, sort, of = sort_of(row)
            if (row.set, of) != (set_name, decomposition):
                continue
            points = sorted(Decomposition.of(row).points, reverse=True)
            rank = [(k + 1) / regions for k in range(regions)]
            style = {"color": COLORS[sort], "linestyle": "-" if regions < 100 else "--"}
            place.plot(rank, points, label=f"{sort}, {regions} regions", **style)
        title = f"{set_name} sites, {decomposition} decomposition"
        place.set(title=title, xlabel="region, by rank", ylabel="points", yscale="log")
    finish(figure, places, file)


def figure_6(results, _, file):
    figure, places = axes(len(SETS), sharey=True)
    for place, name in zip(places, SETS):
        rows = named(results, name, "STRIPACK")
        sizes = [row.sites for row in rows]
        for part, label in (("triangulate", "triangulation"), ("moments", "integration")):
            place.plot(sizes, [r.median(part) * r.median() for r in rows], "o-", label=label)
        place.plot(sizes, [row.median() for row in rows], "k.--", label="iteration")
        by_size(place, f"STRIPACK-based SCVT, {name}", "seconds")
    finish(figure, places, file)


def figure_7(results, _, file):
    figure, places = axes(1)
    for name in ("STRIPACK", "Qhull", "CGAL", "calotte one region", "calotte 1 thread", "calotte"):
        points = [(row.sites, row.median()) for row in named(results, "random", name)]
        if points:
            places[0].plot(*zip(*points), "o-", label=name)
    by_size(places[0], "triangulation of random sites", "seconds")
    finish(figure, places, file)


def figure_8(results, _, file):
    figure, places = axes(len(SETS), sharey=True)
    runs = (("STRIPACK", "serial, on STRIPACK's triangles"), ("calotte 1 thread", "1 thread"))
    for place, name in zip(places, SETS):
        for run, label in (*runs, ("calotte", "all threads")):
            rows = named(results, name, run)
            seconds = [row.median("moments") * row.median() for row in rows]
            place.plot([row.sites for row in rows], seconds, "o-", label=label)
        by_size(place, f"integration, {name}", "seconds")
    finish(figure, places, file)


def grids(results, network, set_name):
    """By size, those that were measured."""
    sizes = (COARSE, MEDIUM, FINE)
    found = {size: Grid(results, set_name, size, network) for size in sizes}
    return {size: grid for size, grid in found.items() if grid}


def modelled_lines(place, grid, size, value):
    """value: of a grid, a number of workers and seconds."""
    label = sites_text(size)
    listed = [(p, grid.scheduled(p)[0]) for p in WORKERS]
    points = [(p, value(grid, p, s)) for p, s in listed if s]
    line = place.plot(*zip(*points), "-", label=f"{label}, list scheduling")
    alone = [(p, value(grid, p, grid.one_each(p))) for p in WORKERS if grid.one_each(p)]
    if alone:
        place.plot(*zip(*alone), "x:", color=line[0].get_color(), label=f"{label}, one region each")


def figure_9(results, network, file):
    """Modelled seconds, and the measured ones of this machine's threads."""
    figure, places = axes(len(SETS), sharey=True)
    for place, set_name in zip(places, SETS):
        for size, grid in grids(results, network, set_name).items():
            modelled_lines(place, grid, size, lambda grid, workers, seconds: seconds)
            color = place.lines[-1].get_color()
            for name, row in rows_by_size(results, set_name).get(size, {}).items():
                if name.startswith("calotte"):
                    whole = results.steps[row.step].threads
                    threads = whole if name == "calotte" else int(name.split()[1])
                    place.plot(threads, row.median(), "o", color=color, label=f"_{size}, measured")
        title = f"iteration, {set_name}: modelled; dots measured"
        place.set(title=title, xlabel="workers or threads", ylabel="seconds")
        place.set(xscale="log", yscale="log")
    finish(figure, places, file)


def figure_10(results, network, file):
    """Modelled speed-up."""
    figure, places = axes(len(SETS), sharey=True)
    for place, set_name in zip(places, SETS):
        for size, grid in grids(results, network, set_name).items():
            modelled_lines(place, grid, size, lambda grid, workers, seconds: grid.serial / seconds)
        if place.lines:
            place.plot(WORKERS, WORKERS, "k--", linewidth=0.8, label="ideal")
        title = f"iteration, {set_name}: modelled speed-up"
        place.set(title=title, xlabel="workers", ylabel="times the best serial run")
        place.set(xscale="log", yscale="log")
    finish(figure, places, file)


FIGURES = (figure_3, figure_6, figure_7, figure_8, figure_9, figure_10)


def draw_all(results, network, folder):
    """Those that there are samples for: figure-3.png and figure-3.csv in the folder, and so on."""
    folder.mkdir(parents=True, exist_ok=True)
    for draw in FIGURES:
        draw(results, network, folder / (draw.__name__.replace("_", "-") + ".png"))
