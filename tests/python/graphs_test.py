# SPDX-License-Identifier: GPL-3.0-or-later
"""Nested nodes, and edges from and to them."""
import math
import pickle
import subprocess
import sys

import numpy as np
import pytest

import calotte

WIDTHS = calotte.widths.by_latitude([(-90, 400), (0, 800), (90, 400)])


@pytest.fixture(scope="module")
def six():
    return calotte.multimesh(6)


@pytest.fixture(scope="module")
def graded():
    return calotte.multimesh(2, cell_width=WIDTHS, coarsest=200)


@pytest.fixture(scope="module")
def region():
    return calotte.multimesh(2, cell_width=120, surface=calotte.circle((10, 50), "1500km"))


def is_edge_index(edges):
    return edges.dtype == np.int64 and edges.ndim == 2 and len(edges) == 2 and edges.flags.c_contiguous


def pairs(edges):
    return set(map(tuple, edges.T.tolist()))


def check_edges(made):
    every = set()
    for level, mesh in enumerate(made.meshes):
        edges = made.edges(level)
        assert is_edge_index(edges)
        assert (np.lexsort(edges[::-1]) == np.arange(edges.shape[1])).all()
        found = pairs(edges)
        assert len(found) == edges.shape[1] and found == {(b, a) for a, b in found}
        around = calotte.neighbours(mesh)
        assert found == {(i, int(j)) for i in range(len(mesh)) for j in around[i]}
        assert (mesh.points == made.points[:made.level_sizes[level]]).all()
        every |= found
    assert is_edge_index(made.edges()) and pairs(made.edges()) == every and made.edges().shape[1] == len(every)


def test_the_counts_of_graphcast(six):
    assert six.level_sizes == (12, 42, 162, 642, 2562, 10242, 40962) and len(six) == 40962
    assert is_edge_index(six.edges()) and six.edges().shape == (2, 327660)
    assert [six.edges(level).shape[1] for level in range(7)] == [60 * 4**level for level in range(7)]
    assert six.points.shape == (40962, 3) and six.lonlat.shape == (40962, 2) and six.converged == ()
    assert six.mesh() is six.mesh(6) is six.meshes[6]
    assert repr(six) == ("<calotte.Multimesh: 7 levels of 12, 42, 162, 642, 2562, 10242, 40962 nodes, "
                         "163830 edges>")
    assert sorted(map(tuple, six.points)) == sorted(map(tuple, calotte.bisected_icosahedron(6)))
    middles = six.points[six.parents[12:]].sum(axis=1)
    assert np.allclose(middles / np.linalg.norm(middles, axis=1, keepdims=True), six.points[12:], atol=1e-15)
    assert (six.parents[:12] == -1).all()


def test_edges_are_those_of_the_meshes(graded, region):
    check_edges(calotte.multimesh(3, coarsest=72))
    check_edges(graded)
    check_edges(region)
    check_edges(calotte.multimesh(1, points=calotte.fibonacci_sphere(50)))
    check_edges(calotte.multimesh(2, cells=1000, surface=calotte.rectangle((0, 0), (2, 1))))


def test_meshes_are_delaunay(graded):
    for mesh in graded.meshes:
        assert (mesh.triangles == calotte.delaunay(graded.points[:len(mesh)]).triangles).all()
    assert graded.level_sizes == (200, 794, 3170) and all(graded.converged)


def test_areas_follow_the_widths_at_every_level(graded):
    for mesh in graded.meshes:
        latitudes = mesh.lat
        widths = 800 - 400 * np.abs(latitudes) / 90
        ratio = calotte.voronoi(mesh).cell_area / widths**2
        ratio /= np.median(ratio)
        bins = np.array_split(np.argsort(widths), 5)
        assert max(abs(np.median(ratio[k]) - 1) for k in bins) < 0.06
        assert np.quantile(ratio, 0.01) > 0.75 and np.quantile(ratio, 0.99) < 1.25


def test_one_and_two_threads_give_the_same_bits(graded):
    with calotte.threads(1):
        alone = calotte.multimesh(2, cell_width=WIDTHS, coarsest=200)
    assert (alone.points == graded.points).all() and (alone.edges() == graded.edges()).all()
    again = pickle.loads(pickle.dumps(graded))
    assert (again.points == graded.points).all() and (again.edges(1) == graded.edges(1)).all()


@pytest.mark.parametrize("name", ["graded", "region"])
def test_edges_from_and_to_points(request, name):
    made = request.getfixturevalue(name)
    points = calotte.random_points(150, None if name == "graded" else made.mesh().surface)
    distance = np.arccos(np.clip(points @ made.points.T, -1, 1))
    order = np.argsort(distance, axis=1)[:, :4]
    rows = np.repeat(np.arange(150), 4)
    encoder = made.encoder(points, k=4)
    assert is_edge_index(encoder) and (encoder == [rows, order.ravel()]).all()
    assert (made.decoder(calotte.to_lonlat(points), k=4) == [order.ravel(), rows]).all()
    for radius in (0.0, 0.03, 0.2):
        within = made.encoder(points, radius=radius)
        assert is_edge_index(within) and (within == np.nonzero(distance <= radius)).all()
    assert made.encoder(points, radius=math.pi).shape[1] == 150 * len(made)
    decoder = made.decoder(points)
    assert is_edge_index(decoder) and (np.diff(decoder[1]) >= 0).all()
    found = calotte.locate(made.mesh(), points)
    for i in range(150):
        corners = made.mesh().triangles[found.triangle[i]] if found.triangle[i] >= 0 else found.nearest[i]
        assert set(decoder[0, decoder[1] == i]) == set(np.atleast_1d(corners))
    assert (found.triangle >= 0).mean() > 0.95


