# SPDX-License-Identifier: GPL-3.0-or-later
"""What bench/report runs: sections of steps, each a run of one program."""

from dataclasses import dataclass

COARSE, MEDIUM, FINE = 40962, 163842, 2621442  # the paper's grids
EVERY_SIZE = (2562, 10242, 40962, 163842, 655362, 2621442)
EVERY_SITE = "3000000"  # a limit above all sizes
SIDE_BY_SIDE = "calotte side by side"  # a row of as many triangulations as threads


@dataclass(frozen=True)
class Step:
    """A program and its arguments; its name is that of the file of its samples."""

    name: str
    section: str
    program: str
    arguments: tuple

    @property
    def command(self):
        program = [] if self.program == "delaunay" else [self.program]
        return " ".join(["bench/run", *program, *self.arguments])


def options(**named):
    """Options of a program: rounds=3 is --rounds 3, a tuple a list with commas."""
    arguments = []
    for name, value in named.items():
        text = ",".join(map(str, value)) if isinstance(value, tuple) else str(value)
        arguments += ["--" + name.replace("_", "-"), text]
    return tuple(arguments)


def between(threads):
    """Powers of two above 1 and below the machine's number of threads."""
    return tuple(2**k for k in range(1, 12) if 2**k < threads)


def on_threads(threads):
    """Options of a program that runs on all threads, and on fewer beside that."""
    sweep = {"sweep": between(threads)} if between(threads) else {}
    return options(threads=threads, **sweep)


def triangulation(threads, quick):
    everyone = ("calotte", "one-thread", "one-region", "cgal", "stripack", "qhull")
    yield "delaunay", "medium", options(
        rows=everyone + ("side-by-side",), sizes=MEDIUM, rounds=3 if quick else 21
    ) + on_threads(threads)
    orders = ("calotte", "cgal", "stripack", "stripack-natural", "qhull")
    yield "delaunay", "orders", options(
        rows=orders, sets="bisection", sizes=MEDIUM, rounds=3 if quick else 9
    )
    for size in (2562, 10242, 40962) if quick else (2562, 10242, 40962, 655362):
        rounds = 5 if quick else {2562: 61, 10242: 41, 40962: 31, 655362: 5}[size]
        yield "delaunay", str(size), options(
            rows=everyone,
            sizes=size,
            rounds=rounds,
            stripack_limit=EVERY_SITE,
            qhull_limit=EVERY_SITE,
        ) + on_threads(threads)


def large(threads, quick):
    if quick:
        return
    ours = ("calotte", "one-thread", "one-region", "side-by-side", "cgal")
    yield "delaunay", "cgal", options(rows=ours, sizes=FINE, rounds=11) + on_threads(threads)
    # Apart, and warm: after these peers the library's fresh memory was seen to take 0.36 s more to
    # fault in, while STRIPACK's arrays are touched before its clock starts.
    for peer, rounds in (("stripack", 5), ("qhull", 3)):
        limit = {f"{peer}_limit": EVERY_SITE}
        yield "delaunay", peer, options(
            rows=("calotte", peer), sizes=FINE, rounds=rounds, **limit
        ) + on_threads(threads) + ("--warm",)


def fresh(threads, quick):
    """Each run in a new process."""
    three, common = ("calotte", "cgal", "stripack"), options(threads=threads) + ("--fresh",)
    yield "delaunay", "medium", options(
        rows=three, sizes=MEDIUM, rounds=3 if quick else 21
    ) + common
    if quick:
        return
    yield "delaunay", "fine", options(rows=three[:2], sizes=FINE, rounds=7) + common
    yield "delaunay", "stripack", options(
        rows=("calotte", "stripack"), sizes=FINE, rounds=3, stripack_limit=EVERY_SITE
    ) + common


def iteration(threads, quick):
    rounds = {2562: 41, 10242: 31, 40962: 15, 163842: 21, 655362: 5, 2621442: 3}
    for size in EVERY_SIZE[:4] if quick else EVERY_SIZE:
        yield "cvt", str(size), options(
            sizes=size,
            rounds=3 if quick else rounds[size],
            stripack_limit=EVERY_SITE,
            density_samples=0,
        ) + on_threads(threads)
    if not quick:
        yield "cvt", "shuffled", options(
            sizes=MEDIUM, order="shuffled", rounds=7, density_samples=0
        ) + options(threads=threads)


def starts(threads, quick):
    common = options(threads=threads)
    if quick:
        yield "starts", "small", options(sizes=(2562, 10242), rounds=1, limit=1000) + common
        return
    yield "starts", "small", options(sizes=(10242, COARSE), rounds=3) + common
    yield "starts", "medium", options(sizes=MEDIUM, rounds=1) + common
    yield "starts", "fine", options(sizes=FINE, methods="automatic", rounds=1) + common


def sorts(threads, quick):
    yield "distribution", "coarse" if quick else "medium", options(
        works="triangulation",
        sizes=COARSE if quick else MEDIUM,
        sorts=("halo", "distance", "voronoi"),
        decompositions=("uniform", "x8"),
        regions=42 if quick else (42, 162),
        rounds=1 if quick else 5,
    )


def distribution(threads, quick):
    few = (0, 1, 4, 16, 64, 96, 192, 256, 1024)
    many = (0, 1, 2, 4, 8, 16, 32, 64, 96, 128, 192, 256, 384, 512, 1024, 2048)
    if quick:
        yield "distribution", "medium", options(sizes=MEDIUM, regions=few, rounds=1)
        return
    yield "distribution", "coarse", options(sizes=COARSE, regions=many, rounds=5)
    yield "distribution", "medium", options(sizes=MEDIUM, regions=many, rounds=5, iterations=15)


def fine(threads, quick):
    if quick:
        return
    default, regions = 0, (1, 2, 4, 8, 16, 32, 64, 96, 128, 192, 256, 512, 1024, 2048)
    yield "distribution", "iteration", options(
        sizes=FINE, works="iteration", regions=(default, *regions), rounds=3, iterations=6
    )
    common = options(sizes=FINE, works="triangulation")
    yield "distribution", "triangulation", common + options(regions=regions, rounds=3)
    # The longest of 160 regions of a few milliseconds each: more runs until its median is quiet.
    yield "distribution", "default", common + options(
        regions=default, rounds=5, triangulations=7
    )


def others(threads, quick):
    common = options(rounds=3 if quick else 5, threads=threads)
    yield "plane", "plane", options(size=100000 if quick else 1000000) + common
    yield "files", "files", options(level=7 if quick else 8) + common


SECTIONS = {
    make.__name__: make
    for make in (triangulation, large, fresh, iteration, starts, sorts, distribution, fine, others)
}


def steps(threads, quick, sections=tuple(SECTIONS), names=()):
    """The steps of these sections, in order; where names are given, only those.
    LookupError: there is no section or step of a name."""
    for section in sections:
        if section not in SECTIONS:
            raise LookupError(f"there is no section {section}; there are {', '.join(SECTIONS)}")
    found = {
        f"{section}-{name}": Step(f"{section}-{name}", section, program, arguments)
        for section in sections
        for program, name, arguments in SECTIONS[section](threads, quick)
    }
    for name in names:
        if name not in found:
            raise LookupError(f"there is no step {name}; there are {', '.join(found)}")
    return [step for name, step in found.items() if not names or name in names]
