# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of the manual that lists functions and attributes is that of their documentation."""
import importlib.util
import pathlib

import calotte

ROOT = pathlib.Path(__file__).resolve().parents[2]


def reference():
    spec = importlib.util.spec_from_file_location("reference", ROOT / "tools/manual/python_reference.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_that_of_the_package():
    page = (ROOT / "tools/manual/python-reference.md").read_text()
    assert page == reference().page(), "run tools/manual/python_reference.py, as its first lines say"


def test_the_page_lists_all_names():
    module = reference()
    listed = {name for _, names in module.GROUPS for name in names} | set(module.KINDS)
    assert set(module.WIDTHS) == set(calotte.widths.__all__) - {"Widths"}
    assert listed == set(calotte.__all__) - {"__version__", "widths"} | {"Range", "Percentiles", "ErrorNorms",
                                                              "PolygonShapes"}
