# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges between nodes as other packages take them."""
import numpy as np

from ._calotte import Error


def _needed(name, what):
    raise Error(f"{what} needs {name}; install it, on Debian python3-{name}, or pip install {name}") from None


def sparse(sources, targets, size):
    """A scipy.sparse.csr_array of ones."""
    try:
        from scipy.sparse import csr_array
    except ImportError:
        _needed("scipy", "to_scipy_sparse()")
    return csr_array((np.ones(len(sources)), (sources, targets)), shape=(size, size))


def graph(pairs, size):
    """A networkx.Graph of pairs of nodes."""
    try:
        from networkx import Graph
    except ImportError:
        _needed("networkx", "to_networkx()")
    made = Graph()
    made.add_nodes_from(range(size))
    made.add_edges_from(pairs.tolist())
    return made


def frame(features):
    """A geopandas.GeoDataFrame of features of GeoJSON."""
    try:
        from geopandas import GeoDataFrame
    except ImportError:
        _needed("geopandas", "to_geodataframe()")
    return GeoDataFrame.from_features(features, crs=4326)