def test_points_outside_of_a_region(region):
    away = np.vstack([region.points[5], -region.points[5]])
    decoder = region.decoder(away)
    assert decoder.shape == (2, 4) and (decoder[1] == [0, 0, 0, 1]).all()
    assert decoder[0, 3] == np.argmin(region.points @ region.points[5])


def test_empty_points(six):
    none = np.empty((0, 3))
    for edges in (six.encoder(none, k=3), six.encoder(none, radius=0.1), six.decoder(none), six.decoder(none, k=1)):
        assert is_edge_index(edges) and edges.shape == (2, 0)


def test_sparse_matrices():
    pytest.importorskip("scipy")
    made = calotte.multimesh(2)
    matrix = made.to_scipy_sparse()
    assert matrix.shape == (162, 162) and (matrix != matrix.T).nnz == 0 and matrix.nnz == made.edges().shape[1]
    assert made.to_scipy_sparse(0).shape == (12, 12) and made.to_scipy_sparse(0).sum() == 60
    from scipy.sparse.csgraph import connected_components
    assert connected_components(matrix)[0] == 1


def test_graphs_of_networkx():
    networkx = pytest.importorskip("networkx")
    made = calotte.multimesh(2)
    graph = made.to_networkx()
    assert networkx.is_connected(graph) and len(graph) == 162 and 2 * graph.number_of_edges() == made.edges().shape[1]
    assert len(made.to_networkx(0)) == 12


@pytest.mark.parametrize("module", ["scipy", "networkx"])
def test_missing_packages_are_named(module):
    program = (f"import sys; sys.modules['{module}'] = sys.modules['{module}.sparse'] = None; import calotte; "
               f"calotte.multimesh(1).to_{module}{'_sparse' if module == 'scipy' else ''}()")
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    last = run.stderr.strip().splitlines()[-1]
    assert last.startswith("calotte.Error: to_") and f"install it, on Debian python3-{module}" in last


def test_progress_of_each_level():
    seen = []
    made = calotte.multimesh(1, density="x4", coarsest=200, progress=lambda now: seen.append(now["cells"]))
    assert set(seen) >= {200, 794} and all(made.converged)
    with pytest.warns(UserWarning, match="level 0 did not converge"):
        calotte.multimesh(1, density="x4", coarsest=200, progress=lambda now: True)


def test_missing_memory_is_one_line():
    resource = pytest.importorskip("resource")
    program = "import calotte; calotte.multimesh(10)"
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (3 << 29, 3 << 29)))
    assert run.stderr.strip().splitlines()[-1] == ("MemoryError: the nodes and edges need more memory than there is; "
                                                   "give fewer levels or nodes")


@pytest.mark.parametrize("make, words", [
    (lambda six: calotte.multimesh(-1), "the finest level is -1; give 0 to 13"),
    (lambda six: calotte.multimesh(14), "the finest level is 14; give 0 to 13"),
    (lambda six: calotte.multimesh(10**30), "give 0 to 13"),
    (lambda six: calotte.multimesh(2.5), "the number of levels is 2.5; give a whole number"),
    (lambda six: calotte.multimesh(13, coarsest=162), "13 bisections of 162 nodes give more than 1073741824"),
    (lambda six: calotte.multimesh(1, coarsest=13), "no triangulation of 13 points"),
    (lambda six: calotte.multimesh(1, coarsest=0, cell_width=500), "the number of nodes of the coarsest level is 0"),
    (lambda six: calotte.multimesh(1, coarsest=100, cells=400), "give one of them"),
    (lambda six: calotte.multimesh(2, surface="circle=0,0,1000km"), "there is no number of nodes"),
    (lambda six: calotte.multimesh(4, cell_width=2000), "at the coarsest of 4 bisections"),
    (lambda six: calotte.multimesh(1, points=[[0, 0], [90, 0], [0, 90]], cell_width=100), "leave one of them out"),
    (lambda six: calotte.multimesh(1, points=np.full((12, 3), np.nan)), "point 0 has a coordinate that is NaN or infinite"),
    (lambda six: six.edges(7), "the level is 7; give 0 to 6"),
    (lambda six: six.edges(-1), "the level is -1; give 0 to 6"),
    (lambda six: six.encoder([(0, 0)]), "give k"),
    (lambda six: six.encoder([(0, 0)], k=2, radius=0.1), "give k"),
    (lambda six: six.encoder([(0, 0)], k=0), "k is 0; give 1 or more"),
    (lambda six: six.encoder([(0, 0)], k=1.5), "k is 1.5; give a whole number"),
    (lambda six: six.decoder([(0, 0)], k=40963), "k is 40963, and the mesh has 40962 sites"),
    (lambda six: six.encoder([(0, 0)], radius=3.2), "the distance is 3.2"),
    (lambda six: six.encoder([(0, 0)], radius="a"), "the radius must be numbers"),
    (lambda six: six.encoder([(0, 0)], radius=math.nan), "the distance is nan"),
    (lambda six: six.encoder([(0, 0), (math.nan, 1)], k=1), "point 1: longitude or latitude is not finite"),
    (lambda six: six.decoder([(0, 0, 0)]), "position 0 is the zero vector"),
    (lambda six: six.decoder([1, 2, 3]), "positions have the shape (3,)"),
])
def test_what_is_refused(six, make, words):
    with pytest.raises(calotte.Error) as refused:
        make(six)
    assert words in str(refused.value) and "\n" not in str(refused.value)
