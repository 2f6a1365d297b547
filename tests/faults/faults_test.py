#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command on a system that fails: the n-th malloc, mmap, open, read, write, fsync or rename, for n = 1, 2, 3 ...
until a run makes fewer calls.

    faults_test.py CALOTTE SHIM [WORD]

SHIM is the library of shim.cpp; WORD selects the commands whose name holds it. Each run must end by itself with a
documented exit code and one line of message, must leave every output absent, as it was, or complete, and no other
file; a checkpoint that existed before must resume to the same mesh. Prints a table of runs by command and fault.
CALOTTE_FAULTS=all takes more n than the default does."""
import concurrent.futures
import functools
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile

CALOTTE, SHIM = (os.path.abspath(path) for path in sys.argv[1:3])
ONLY = sys.argv[3] if len(sys.argv) > 3 else ""
ALL = os.environ.get("CALOTTE_FAULTS") == "all"
EVERY, GROWTH = (50, 1.1) if ALL else (3, 2.5)  # all n up to EVERY, then n grows by that factor
SPACING = 7 if ALL else 97
KINDS = ["malloc", "malloc on", "mmap", "mmap on", "open", "open on", "read", "read on", "write", "write on", "short",
         "fsync", "fsync on", "rename", "rename on", "shrink", "clock on", "full disk"]
# "on": all later calls fail, too. "full disk": no file can be larger than n times 500 bytes.
CODES = {"malloc": {0, 3, 4}, "mmap": {0, 3, 4}, "shrink": {0, 2, 3}, "clock": {0}}  # others: 0 and 3
TIMEOUT = 300  # seconds; a run takes less than one
BEFORE = b"as it was\n"
FORMATS = {"mpas": "o.nc", "mpas-minimal": "o.nc", "ugrid": "o.nc", "ugrid-triangles": "o.nc", "scrip": "o.nc",
           "esmf": "o.nc", "vtp": "o.vtp", "vtu": "o.vtu", "vtp-cells": "o.vtp", "vtu-cells": "o.vtu", "off": "o.off",
           "ply": "o.ply", "triangles": "o.tri", "mpi-scvt": "SaveVertices", "msh": "o.msh", "geojson": "o.geojson",
           "exodus": "o.g", "fesom": "nod2d.out", "gmsh": "o.msh", "schism": "o.gr3", "adcirc": "o.14",
           "sms": "o.2dm"}


def call(arguments, folder, fault=None):
    """Runs the command; returns its exit code (None if it hangs), standard error and count of calls, None
    if it did not return from main()."""
    limit = None
    environment = dict(os.environ, CALOTTE_LOG_AFTER="1e9")
    if fault and fault[0] == "full disk":
        limit = functools.partial(resource.setrlimit, resource.RLIMIT_FSIZE, (500 * fault[1], 500 * fault[1]))
    elif fault:
        kind, at, count = fault
        environment.update(LD_PRELOAD=SHIM, CALOTTE_FAULT_KIND=kind.split()[0], CALOTTE_FAULT_AT=str(at),
                           CALOTTE_FAULT_COUNT=count)
        if kind.endswith(" on"):
            environment["CALOTTE_FAULT_ON"] = "1"
    try:
        result = subprocess.run([CALOTTE, *arguments], cwd=folder, env=environment, capture_output=True, check=False,
                                timeout=TIMEOUT, preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return None, "", None
    calls = None
    if fault and os.path.exists(fault[2]):
        with open(fault[2], encoding="ascii") as file:
            calls = int(file.read() or 0)
        os.remove(fault[2])
    return result.returncode, result.stderr.decode(errors="replace"), calls


def contents(path):
    with open(path, "rb") as file:
        return file.read()


class Command:
    """A command line, its inputs and the outputs that it makes without a fault. `resumed` is a checkpoint that it
    reads, or writes again."""

    def __init__(self, name, arguments, source, inputs, resumed="", volatile=()):
        self.name, self.arguments, self.resumed = name, arguments, resumed
        self.inputs = {file: contents(os.path.join(source, file)) for file in inputs}
        self.volatile = set(volatile) | ({resumed} if resumed else set())  # these hold times
        with tempfile.TemporaryDirectory() as folder:
            self.lay_out(folder)
            code, message, _ = call(arguments, folder)
            assert code == 0, f"{name}: {message}"
            self.good = {file: contents(os.path.join(folder, file)) for file in os.listdir(folder)}

    def lay_out(self, folder):
        for file, content in self.inputs.items():
            with open(os.path.join(folder, file), "wb") as out:
                out.write(content)

    def outputs(self):
        return set(self.good) - set(self.inputs)

    def faults_of_files(self, folder, kind, code, before):
        """Sentences about what is wrong in the folder after a run."""
        cut = set(self.inputs) if kind == "shrink" else set()  # by the fault itself
        found = set(os.listdir(folder))
        for extra in found - set(self.good):
            yield f"leaves {extra}"
        for file in set(self.inputs) - found:
            yield f"removes {file}"
        for file in sorted((self.outputs() | ({self.resumed} if self.resumed else set())) - cut):
            if file not in found:
                if code == 0 or (before and file in before):
                    yield f"exit code {code} without {file}"
                continue
            content = contents(os.path.join(folder, file))
            if file in self.volatile:
                if file == self.resumed:
                    yield from self.faults_of_checkpoint(folder)
                elif code == 0 and not content.rstrip().endswith(b"}"):
                    yield f"cuts {file}"
            elif content != self.good[file] and not (code != 0 and before and content == before.get(file)):
                yield f"exit code {code} with another {file}"

    def faults_of_checkpoint(self, folder):
        with tempfile.TemporaryDirectory() as place:
            shutil.copy(os.path.join(folder, self.resumed), place)
            code, message, _ = call(["cvt", "--resume", self.resumed, "-o", "g.nc"], place)
            if code != 0:
                yield f"loses {self.resumed}: {message}"
            elif contents(os.path.join(place, "g.nc")) != self.good["g.nc"]:
                yield f"resumes {self.resumed} to another mesh"

    def faults_of_exit(self, kind, code, message):
        if code is None:
            yield f"hangs for {TIMEOUT} s"
        elif code < 0:
            yield f"ends by signal {-code}: {message[-300:]}"
        elif code not in CODES.get(kind.split()[0], {0, 3}):
            yield f"exit code {code}: {message[-300:]}"
        elif code == 4 and message and not re.search("not enough memory|no more threads", message):
            yield f"exit code 4: {message[-300:]}"
        elif code in (2, 3) and not re.fullmatch(r"(calotte: [^\n]*\n)+", message):
            yield f"exit code {code}: {message[-300:]!r}"

    def attempt(self, kind, at):
        """Makes the fault; returns the number of calls and what is wrong, as lines."""
        with tempfile.TemporaryDirectory() as scratch:
            folder = os.path.join(scratch, "work")
            os.mkdir(folder)
            self.lay_out(folder)
            before = {}
            if at % 2:  # outputs exist already
                for file in self.outputs() - {self.resumed}:
                    before[file] = BEFORE
                    with open(os.path.join(folder, file), "wb") as out:
                        out.write(BEFORE)
            code, message, calls = call(self.arguments, folder, (kind, at, os.path.join(scratch, "count")))
            wrong = [*self.faults_of_exit(kind, code, message), *self.faults_of_files(folder, kind, code, before)]
            if kind == "full disk":
                calls = max(map(len, self.good.values())) // 500
            return calls, code, [f"{self.name}, {kind} {at}: {line}" for line in wrong]


def numbers(command, kind):
    """The calls that fail in turn. Those of malloc are evenly spaced for one command: thousands belong to the parser of
    options, whatever the command."""
    at = 1
    while True:
        yield at
        growth = 1 if at < EVERY else max(1, round(at * (GROWTH - 1)))
        at += min(growth, SPACING) if (command.name, kind) == ("delaunay", "malloc") else growth


def kinds_of(command):
    """By default formats are converted with single faults only: later calls are those of other commands."""
    return [kind for kind in KINDS if ALL or not (kind.endswith(" on") and command.name.startswith("convert"))]


def sweep(command, kind):
    """Runs the command with each fault of a kind; returns the runs by exit code and what is wrong."""
    codes, wrong = {}, []
    for at in numbers(command, kind):
        calls, code, lines = command.attempt(kind, at)
        wrong += lines
        if calls is not None and calls < at:
            return codes, wrong  # no fault was met
        codes[code] = codes.get(code, 0) + 1


def commands(source):
    """The commands, on small inputs that this makes in a folder."""
    def make(*arguments):
        code, message, _ = call(arguments, source)
        assert code == 0, f"{arguments}: {message}"
    make("points", "random", "300", "-o", "p.txt")
    make("delaunay", "p.txt", "-o", "m.nc")
    make("points", "random", "20000", "-o", "large.txt")
    make("delaunay", "large.txt", "-o", "large.nc")
    run = ["cvt", "--cells", "162", "--start", "continuation", "--iterations", "4", "--checkpoint", "c",
           "--checkpoint-every", "2", "--threads", "2"]
    make(*run, "-o", "g.nc")
    with open(os.path.join(source, "options.toml"), "w", encoding="ascii") as file:
        file.write('[cvt]\ncells = 162\nstart = "continuation"\niterations = 4\n')
    parallel = ["--regions", "6", "--threads", "2"]
    yield "delaunay", ["delaunay", "p.txt", "-o", "o.vtp", *parallel], ["p.txt"], {}
    yield "delaunay to mpas", ["delaunay", "p.txt", "-o", "o.nc", *parallel], ["p.txt"], {}
    yield "cvt", [*run, "-o", "g.nc"], [], {"resumed": "c"}
    yield "cvt over checkpoint", [*run, "--report", "r.json", "-o", "g.nc"], ["c"], {"resumed": "c",
                                                                                    "volatile": ["r.json"]}
    yield "cvt --resume", ["cvt", "--resume", "c", "--checkpoint", "c", "-o", "g.nc"], ["c"], {"resumed": "c"}
    yield "cvt --config", ["cvt", "--config", "options.toml", "-o", "g.nc"], ["options.toml"], {}
    for name, output in FORMATS.items():
        yield f"convert to {name}", ["convert", "m.nc", output, "--format", name], ["m.nc"], {}
    yield "convert large", ["convert", "large.nc", "o.nc"], ["large.nc"], {}
    for name, output in FORMATS.items():
        if name in ("triangles", "mpi-scvt"):  # without points
            continue
        files = ["nod2d.out", "elem2d.out"] if name == "fesom" else [name + os.path.splitext(output)[1]]
        make("convert", "m.nc", files[0], "--format", name)
        yield f"convert from {name}", ["convert", files[0], "p.geojson"], files, {}


def main():
    wrong, rows = [], []
    with tempfile.TemporaryDirectory() as source, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, arguments, inputs, more in commands(source):
            if ONLY not in name:
                continue
            command = Command(name, arguments, source, inputs, **more)
            results = list(pool.map(lambda kind, c=command: sweep(c, kind), kinds_of(command)))
            codes = dict(zip(kinds_of(command), (codes for codes, _ in results)))
            rows.append((name, [codes.get(kind, {}) for kind in KINDS]))
            wrong += [line for _, lines in results for line in lines]
            print_row(rows[-1])
    print(f"{sum(sum(codes.values()) for _, row in rows for codes in row)} faults, {len(wrong)} findings")
    for line in wrong:
        print(f"FAILED: {line}")
    sys.exit(bool(wrong))


def print_row(row, head=[True]):
    """A row of the table; each entry has the runs that met the fault and succeeded, and those that ended with exit
    code 2, 3 or 4."""
    if head.pop() if head else False:
        print("| command | " + " | ".join(KINDS) + " |\n| --- |" + " --: |" * len(KINDS))
    name, entries = row
    print(f"| {name} | " + " | ".join(
        "/".join(str(codes.get(code, 0)) for code in (0, 2, 3, 4)) for codes in entries) + " |", flush=True)


if __name__ == "__main__":
    main()
