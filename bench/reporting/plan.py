# SPDX-License-Identifier: GPL-3.0-or-later
"""What bench/report runs: sections of steps, each a run of one program."""

from dataclasses import dataclass

COARSE, MEDIUM, FINE = 40962, 163842, 2621442  # the paper's grids
SMALLER = (2562, 10242, 40962)
EVERY_SIZE = (*SMALLER, 163842, 655362, 2621442)
EVERY_SITE = "3000000"  # a limit above all sizes
SIDE_BY_SIDE = "calotte side by side"  # a row of as many triangulations as threads
EVERYONE = ("calotte", "one-thread", "one-region", "cgal", "stripack", "qhull")


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


def on_threads(threads):
    """Options of a program that runs on all threads, and on powers of two below."""
    fewer = tuple(2**k for k in range(1, 12) if 2**k < threads)
    return options(threads=threads, **({"sweep": fewer} if fewer else {}))


def triangulation(threads, quick):
    yield "delaunay", "medium", options(
        rows=EVERYONE + ("side-by-side",), sizes=MEDIUM, rounds=3 if quick else 21
    ) + on_threads(threads)
    orders = ("calotte", "cgal", "stripack", "stripack-natural", "qhull")
    yield "delaunay", "orders", options(
        rows=orders, sets="bisection", sizes=MEDIUM, rounds=3 if quick else 9, threads=threads
    )


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


def iterations(threads, size, rounds):
    return options(sizes=size, rounds=rounds, stripack_limit=EVERY_SITE) + on_threads(threads)


def iteration(threads, quick):
    yield "cvt", str(MEDIUM), iterations(threads, MEDIUM, 3 if quick else 21)
    if quick:
        return
    yield "cvt", str(FINE), iterations(threads, FINE, 3)
    yield "cvt", "shuffled", options(sizes=MEDIUM, order="shuffled", rounds=7, threads=threads)


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


def others(threads, quick):
    common = options(rounds=3 if quick else 5, threads=threads)
    yield "plane", "plane", options(size=100000 if quick else 1000000) + common
    yield "files", "files", options(level=7 if quick else 8) + common


def sizes(threads, quick):
    """For Figures 6 to 9, beside the sections triangulation, large and iteration."""
    for size in SMALLER if quick else (*SMALLER, 655362):
        rounds = 5 if quick else {2562: 61, 10242: 41, 40962: 31, 655362: 5}[size]
        yield "delaunay", f"triangulation-{size}", options(
            rows=EVERYONE, sizes=size, rounds=rounds, stripack_limit=EVERY_SITE,
            qhull_limit=EVERY_SITE,
        ) + on_threads(threads)  # fmt: skip
        rounds = 3 if quick else {2562: 41, 10242: 31, 40962: 15, 655362: 5}[size]
        yield "cvt", f"iteration-{size}", iterations(threads, size, rounds)


def distribution(threads, quick):
    """For Figures 9 and 10."""
    many = (1, 2, 4, 8, 16, 32, 64, 96, 128, 192, 256, 384, 512, 1024, 2048)
    if quick:
        few = (1, 4, 16, 64, 96, 192, 256, 1024)
        yield "distribution", "medium", options(
            sizes=MEDIUM, works="iteration", regions=few, rounds=1
        )
        return
    for name, size, rounds, count in (
        ("coarse", COARSE, 5, 9),
        ("medium", MEDIUM, 5, 15),
        ("fine", FINE, 3, 6),
    ):
        yield "distribution", name, options(
            sizes=size, works="iteration", regions=many, rounds=rounds, iterations=count
        )


TABLES = (triangulation, large, fresh, iteration, starts, sorts, others)
FIGURES = (sizes, distribution)
SECTIONS = {make.__name__: make for make in TABLES + FIGURES}


def steps(threads, quick, sections, names=()):
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
