# SPDX-License-Identifier: GPL-3.0-or-later
"""RESULTS.md, of samples alone."""

from reporting import items, plots
from reporting.cells import percent, table
from reporting.requirements import requirements
from reporting.samples import LEAST_CORE, MOST_OTHERS, WIDEST_SPREAD

HEAD = """\
# What bench/report measured

Written by `bench/report` from the samples of every round; no number here has another source.
Peers run in the library's process, in turns: each round runs every row once on the same sites, and
the next round starts with the next row. A ratio is of two rows' seconds of the same round; the
medians of the rounds are told, with quartiles in brackets. Every run's triangles are compared with
those of the library's first run (a digest of the oriented triangles; on bisected icosahedra, where
sites are cocircular but for rounding, peers' triangles are counted), and every iteration's
generators with the library's: a wrong answer fails, and is in no table. What is freed stays with
the process, for the next row's use: where a virtual machine's host takes free memory back, to fault
it in again may cost more than to triangulate in it.

**Disturbed** is what is said of a row when the quartiles of its ratios (or of its regions' sums)
lie further apart than {spread:.0%} of their median, when a serial run had less than {core:.0%}
of a core in half of its rounds, or when, while the step ran, other programs or a virtual
machine's host took more than {others:.0%} of all cores: the row is refused, its numbers are shown
and count for nothing.

STRIPACK is NCAR's `trmesh` in doubles; its sites are in random order, as its documentation asks,
unless the row says otherwise. Qhull (option Qt) gives the convex hull, whose facets are the
triangles. CGAL is `Delaunay_triangulation_on_sphere_2`, in the plane `Delaunay_triangulation_2`.
All of these are serial. The paper is Jacobsen et al., Geosci. Model Dev. 6, 1353-1365, 2013; its
own figures, on 96 processors, stand in columns of theirs, - or none where they are not known here.
"""

NOTES = {
    "Table 3": """\
Whole runs to an rms distance of generators from their centroids of 1e-6 on the unit sphere, the
paper's criterion. *automatic* is the library's default method; *lloyd* ends after 3000 evaluations
(quick: 1000) on a level. Shares are of threads times seconds on the finest level; the rest are sums
and waiting.
""",
    "Table 4": """\
A triangulation by the library's sort (halo) and the paper's two, on one thread, region after
region. The uniform decomposition's centres are a bisected icosahedron, the x8 decomposition's a
coarse CVT of the x8 density. *Points* are owned and halo.
""",
    "Table 5": """\
One iteration of Lloyd's method at the medium grid, from a bisected start. STRIPACK triangulates
anew in each; the library mends the mesh it has. The rest of the library's iteration are sums. In
step `iteration-shuffled` the start is in random order, which makes STRIPACK slower.
""",
    "Figure 6": "STRIPACK's nodes are in their natural order, in which it is faster.\n",
    "Figure 8": """\
Seconds of integration are its share of the iteration, as if spread evenly over the threads; sets of
less than 4096 sites are one region, which one thread integrates over. STRIPACK-based runs use the
very same code on one region.
""",
}

MODEL = """\
**Measured**: the seconds of each region, one after another on one thread of this machine, so that
no region disturbs another (medians over iterations and rounds), and how many sites it would
exchange, 24 bytes each. **Modelled**: all that is said of more workers than there are threads. An
iteration on P workers takes the longest worker's regions, plus the bytes that these send or receive
(whichever is more) over {bandwidth:g} GB/s, plus a latency of {latency:g} us; and, for the sum that
ends a run, ceil(log2 P) more of these (a triangulation has no such sum). *List scheduling* gives
workers several regions, longest first, each to the worker that is free first, from the measured
decomposition that serves P best; *one region a worker* is the paper's way. The library's own number
of regions follows from the number of sites alone and is too small for many workers: a distributed
run would choose it, `options.partition.regions`, by P, as is done here. Efficiency is against the
best serial run: the decomposition with the least sum of seconds. Repeated triangulations begin with
regions far apart, as the one that comes first finds the caches cold. Left out: what is outside the
regions' tasks (the choice of regions, the union, sums), contention for memory or network, noise.
"""


COMMANDS = """\
A step's rows are made again by its command. *Others* is the part of all cores that other programs
and the host took meanwhile. Steps of disturbed rows may be run again (`bench/report --steps`):
*runs* is how often they ran, and the last one counts.
"""


def machine_table(results):
    machines = [step.machine for step in results.steps.values()]
    outputs = [step.output for step in results.steps.values()]
    peers = {}
    for output in outputs:
        peers.update(output["peers"])
    texts = {name: {machine[name] for machine in machines} for name in machines[0]}
    texts |= {
        "compiler": {f"g++ {output['compiler']}, -O3" for output in outputs},
        "commits": {step.commit for step in results.steps.values()},
        "dates": {step.date[:10] for step in results.steps.values()},
        "peers": {f"{name} {version}" for name, version in peers.items()}
        | {"STRIPACK" if output["stripack"] else "no STRIPACK" for output in outputs},
    }
    lines = [[name, "; ".join(sorted(found))] for name, found in texts.items()]
    return table(["", "here"], lines)


def commands_table(results):
    lines = [
        [step.name, f"`{step.command}`", f"{step.seconds:.0f}", percent(step.others)]
        + [str(step.runs), step.commit, step.date]
        for step in results.steps.values()
    ]
    return table(["step", "command", "seconds", "others", "runs", "commit", "UTC"], lines)


def parts(results, network):
    """Titles, Markdown, and the figure that belongs there."""
    yield "Table 2: full triangulations", items.table_2(results), None
    yield "Table 3: starts", items.table_3(results), None
    yield "Table 4 and Figure 3: sorts and decompositions", items.table_4(results), "figure-3"
    yield "Table 5: iterations", items.table_5(results), None
    yield "Figure 6: a STRIPACK-based SCVT by size", items.figure_6(results), "figure-6"
    yield "Figure 7: triangulation by size", items.figure_7(results), "figure-7"
    yield "Figure 8: integration by size", items.figure_8(results), "figure-8"
    yield "Figure 9: by threads and size, measured", items.figure_9_measured(results), "figure-9"
    yield "Figure 10: scaling, modelled", items.figure_10(results, network), "figure-10"
    yield "Decompositions", items.decompositions(results, network), None
    yield "The plane, files, methods", items.others(results), None


def note_of(title, network):
    if title.startswith("Figure 10"):
        return MODEL.format(latency=1e6 * network.latency, bandwidth=network.bandwidth / 1e9)
    return next((text for start, text in NOTES.items() if title.startswith(start)), "")


def is_empty(text):
    """Whether a table has no rows, or a text no table."""
    return text.count("\n") <= 2


def compose(results, network, figures):
    head = HEAD.format(spread=WIDEST_SPREAD, core=LEAST_CORE, others=MOST_OTHERS)
    text = [head, machine_table(results)]
    required = requirements(results, network)
    if not is_empty(required):
        text += ["## What is required", required]
    for title, body, figure in parts(results, network):
        if is_empty(body):
            continue
        text += [f"## {title}", note_of(title, network), body]
        if figure in figures:
            text.append(f"![{title}](plots/{figure}.png)\n")
    text += ["## Commands", COMMANDS, commands_table(results)]
    return "\n\n".join(part.strip() for part in text if part) + "\n"


def write(results, network, folder):
    """RESULTS.md and plots/ in the folder."""
    figures = plots.draw_all(results, network, folder / "plots")
    (folder / "RESULTS.md").write_text(compose(results, network, figures))
