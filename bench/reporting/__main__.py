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
PROGRAMS = PROJECT / "build/release/bench"


def say(line):
    print(f"report: {line}", file=sys.stderr, flush=True)


def run(step, commit, file, runs):
    """Runs one step; its samples go to the file when it is over.

    runs: those before.
    """
    watch, date = machine.Watch(), datetime.now(timezone.utc).strftime("%Y-%m-%d %H:%M")
    raw, log = file.with_suffix(".part"), file.with_suffix(".log")
    raw.unlink(missing_ok=True)  # of a report that was interrupted
    with open(log, "w", encoding="utf-8") as out:
        done = subprocess.run(
            [PROGRAMS / f"{step.program}_bench", *step.arguments, f"--benchmark_out={raw}"],
            stdout=out,
            stderr=subprocess.STDOUT,
            check=False,
        )
    try:
        output = json.loads(raw.read_text(encoding="utf-8"))
        del output["context"]["host_name"], output["context"]["executable"]
    except (OSError, ValueError):
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
        "output": output,
    }
    raw.write_text(json.dumps(kept, indent=1), encoding="utf-8")
    raw.replace(file)


def run_all(options, raw):
    """Runs the steps."""
    commit = machine.commit()
    if not options.sections and not options.steps:
        for old in raw.glob("*.json"):
            old.unlink()
    kept = Results.load(raw).steps
    started = time.monotonic()
    for number, step in enumerate(options.todo, 1):
        file = raw / f"{step.name}.json"
        before = kept.get(step.name)
        say(f"{number}/{len(options.todo)} {step.name} ({time.monotonic() - started:.0f} s so far)")
        run(step, commit, file, before.runs if before else 0)
    say(f"{len(options.todo)} steps in {time.monotonic() - started:.0f} s")


def names(text):
    return tuple(text.split(","))


def parse(arguments):
    parser = argparse.ArgumentParser(
        prog="bench/report", description="Runs the benchmarks and writes their report."
    )
    add = parser.add_argument
    add("--quick", action="store_true", help="few rounds, no large sets")
    add("--figures", action="store_true", help="also run what the figures show, and draw them")
    add("--sections", type=names, default=(), metavar="A,B",
        help="run only these sections: " + ", ".join(plan.SECTIONS))
    add("--steps", type=names, default=(), metavar="A,B", help="run only these steps; the report names them")
    add("--tables", action="store_true", help="run nothing; compose the report from the kept samples")
    add("--publish", action="store_true", help="copy RESULTS.md to bench/")
    add("--out", type=Path, help="output folder; default: bench-report, with --quick bench-report/quick")
    options = parser.parse_args(arguments)
    every = plan.TABLES + (plan.FIGURES if options.figures or options.steps else ())
    sections = options.sections or tuple(make.__name__ for make in every)
    try:
        options.todo = plan.steps(machine.threads(), options.quick, sections, options.steps)
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
    file = options.out / "RESULTS.md"
    file.write_text(document.compose(results), encoding="utf-8")
    say(file)
    if options.figures:
        from reporting import plots  # needs matplotlib

        plots.draw_all(results, Network(), options.out / "figures")
        say(options.out / "figures")
    if options.publish:
        shutil.copy(file, PROJECT / "bench")
    for failure in results.failures:
        say(f"WRONG: {failure}")
    return 1 if results.failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
