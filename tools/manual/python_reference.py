# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the page of the manual that lists functions and attributes: from their documentation.

    PYTHONPATH=SITE python3 tools/manual/python_reference.py >tools/manual/python-reference.md

A test compares the page with what this prints.
"""
import dataclasses
import inspect
import re
import textwrap

import calotte
from calotte import _calotte, widths

GROUPS = [
    ("Triangulations and cells", ["delaunay", "voronoi", "check", "quality", "gates", "operator_errors",
                                  "neighbours", "locate", "cells_at", "area_weights", "interpolate", "interpolate_scattered",
                                  "threads"]),
    ("From one grid to another", ["raster", "interpolation_weights", "read_weights"]),
    ("Grids", ["cvt", "plan", "refine", "coarsen", "rotate", "limited_area", "multimesh", "density"]),
    ("Points", ["random_points", "fibonacci_sphere", "spiral_sphere", "geodesic_sphere",
                "bisected_icosahedron", "lat_lon_sphere", "cubed_sphere", "hexagonal_lattice",
                "bisect", "from_lonlat", "to_lonlat"]),
    ("Surfaces", ["circle", "ellipse", "box", "channel", "polygon", "rectangle", "plane", "periodic_box",
                  "planar_polygon", "generalised_sea"]),
    ("Files", ["read", "read_fields", "read_points", "write", "cut", "cull", "partition"]),
]
WIDTHS = ["by_latitude", "by_distance", "around", "by_channel", "by_depth", "minimum", "maximum", "sum", "where", "blend", "share", "rule"]
KINDS = ["Mesh", "Surface", "IdLists", "Polygons", "PolygonShapes", "Raster", "Weights", "Voronoi", "Locations", "Locator", "Cvt", "Action", "Plan", "Multimesh", "ChangedMesh", "ChangedPatch", "GeneralisedSea", "ClosedSea", "Quality",
         "Unit", "Range", "Percentiles", "Check", "OperatorErrors", "ErrorNorms", "Gate", "Density", "CellWidth", "Widths", "Error"]


def escaped(text):
    """Text for a paragraph or a cell of a table in Markdown."""
    text = re.sub(r"\s+", " ", text).strip()
    for sign in "\\<>|*_[]^":
        text = text.replace(sign, f"\\{sign}" if sign not in "<>" else
                            {"<": "&lt;", ">": "&gt;"}[sign])
    return text


def signature(name, function):
    plain = re.sub(r"(: |-> )'([^']*)'", r"\1\2", str(inspect.signature(function)))
    call = f"{name}{plain}"
    if len(call) <= 90:
        return call
    inner, returned = re.fullmatch(r"\((.*)\)( -> .*)?", plain).groups()
    parts = re.split(r", (?![^\[(]*[\])])", inner)
    lines = textwrap.wrap(", ".join(part.replace(" ", "\0") for part in parts), 90,
                          break_long_words=False)
    body = "\n".join("    " + line.replace("\0", " ") for line in lines)
    return f"{name}(\n{body}\n){returned or ''}"


def documented(text):
    """The lines of a docstring without its examples."""
    return inspect.cleandoc(text).split(">>>")[0].rstrip()


def wrapped(text, width=90):
    """Paragraphs and indented descriptions of arguments, in lines that fit the page."""
    lines = []
    for paragraph in documented(text).split("\n\n"):
        items = []
        for line in paragraph.split("\n"):
            if items and (line.startswith(" ") or not re.match(r"\w+(, \w+)*: |Returns", line)):
                items[-1] += " " + line.strip()
            else:
                items.append(line)
        for item in items:
            named = re.match(r"\w+(, \w+)*: ", item)
            lines += textwrap.wrap(item, width, subsequent_indent="    " if named else "",
                                   break_long_words=False, break_on_hyphens=False)
        lines.append("")
    return "\n".join(lines).rstrip()


def function_lines(name, function):
    return [f"### {name}", "", "```text", signature(name, function), "",
            wrapped(function.__doc__), "```", ""]


def attributes(kind):
    """Names and descriptions; of a dataclass those of its docstring."""
    if dataclasses.is_dataclass(kind):
        items = wrapped(kind.__doc__, 10**6).split("\n\n", 1)[1].split("\n")
        return [tuple(item.split(": ", 1)) for item in items]
    return [(name, member.__doc__) for name, member in vars(kind).items()
            if isinstance(member, property) and not name.startswith("_")]


def methods(kind):
    found = []
    for name, member in vars(kind).items():
        if name.startswith("_") or isinstance(member, property) or not callable(member):
            continue
        about = documented(getattr(kind, name).__doc__).split("\n\n")
        is_signature = about[0].startswith(f"{name}(") and len(about) > 1
        found.append((f"{name}()", about[is_signature]))
    return found


def kind_lines(name):
    kind = getattr(calotte, name, None) or getattr(_calotte, name)
    about = documented(kind.__doc__)
    if dataclasses.is_dataclass(kind):
        about = about.split("\n\n")[0]
    lines = [f"### {name}", "", escaped(about), ""]
    rows = attributes(kind) + methods(kind)
    if rows:
        lines += ["| attribute | what it is |", "| --- | --- |"]
        lines += [f"| `{attribute}` | {escaped(doc)} |" for attribute, doc in rows]
        lines.append("")
    return lines


def page():
    lines = ["# Python, by name", "",
             "Lengths on the sphere are radians and areas steradians of the unit sphere; cell widths "
             "are km. Arrays",
             "of points have a row a point. [Python](python.md) has examples.", ""]
    for title, names in GROUPS:
        lines += [f"## {title}", ""]
        for name in names:
            lines += function_lines(name, getattr(calotte, name))
    lines += ["## Rules for widths", "", "Of the module `calotte.widths`; see [Cell widths](cell-widths.md).", ""]
    for name in WIDTHS:
        lines += function_lines(name, getattr(widths, name))
    lines += ["## Types", ""]
    for name in KINDS:
        lines += kind_lines(name)
    lines += ["### plot", "", "Of Mesh, Polygons and Cvt.", "", "```text",
              signature("plot", calotte.Mesh.plot), "", wrapped(calotte.Mesh.plot.__doc__),
              "```"]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(page(), end="")
