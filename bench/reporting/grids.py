# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of grids from cell widths, out of the reports of calotte info --operators: shapes, and Calotte's
numbers over JIGSAW's with thresholds."""

import re

GENERAL = ["widths", "cells", "program"]
SHAPES = ["s", "ratio", "excess, %", "5- / 7-sided", "cell quality min, mean", "sigma mean",
          "triangle quality min", "angles, degrees", "obtuse", "dc/h min, max", "dv/dc min", "remark"]
ERRORS = {"divergence": "divergence", "gradient": "gradient", "laplacian": "Laplacian",
          "kinetic_energy": "kinetic energy", "tangential": "tangential velocity", "curl": "curl"}


def line(cells):
    return "| " + " | ".join(cells) + " |"


def head(columns):
    """The first lines of a table; all columns but words are numbers."""
    rules = ["---" if name in ("widths", "program", "remark") else "--:" for name in columns]
    return line(columns) + "\n" + line(rules)


def shapes_head():
    return head(GENERAL + SHAPES)


def spaced(count):
    return f"{count:,}".replace(",", " ")


def defects(info):
    """Cells that do not have six neighbours."""
    return sum(count for degree, count in info["degrees"].items() if degree != "6")


def remark(code, printed):
    """What calotte cvt says of a run that is less than well-centred: by its exit code, a warning of
    shapes, and how many generators its finish has moved from their centroids."""
    remarks = ["not converged"] if code == 1 else []
    if shape := re.search(r"the worst, (\S+) beyond,", printed):
        remarks.append(f"a shape {shape[1]} beyond its limit")
    if moved := re.search(r"(\d+) generators more than 0.01", printed):
        remarks.append(f"{moved[1]} generators displaced")
    return "; ".join(remarks)


def shapes_row(name, program, seconds, ratio, info, remark):
    degrees, fit = info["degrees"], info["dc_over_h"]
    angles, quality = info["angles"], info["cell_quality"]
    return line([name, spaced(info["cells"]), program, f"{seconds:.3g}",
                 "" if ratio is None else f"{ratio:.2f}", f"{100 * info['excess']:.3f}",
                 f"{degrees.get('5', 0)} / {degrees.get('7', 0)}",
                 f"{quality['min']:.3f}, {quality['mean']:.3f}", f"{info['sigma']['mean']:.3f}",
                 f"{info['triangle_quality']['min']:.3f}",
                 f"{angles['min']:.1f} - {angles['max']:.1f}", str(info["obtuse"]),
                 f"{fit['min']:.3f}, {fit['max']:.3f}", f"{info['dv_over_dc']['min']:.3f}", remark])


class Bound:
    """A number of the comparison with its threshold, of which it is on the right side or not."""

    def __init__(self, title, value, most=None, least=None):
        self.title, self.value = title, value
        self.met = (most is None or value <= most) and (least is None or value >= least)

    def text(self):
        text = str(self.value) if isinstance(self.value, int) else f"{self.value:.2f}"
        return text if self.met else f"**{text}**"


def bounds(name, ours, theirs, ratio):
    """What a grid of Calotte must show beside JIGSAW's of the same widths; all but the first three are
    ratios of both grids. The ratio given is that of JIGSAW's seconds over Calotte's."""
    mine, other = ours["operators"], theirs["operators"]

    def over(key, norm):
        return mine[key][norm] / other[key][norm]

    def fit(end):
        return ours["dc_over_h"][end] / theirs["dc_over_h"][end]

    result = [Bound("JIGSAW / Calotte", ratio, least=12.5 if name == "coast" else 20),
              Bound("obtuse", ours["obtuse"], most=0),
              Bound("dv/dc min", ours["dv_over_dc"]["min"], least=0.18),
              Bound("tangential l2", over("tangential", "l2"), most=0.5),
              Bound("tangential max", over("tangential", "max"), most=0.7)]
    result += [Bound(f"{ERRORS[key]} l2", over(key, "l2"), most=0.6)
               for key in ("divergence", "laplacian", "kinetic_energy")]
    result += [Bound(f"{title} max", over(key, "max"), most=1.0)
               for key, title in ERRORS.items() if key != "tangential"]
    result += [Bound("step of waves", mine["wave_step_times_speed"] / other["wave_step_times_speed"],
                     least=1.0),
               Bound("dual eigenvalue", mine["dual_eigenvalue"] / other["dual_eigenvalue"], most=1.02),
               Bound("dc/h min", fit("min"), least=1.0), Bound("dc/h max", fit("max"), most=1.0),
               Bound("excess", ours["excess"] / theirs["excess"], most=1.0),
               Bound("defects", defects(ours) / defects(theirs), most=1.0)]
    return result


def comparison(compared):
    """A table; compared: of each grid its name, our report, JIGSAW's, the seconds of both and the ratio
    of seconds. A number that misses its threshold is bold."""
    rows = []
    for name, ours, theirs, seconds, ratio in compared:
        found = bounds(name, ours, theirs, ratio)
        rows.append(line([name, spaced(ours["cells"])] + [f"{value:.3g}" for value in seconds]
                         + [bound.text() for bound in found]))
    titles = [bound.title for bound in found]
    return "\n".join([head(["widths", "cells", "Calotte, s", "JIGSAW, s"] + titles), *rows])
