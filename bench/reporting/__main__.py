# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the steps, keeps their samples, and composes the report from the kept samples."""

import argparse
import json
import shutil
import subprocess
import sys
import time
from datetime import datetime, timezone
from pathlib import Path

from reporting import document, machine, plan
from reporting.makespan import Network
from reporting.samples import MOST_OTHERS, BadSamples, Results

PROJECT = Path(__file__).resolve().parents[2]


def say(line):
    print(f"report: {line}", file=sys.stderr, flush=True)


def is_done(kept, step, commit):
    """Whether this very step was run on this very commit and machine."""
    if kept is None or commit.endswith("+"):
        return False
    made = (kept.commit, kept.command, kept.machine)
    return made == (commit, step.command, machine.describe())


def run(step, programs, commit, file, runs):
    """Runs one step of programs of that commit; its samples go to the file when it is over.

    runs: those before.
    """
    watch, date = machine.Watch(), datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M")
    raw, log = file.with_suffix(".part"), file.with_suffix(".log")
    raw.unlink(missing_ok=True)  # of a report that was interrupted
    with open(log, "w", encoding="utf-8") as out:
        done = subprocess.run(
            [programs / f"{step.program}_bench", *step.arguments, "--json", raw],
            stdout=out,
            stderr=subprocess.STDOUT,
            check=False,
        )
    if not raw.exists():
        sys.exit(f"report: {step.command} failed, see {log}")
    if done.returncode != 0:
        say(f"{step.name}: a result was wrong, see {log}; the report omits its rows")
    others = watch.others()
    if others > MOST_OTHERS:
        say(f"{step.name}: disturbed: other programs took {others:.0%} of all cores")
    kept = {
        "name": step.name,
        "section": step.section,
        "command": step.command,
        "commit": commit,
        "machine": machine.describe(),
        "date": date,
        "runs": runs + 1,
        "seconds": watch.seconds(),
        "others": others,
        "output": json.loads(raw.read_text()),
    }
    raw.write_text(json.dumps(kept, indent=1))
    raw.replace(file)


def run_all(options, raw):
    """The samples of the steps; with --resume, existing samples are included."""
    commit = machine.commit()
    everything = options.sections == tuple(plan.SECTIONS) and not options.steps
    if everything and not options.resume:
        for old in raw.glob("*.json"):
            old.unlink()
    kept = Results.load(raw).steps
    started = time.monotonic()
    for number, step in enumerate(options.todo, 1):
        file = raw / f"{step.name}.json"
        before = kept.get(step.name)
        if options.resume and is_done(before, step, commit):
            say(f"{number}/{len(options.todo)} {step.name}: kept")
            continue
        say(f"{number}/{len(options.todo)} {step.name} ({time.monotonic() - started:.0f} s so far)")
        run(step, options.programs, commit, file, before.runs if before else 0)
    say(f"{len(options.todo)} steps in {time.monotonic() - started:.0f} s")


def names(text):
    return tuple(text.split(","))


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="bench/report", description="Runs the benchmarks and writes their report."
    )
    parser.add_argument("--quick", action="store_true", help="few rounds, no large sets")
    parser.add_argument(
        "--sections",
        type=names,
        default=tuple(plan.SECTIONS),
        help="run only these sections, separated by commas: " + ", ".join(plan.SECTIONS),
    )
    parser.add_argument(
        "--steps", type=names, default=(), help="run only these steps, separated by commas; the report names them"
    )
    parser.add_argument("--resume", action="store_true", help="keep the samples of steps that this commit has run on this machine")
    parser.add_argument("--tables", action="store_true", help="run nothing; compose the report from the kept samples")
    parser.add_argument("--publish", action="store_true", help="copy RESULTS.md and the plots to bench/")
    parser.add_argument("--out", type=Path, help="output folder; default: bench-report, with --quick bench-report/quick")
    parser.add_argument("--latency", type=float, default=2e-6, help="latency of the modelled network in s; default: 2e-6")
    parser.add_argument("--bandwidth", type=float, default=10e9, help="bandwidth of the modelled network in bytes/s; default: 1e10")
    parser.add_argument("--programs", type=Path, default=PROJECT / "build/bench/bench")
    options = parser.parse_args(arguments)
    try:
        options.todo = plan.steps(
            machine.threads(), options.quick, options.sections, options.steps
        )
    except LookupError as error:
        parser.error(error.args[0])
    options.out = options.out or PROJECT / "bench-report" / ("quick" if options.quick else "")
    return options


def main(arguments):
    options = parse(arguments)
    raw = options.out / "raw"
    try:
        if not options.tables:
            raw.mkdir(parents=True, exist_ok=True)
            run_all(options, raw)
        results = Results.load(raw)
    except BadSamples as error:
        sys.exit(f"report: {error}")
    if not results.steps:
        sys.exit(f"report: {raw} holds no samples; run bench/report without --tables")
    network = Network(options.latency, options.bandwidth)
    document.write(results, network, options.out)
    say(f"{options.out / 'RESULTS.md'}")
    if options.publish:
        shutil.copy(options.out / "RESULTS.md", PROJECT / "bench")
        shutil.rmtree(PROJECT / "bench/plots", ignore_errors=True)
        shutil.copytree(options.out / "plots", PROJECT / "bench/plots")
    for failure in results.failures():
        say(f"WRONG: {failure}")
    return 1 if results.failures() else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
