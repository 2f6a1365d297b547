# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells and tables of Markdown."""

from reporting.samples import is_disturbed, quantile

NONE = "-"


def seconds_text(value):
    digits = 6 if value < 0.01 else 5 if value < 0.1 else 4 if value < 1 else 3 if value < 10 else 2
    return f"{value:.{digits}f}"


def spread_text(values, digits=2):
    """The median and, in brackets, the quartiles."""
    low, middle, high = (quantile(values, p) for p in (0.25, 0.5, 0.75))
    return f"{middle:.{digits}f} ({low:.{digits}f} - {high:.{digits}f})"


def refused(text, disturbed):
    """The text for a row that was measured while the machine was disturbed."""
    return f"disturbed: {text}" if disturbed else text


def values_cell(values, rows, digits=2):
    """Values with their spread; rows: those that they are made of."""
    return refused(spread_text(values, digits), is_disturbed(values, rows))


def ratio_cell(row, base, digits=2):
    """How many times longer a row takes than another."""
    return values_cell(row.ratios(base), (row, base), digits) if row and base else NONE


def seconds_cell(row):
    return seconds_text(row.median()) if row else NONE


def percent(value):
    return f"{100 * value:.1f}%"


def table(heads, rows):
    """Markdown; the first column is text, the others numbers."""
    lines = ["| " + " | ".join(heads) + " |", "| --- |" + " --: |" * (len(heads) - 1)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def sites_text(sites):
    return f"{sites:,}".replace(",", " ")
