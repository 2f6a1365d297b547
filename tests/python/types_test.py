# SPDX-License-Identifier: GPL-3.0-or-later
"""The types of the package: its .pyi file is that of the compiled part, and a checker understands it."""
import ast
import pathlib
import subprocess
import sys

import pytest

import calotte

pytest.importorskip("mypy")

PROGRAM = """\
import calotte

grid = calotte.cvt(642, density="x8", progress=lambda now: now["residual"] < 1e-3)
cells = calotte.voronoi(grid.mesh)
total: float = float(cells.cell_area.sum())
mesh = calotte.delaunay([(0.0, 0.0, 1.0)] * 4, regions=2)
area: float = mesh.surface.widened(0.1).area
passed: bool = calotte.check(mesh).passed
channel = calotte.cvt(cell_width=0.1, surface=calotte.periodic_box(2, 1), walls="y", start="random")
actions: int = len(calotte.plan(cells=162, iterations=3).actions)
nearest: int = int(calotte.locate(mesh, [(0.0, 90.0)]).nearest[0])
finer = calotte.refine(grid.mesh, region="circle=10,50,1000km", factor=2, nearest="kind")
added: int = finer.patches[0].added + len(finer.mesh) + int(finer.new_of_old[0])
sums: float = float(calotte.interpolation_weights(mesh, calotte.raster(12, 6)).apply([1.0] * 4).sum())
sea = calotte.generalised_sea(["land.geojson"], "100km", passages=[[(180.0, 0.0), (-155.0, 0.0)]], seeds=(0.0, 0.0))
closed: float = sea.parts[0].area + sea.displacement + calotte.plan(100, surface=sea).cells
sea.sea.write("sea.geojson")
mean: float = float(calotte.interpolate(mesh, [1.0] * 4, [(0.0, 90.0)], method="natural").mean())
"""


def mypy(folder, *words):
    site = pathlib.Path(calotte.__file__).parents[1]
    return subprocess.run([sys.executable, *words], capture_output=True, text=True, cwd=folder,
                          env={"MYPYPATH": str(site), "PYTHONPATH": str(site), "PATH": "/usr/bin",
                               "MYPY_CACHE_DIR": str(folder)})


def test_the_types_are_those_of_the_module():
    declared = ast.parse((pathlib.Path(calotte.__file__).parent / "_calotte.pyi").read_text())
    names = {}
    for node in declared.body:
        if isinstance(node, ast.FunctionDef):
            names[node.name] = None
        elif isinstance(node, ast.AnnAssign) and not node.target.id.startswith("_"):
            names[node.target.id] = None
        elif isinstance(node, ast.ClassDef):
            names[node.name] = {part.target.id if isinstance(part, ast.AnnAssign) else part.name
                                for part in node.body
                                if isinstance(part, (ast.AnnAssign, ast.FunctionDef))}
    module = calotte._calotte
    assert set(names) == {name for name in vars(module) if not name.startswith("_")}
    for name, members in names.items():
        if members is not None:
            assert all(hasattr(getattr(module, name), member) for member in members), name
            public = {word for word in vars(getattr(module, name)) if not word.startswith("_")}
            assert public <= members | {"name", "value"}, name


def test_a_checker_understands_programs(tmp_path):
    (tmp_path / "good.py").write_text(PROGRAM)
    result = mypy(tmp_path, "-m", "mypy", "good.py")
    assert result.returncode == 0, result.stdout
    (tmp_path / "bad.py").write_text(PROGRAM.replace("642", "'many cells', 7"))
    result = mypy(tmp_path, "-m", "mypy", "bad.py")
    assert result.returncode == 1 and "bad.py:3" in result.stdout
