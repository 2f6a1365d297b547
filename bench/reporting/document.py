# SPDX-License-Identifier: GPL-3.0-or-later
"""RESULTS.md, composed from samples alone."""

from reporting import items, plots
from reporting.cells import percent, table
from reporting.requirements import required, requirements
from reporting.samples import LEAST_CORE, MOST_OTHERS, WIDEST_SPREAD
from reporting.summary import summary

HEAD = """\
# Benchmark results

{summary}

## Method

`bench/report` writes this file from the samples of every round. All programs run in one process and
take turns: each round runs every row once on the same sites, and the next round starts with the next
row. A ratio divides the times of two rows in the same round. The tables show medians over the rounds,
with quartiles in brackets.

Each run takes over a copy of the sites. Making the copy is not timed, for the library and the others.

Every result is checked. The triangles of every run must match those of the library's first run; a
digest of the oriented triangles decides. On bisected icosahedra, where sites are cocircular up to
rounding, the number of triangles decides. The generators of every iteration must match the library's.
A run with a wrong result fails, and no table contains it.

Freed memory stays with the process and serves the next row. On a virtual machine whose host reclaims
free memory, faulting memory in may cost more than the triangulation.

A row is *disturbed* if

- the quartiles of its ratios, or of the sums over its regions, differ by more than {spread:.0%} of the median,
- a serial run had less than {core:.0%} of a core in half of its rounds, or
- other programs or the host of a virtual machine took more than {others:.0%} of all cores during the step.

Tables mark disturbed rows. A disturbed row decides no threshold.

STRIPACK is NCAR's `trmesh` in double precision. Its sites are in random order, as its documentation
recommends, unless a row states otherwise. Qhull (option Qt) computes the convex hull, whose facets are
the triangles. CGAL is `Delaunay_triangulation_on_sphere_2`; in the plane it is
`Delaunay_triangulation_2`. All three are serial. The paper is Jacobsen et al., Geosci. Model Dev. 6,
1353-1365, 2013. The columns "paper (96)" hold its results on 96 processors, where they are known.
"""

NOTES = {
    "Table 3": """\
Each run stops at an rms distance of 1e-6 between generators and centroids on the unit sphere, the
paper's criterion. *automatic* is the library's default method. *lloyd* stops after 3000 evaluations per
level (with --quick: 1000). The columns exchange, triangulation (repair) and integration are shares of
threads times seconds on the finest level; the remainder is sums and waiting.
""",
    "Table 4": """\
Each row triangulates on one thread, region after region. *halo* is the library's sort, *distance* and
*voronoi* are the paper's. The centres of the uniform decomposition are a bisected icosahedron; those of
the x8 decomposition are a coarse CVT of the x8 density. *Points* are owned sites and halo sites.
""",
    "Table 5": """\
Each row is one iteration of Lloyd's method on the medium grid, from a bisected start. STRIPACK
triangulates anew in every iteration; the library repairs its mesh. The remainder of the library's
iteration is sums. In step `iteration-shuffled` the start is in random order, which is slower for
STRIPACK.
""",
    "Figure 6": "STRIPACK's nodes are in their natural order, which is faster for STRIPACK.\n",
    "Figure 8": """\
The integration time is the integration's share of the iteration, divided evenly over the threads. Sets
of fewer than 4096 sites form one region, which one thread integrates. STRIPACK-based runs use the same
integration code on one region.
""",
    "The plane": """\
In the table on files, *renumbered* renumbers the mesh along the space-filling curve, *voronoi* computes
the connectivity, locations, lengths and areas without a file, *write* writes and synchronises the
complete file, and *the same bytes* writes as many bytes, computed in advance.
""",
}

MODEL = """\
**Measured**: the time of each region, and the number of sites that it would exchange (24 bytes each).
Regions run one after another on one thread, so that they do not disturb each other. Times are medians
over iterations and rounds. **Modelled**: all times for more workers than threads. The modelled time of
an iteration on P workers is the sum of

- the work of the busiest worker's regions,
- the bytes that these regions send or receive, whichever is more, divided by {bandwidth:g} GB/s,
- a latency of {latency:g} us, and
- ceil(log2 P) latencies for the sum that ends an iteration. A triangulation has no such sum.

*List scheduling* assigns several regions to each worker: the longest region first, each to the worker
that becomes free first. It uses the measured decomposition that is fastest for P. *One region per
worker* is the paper's method. The library derives its default number of regions from the number of
sites alone, which is too small for many workers; a distributed run would choose the number for P, as
the model does. Efficiency is relative to the best serial run, the decomposition with the smallest total
time. Repeated triangulations start with regions that are far apart, because the first region finds cold
caches. The model omits work outside the regions' tasks (the choice of regions, the merge, sums),
contention for memory and network, and noise.
"""

COMMANDS = """\
The command of a step repeats its rows. *Others* is the share of all cores that other programs and the
host of a virtual machine took during the step. `bench/report --steps` repeats the steps of disturbed
rows. *Runs* counts the runs of a step; the tables show the last run.
"""


def machine_facts(results):
    """What the samples were made on and of: texts by name."""
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
    return {name: "; ".join(sorted(found)) for name, found in texts.items()}


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
    yield "The plane, files and methods", items.others(results), None


def note_of(title, network):
    if title.startswith("Figure 10"):
        return MODEL.format(latency=1e6 * network.latency, bandwidth=network.bandwidth / 1e9)
    return next((text for start, text in NOTES.items() if title.startswith(start)), "")


def is_empty(text):
    """Whether a table has no rows, or a text no table."""
    return text.count("\n") <= 2


WIDTHS = """\
`bench/widths --jigsaw PATH -o bench-report/raw/widths.md` makes these tables; PATH is the user's own
build of JIGSAW, with `optm_qlim=0.9375`.
"""


def compose(results, network, figures, widths=""):
    facts, lines = machine_facts(results), requirements(results, network)
    head = HEAD.format(
        summary=summary(facts, lines),
        spread=WIDEST_SPREAD,
        core=LEAST_CORE,
        others=MOST_OTHERS,
    )
    text = [head, table(["", "this report"], facts.items())]
    if lines:
        text += ["## Thresholds", required(lines)]
    for title, body, figure in parts(results, network):
        if is_empty(body):
            continue
        text += [f"## {title}", note_of(title, network), body]
        if figure in figures:
            text.append(f"![{title}](plots/{figure}.png)\n")
    if widths:
        text += ["## Grids from cell widths", WIDTHS, widths]
    text += ["## Commands", COMMANDS, commands_table(results)]
    return "\n\n".join(part.strip() for part in text if part) + "\n"


def write(results, network, folder):
    """RESULTS.md and plots/ in the folder."""
    figures = plots.draw_all(results, network, folder / "plots")
    widths = folder / "raw" / "widths.md"
    text = widths.read_text() if widths.exists() else ""
    (folder / "RESULTS.md").write_text(compose(results, network, figures, text))
