# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells and tables of Markdown."""

from reporting.samples import is_disturbed, quartiles

NONE = "-"


def seconds_text(value):
    digits = 6 if value < 0.01 else 5 if value < 0.1 else 4 if value < 1 else 3 if value < 10 else 2
    return f"{value:.{digits}f}"


def refused(text, disturbed):
    """The text for a row that was measured while the machine was disturbed."""
    return f"disturbed: {text}" if disturbed else text


def values_cell(values, rows, digits=2):
    """The median and, in brackets, the quartiles; rows: those that the values are made of."""
    low, middle, high = (f"{value:.{digits}f}" for value in quartiles(values))
    return refused(f"{middle} ({low} - {high})", is_disturbed(values, rows))


def ratio_cell(row, base):
    """How many times longer a row takes than another."""
    if row is base:
        return "1"
    return values_cell(row.ratios(base), (row, base)) if row and base else NONE


def percent(value):
    return f"{100 * value:.1f}%"


def sites_text(sites):
    return f"{sites:,}".replace(",", " ")


def set_text(row):
    return f"{row.set}, {sites_text(row.sites)}"


def table(heads, rows):
    """Markdown; the first column is text, the others numbers."""
    lines = [heads, ["---"] + ["--:"] * (len(heads) - 1), *rows]
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in lines)


def compared(rows, base, columns):
    """Rows, and how many times longer they take than the one called base of the same step and set, if
    there is one. columns: of further heads a function of a row."""
    bases = {(row.step, row.set, row.sites): row for row in rows if row.name == base}
    if bases:
        ratio = lambda row: ratio_cell(row, bases.get((row.step, row.set, row.sites)))
        columns = {f"time / {base}": ratio} | columns
    return table(
        ["sites", "run", "rounds", "median s", *columns],
        [
            [set_text(row), row.name, len(row.seconds), seconds_text(row.median())]
            + [column(row) for column in columns.values()]
            for row in rows
        ],
    )
