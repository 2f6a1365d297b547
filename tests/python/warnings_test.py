# SPDX-License-Identifier: GPL-3.0-or-later
"""What falls short is said, as the command says it with its exit code."""
import json
import warnings

import numpy as np
import pytest

import calotte
from calotte import widths


def said(make):
    with warnings.catch_warnings(record=True) as record:
        warnings.simplefilter("always")
        made = make()
    assert all(warning.filename == __file__ for warning in record)  # where the user called
    return made, [str(warning.message) for warning in record]


def test_steep_widths_are_told():
    steep = widths.by_latitude([(0, 400), (20, 1500)])
    _, texts = said(lambda: calotte.cvt(cell_width=steep))
    assert [text for text in texts if text.startswith("the cell width changes by 0.49 km per km at longitude")]
    assert said(lambda: calotte.cvt(cell_width=steep.limit_gradient(0.03)))[1] == []
    assert said(lambda: calotte.cvt(cell_width=600))[1] == []
    # The number of cells scales the widths: of 16 times as many a quarter.
    gentle = widths.by_latitude([(0, 400), (90, 400 + 0.07 * 10007)])
    cells = calotte.plan(gentle).cells
    assert said(lambda: calotte.cvt(4 * cells, cell_width=gentle))[1] != []
    assert said(lambda: calotte.cvt(16 * cells, cell_width=gentle))[1] == []


def test_a_run_that_does_not_converge_is_told():
    grid, texts = said(lambda: calotte.cvt(642, method="lloyd", max_iterations=3, tolerance=1e-12, start="random"))
    assert not grid.converged and texts == ["not converged; increase max_iterations or the tolerance"]
    assert said(lambda: calotte.cvt(642, iterations=3))[1] == []


def test_shapes_beyond_the_limits_are_told():
    def jump(lon, lat):
        return np.where(np.hypot(lon - 40, lat) < 20, 150, 1200)
    grid, texts = said(lambda: calotte.cvt(cell_width=jump))
    assert grid.well_centred or any(text.startswith("not well-centred: ") for text in texts)
    assert any("the cell width changes by" in text for text in texts)


def test_passages_without_effect_are_told(tmp_path):
    calotte.write(tmp_path / "globe.nc", calotte.cvt(642).mesh)
    (tmp_path / "land.geojson").write_text(json.dumps(
        {"type": "Polygon", "coordinates": [[[0, 0], [60, 0], [60, 60], [0, 60], [0, 0]]]}))
    (tmp_path / "passages.geojson").write_text(json.dumps(
        {"type": "MultiLineString", "coordinates": [[[-20, 10], [10, 10]], [[35, 30], [36, 30]]]}))
    report, texts = said(lambda: calotte.cull(tmp_path / "globe.nc", tmp_path / "ocean.nc", land=tmp_path / "land.geojson",
                                              passages=tmp_path / "passages.geojson"))
    assert report["stranded_passages"] == [1]
    assert texts == ["passages on land only, without effect: 1; begin and end them in the sea"]


def test_a_change_that_falls_short_is_told():
    base = calotte.cvt(2562).mesh
    changed, texts = said(lambda: calotte.refine(base, region="circle=10,50,1500km", factor=1.5))
    assert texts == [] and changed.converged and changed.missed == 0
    part = calotte.delaunay(base.points[base.points[:, 2] > 0])
    changed, texts = said(lambda: calotte.refine(part, region="circle=10,2,1500km", factor=2))
    assert changed.held > 0
    assert f"{changed.held} cells stay as they are, against the demand, because they are at the boundary or next " \
           "to it" in texts
