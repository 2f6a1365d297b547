# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods of Mesh and PlanarMesh that are written in Python."""
import os
import tempfile

import numpy as np

from . import _calotte, _functions

_MOST_EDGES = 3000  # of a picture in a notebook


def _describe(mesh):
    kind = "Mesh" if isinstance(mesh, _calotte.Mesh) else "PlanarMesh"
    return f"<calotte.{kind}: {len(mesh)} sites, {len(mesh.triangles)} triangles>"


def _to_mpas(mesh, path, **options):
    """Writes a complete MPAS mesh and its graph.info; options as write()."""
    _functions.write(path, mesh, format="mpas", **options)


def _to_xarray(mesh, kind="mpas", **options):
    """The mesh as an xarray.Dataset of the conventions of MPAS or UGRID; options as write().

    It needs xarray and netCDF4.
    """
    import xarray
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.nc")
        _functions.write(path, mesh, format=kind, **options)
        return xarray.load_dataset(path)


def _topology(mesh):
    """The arguments of uxarray.Grid.from_topology for the Voronoi cells of the mesh."""
    cells = _functions.voronoi(mesh)
    degrees = np.diff(cells.begin)
    width, fill = int(degrees.max()), -1
    faces = np.full((len(degrees), width), fill, dtype=np.int64)
    faces[np.arange(width) < degrees[:, np.newaxis]] = cells.vertices_on_cell
    nodes = _functions.to_lonlat(cells.vertices)
    return {"node_lon": nodes[:, 0].copy(), "node_lat": nodes[:, 1].copy(),
            "face_node_connectivity": faces, "fill_value": fill, "start_index": 0}


# ---- A picture

def _seen(mesh):
    """x, y of the sites in the picture, and which of them it shows."""
    points = mesh.points
    if points.shape[1] == 2:
        low, high = points.min(axis=0), points.max(axis=0)
        return 2 * (points - low) / np.maximum(high - low, 1e-300).max() - 1, np.full(len(points), True)
    unit = points / np.linalg.norm(points, axis=1, keepdims=True)
    towards = np.array([1.0, 0.5, 0.6])
    if len(mesh) > _MOST_EDGES // 3:  # the part around the smallest triangle
        a, b, c = (unit[mesh.triangles[:, k]] for k in range(3))
        smallest = np.argmin(np.linalg.norm(np.cross(b - a, c - a), axis=1))
        towards = a[smallest]
    towards = towards / np.linalg.norm(towards)
    east = np.cross([0.0, 0.0, 1.0], towards)
    east = east / np.linalg.norm(east) if np.linalg.norm(east) > 1e-9 else np.array([0.0, 1.0, 0.0])
    north = np.cross(towards, east)
    height = unit @ towards
    count = min(len(mesh), max(12, _MOST_EDGES // 3))
    reach = np.partition(-height, count - 1)[count - 1]
    shown = (-height <= reach) & (height > 0)
    scale = 1 / max(1e-300, np.sqrt(1 - max(-reach, 0.0)**2))
    return scale * np.stack([unit @ east, unit @ north], axis=1), shown


def _edges(triangles):
    pairs = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                    triangles[:, [2, 0]]]), axis=1)
    return np.unique(pairs, axis=0)


def _repr_html(mesh):
    """A small picture of the triangles, for notebooks; of a large mesh its finest part."""
    places, shown = _seen(mesh)
    triangles = mesh.triangles[shown[mesh.triangles].all(axis=1)]
    edges = _edges(triangles)[:_MOST_EDGES]
    lines = "".join(f"M{a[0]:.3f} {-a[1]:.3f}L{b[0]:.3f} {-b[1]:.3f}"
                    for a, b in zip(places[edges[:, 0]], places[edges[:, 1]]))
    return (f'<figure><svg viewBox="-1.02 -1.02 2.04 2.04" width="240" height="240" role="img" '
            f'aria-label="triangles"><path d="{lines}" fill="none" stroke="currentColor" '
            f'stroke-width="0.004"/></svg><figcaption>{len(mesh)} sites, {len(mesh.triangles)} '
            f"triangles</figcaption></figure>")


for _class in (_calotte.Mesh, _calotte.PlanarMesh):
    _class.__repr__ = _describe
    _class._repr_html_ = _repr_html
    _class.to_mpas = _to_mpas
    _class.to_xarray = _to_xarray
_calotte.Mesh.topology = _topology
