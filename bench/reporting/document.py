# SPDX-License-Identifier: GPL-3.0-or-later
"""RESULTS.md, composed from samples, and from widths.md and apart.md, which other commands measured."""

from pathlib import Path

from reporting import items
from reporting.cells import percent, table
from reporting.requirements import required, requirements, verdicts
from reporting.samples import LEAST_CORE, MOST_OTHERS, WIDEST_SPREAD, peers_of

HEAD = """\
# Benchmark results

Calotte, compared with serial programs on the same sites: {peers}.

- Machine: {processor}; {threads} threads; {memory}; {system}.
- Build: {compiler}; commit {commits}; {dates}.
- Thresholds: {verdict}.

`bench/report` measures all tables but those of grids from cell widths and of other measurements, and writes
this file. The last table says of which commit a step is; `bench/report --figures` adds the paper's figures.

## Method

All programs run in one process and take turns: each round runs every row once on the same sites, and the
next round starts with the next row. A ratio divides the times of two rows in the same round. The tables show
medians over the rounds, with quartiles in brackets.

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

SUMMARY = """\
Medians with quartiles in brackets. Side by side are as many independent runs as threads: they show what the
machine allows. Times beside JIGSAW's are under *Grids from cell widths*, memory is under *Other measurements*.
"""

PARTS = (  # title, sections, note, table
    ("Table 2: triangulations", "triangulation,large,fresh", """\
Sets are random sites and a bisected icosahedron in
random order; the latter is for STRIPACK also in its natural order, coarse levels first. In steps
`large-stripack` and `large-qhull` an untimed run precedes each of the library's; in steps `fresh-*` each run
has a new process. The paper's number is STRIPACK's time / its own.
""", items.table_2),
    ("Table 3: starts", "starts", """\
Each run stops at an rms distance of 1e-6 between generators and centroids on the unit sphere, the
paper's criterion. *automatic* is the library's default method. *lloyd* stops after 3000 evaluations per
level. The columns exchange, triangulation (repair) and integration are shares of threads times seconds on the
finest level; the remainder is sums and waiting.
""", items.table_3),
    ("Table 4: sorts", "sorts", """\
`bench/report --figures` draws it as Figure 3. Each row
triangulates on one thread, region after region. *halo* is the library's sort, *distance* and *voronoi* are
the paper's. The centres of the uniform decomposition are a bisected icosahedron; those of the x8
decomposition are a coarse CVT of the x8 density. *Points* are owned sites and halo sites.
""", items.table_4),
    ("Table 5: iterations", "iteration", """\
Each row is one iteration of Lloyd's method on the medium grid, from
a bisected start. STRIPACK triangulates anew in every iteration; the library repairs its mesh. The remainder
of the library's iteration is sums. In step `iteration-shuffled` the start is in random order, which is slower
for STRIPACK.
""", items.table_5),
    ("The plane and files", "others", """\
In the table on files, *renumbered* renumbers the mesh along the
space-filling curve, *voronoi* computes the connectivity, locations, lengths and areas without a file, *write*
writes and synchronises the complete file, and *the same bytes* writes as many bytes, computed in advance.
""", items.others),
)  # fmt: skip

COMMANDS = """\
The command of a step repeats its rows. *Others* is the share of all cores that other programs and the
host of a virtual machine took during the step. `bench/report --steps` repeats the steps of disturbed
rows. *Runs* counts the runs of a step; the tables show the last run.
"""


def machine_facts(steps):
    """What the samples were made on and of: texts by name."""
    contexts = [step.output["context"] for step in steps]
    texts = {name: {step.machine[name] for step in steps} for name in steps[0].machine}
    texts |= {
        "compiler": {f"g++ {context['compiler']}, -O3" for context in contexts},
        "commits": {step.commit for step in steps},
        "dates": {step.date[:10] for step in steps},
        "peers": {peer for context in contexts for peer in peers_of(context)},
    }
    return {name: "; ".join(sorted(found)) for name, found in texts.items()}


def commands_table(steps):
    return table(
        ["step", "command", "seconds", "others", "runs", "commit", "UTC"],
        [
            [step.name, f"`{step.command}`", f"{step.seconds:.0f}", percent(step.others)]
            + [step.runs, step.commit, step.date]
            for step in steps
        ],
    )


def compose(results):
    """Markdown of the tables; figures have their own files."""
    sections = [section for _, names, _, _ in PARTS for section in names.split(",")]
    steps = [step for step in results.steps.values() if step.section in sections]
    lines = requirements(results)
    text = [
        HEAD.format(verdict=verdicts(lines), spread=WIDEST_SPREAD, core=LEAST_CORE,
                    others=MOST_OTHERS, **machine_facts(steps)),
        "## Summary", SUMMARY, required(lines),
    ]  # fmt: skip
    for title, names, note, body in PARTS:
        if any(step.section in names.split(",") for step in steps):
            command = f"`bench/report --sections {names}` makes this. "
            text += [f"## {title}", command + note, body(results)]
    here = Path(__file__).parent
    text += [(here / name).read_text(encoding="utf-8") for name in ("widths.md", "apart.md")]
    text += ["## Commands", COMMANDS, commands_table(steps)]
    return "\n\n".join(part.strip() for part in text) + "\n"
