# SPDX-License-Identifier: GPL-3.0-or-later
"""The first lines of RESULTS.md: the programs compared, the machine, and the main results."""

from reporting.cells import NONE

SUMMARY = """\
Calotte, compared with serial programs on the same sites: {peers}.

- Machine: {processor}; {threads} threads; {memory}; {system}.
- Build: {compiler}; commit {commits}; {dates}.
- Thresholds: {verdict}."""


def verdict(lines):
    """How many thresholds are met, and which are not."""
    lines = [line for line in lines if line.threshold != NONE]
    if not lines:
        return "none was measured"
    met = [line for line in lines if line.met.startswith("yes")]
    if len(met) == len(lines):
        return f"all {len(lines)} are met"
    missed = "; ".join(f"{line.what} ({line.met})" for line in lines if line not in met)
    return f"{len(met)} of {len(lines)} are met. Not met: {missed}"


def summary(facts, lines):
    """Markdown of at most twenty lines; facts: texts by name; lines: of all requirements."""
    text = SUMMARY.format(verdict=verdict(lines), **facts)
    main = [line for line in lines if line.main]
    if main:
        text += "\n\nMain results, medians with quartiles in brackets:\n\n"
        text += "\n".join(f"- {line.what}: {line.measured}" for line in main)
    return text
