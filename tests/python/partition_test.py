# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of cells for the processes of a model."""
import numpy as np
import pytest

import calotte


def graph_of(path):
    with open(path) as file:
        next(file)
        return [[int(word) - 1 for word in line.split()] for line in file]


def pieces(graph, part):
    seen, count = set(), 0
    for start in range(len(graph)):
        if start in seen:
            continue
        count += 1
        stack = [start]
        seen.add(start)
        while stack:
            cell = stack.pop()
            for other in graph[cell]:
                if other not in seen and part[other] == part[cell]:
                    seen.add(other)
                    stack.append(other)
    return count


def test_of_a_mesh_and_of_a_file(tmp_path):
    mesh = calotte.delaunay(calotte.fibonacci_sphere(900))
    part = calotte.partition(mesh, 7)
    assert part.dtype == np.int32 and part.shape == (900,)
    calotte.write(tmp_path / "global.nc", mesh)  # whose cells have other numbers
    graph = graph_of(tmp_path / "global.graph.info")
    part = calotte.partition(calotte.read(tmp_path / "global.nc"), 7)
    assert len(part) == len(graph) and pieces(graph, part) == 7
    calotte.cut(tmp_path / "global.nc", tmp_path / "area.nc", calotte.circle((10, 20), "40deg"),
                rings=2)
    area = calotte.read(tmp_path / "area.nc")
    graph = graph_of(tmp_path / "area.graph.info")
    part = calotte.partition(area, 5)
    assert len(part) == len(graph) and pieces(graph, part) == 5


def test_weights():
    mesh = calotte.delaunay(calotte.fibonacci_sphere(900))
    weights = np.where(mesh.points[:, 2] > 0, 3, 0.5)
    sums = np.bincount(calotte.partition(mesh, 6, weights=weights), weights)
    assert sums.max() <= 1.03005 * weights.sum() / 6 + 3
    assert not calotte.partition(mesh, 1).any()


def test_bad_arguments():
    mesh = calotte.delaunay(calotte.fibonacci_sphere(50))
    with pytest.raises(calotte.Error, match="50 cells cannot make 51 parts"):
        calotte.partition(mesh, 51)
    with pytest.raises(calotte.Error, match="weight of cell 3 is nan"):
        calotte.partition(mesh, 2, weights=np.where(np.arange(50) == 3, np.nan, 1))
    with pytest.raises(calotte.Error, match="49 weights, but 50 cells"):
        calotte.partition(mesh, 2, weights=np.ones(49))
    with pytest.raises(calotte.Error, match="no weights"):
        calotte.partition(mesh, 2, weights=[])
    with pytest.raises(calotte.Error, match="shape"):
        calotte.partition(mesh, 2, weights=np.ones((50, 2)))
