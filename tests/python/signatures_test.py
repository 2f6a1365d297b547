# SPDX-License-Identifier: GPL-3.0-or-later
"""The drop-ins take every argument of the originals, by the same names and with the same defaults.

The originals' signatures are data here, each with its source and version; where an original is
installed, its signature is compared as well.
"""
import importlib
import inspect

import pytest

import calotte

#: github.com/scipy/scipy, scipy/spatial/_spherical_voronoi.py, version 1.10.1
SCIPY = ("scipy.spatial", "SphericalVoronoi", {
    "__init__": "(self, points, radius=1, center=None, threshold=1e-06)",
    "sort_vertices_of_regions": "(self)",
    "calculate_areas": "(self)",
})

#: github.com/underworldcode/stripy, stripy/spherical.py, commit f87add7 (version 2.3.4)
STRIPY = ("stripy", "sTriangulation", {
    "__init__": "(self, lons, lats, refinement_levels=0, permute=False, tree=False)",
    "areas": "(self)",
    "edge_lengths": "(self)",
    "face_midpoints": "(self, simplices=None)",
    "identify_segments": "(self)",
    "identify_vertex_neighbours": "(self, vertex)",
    "identify_vertex_triangles": "(self, vertices)",
    "nearest_vertices": "(self, lon, lat, k=1, max_distance=2.0)",
    "segment_midpoints": "(self, segments=None)",
    "segment_tripoints": "(self, ratio=0.33333)",
    "uniformly_refine_triangulation": "(self, faces=False, trisect=False)",
})

#: github.com/MPAS-Dev/MPAS-Tools, mpas_tools/mesh/creation/build_mesh.py, commit 897c66c (2.0.0)
MPAS_TOOLS = ("mpas_tools.mesh.creation.build_mesh", None, {
    "build_spherical_mesh": "(cellWidth, lon, lat, earth_radius, out_filename='base_mesh.nc', "
                            "plot_cellWidth=True, dir='./', logger=None)",
    "build_planar_mesh": "(cellWidth, x, y, geom_points, geom_edges, out_filename='base_mesh.nc', "
                         "logger=None)",
})

OURS = {"scipy.spatial": calotte.scipy, "stripy": calotte.stripy,
        "mpas_tools.mesh.creation.build_mesh": calotte.mpas_tools}
CASES = [(module, kind, name, signature) for module, kind, functions in (SCIPY, STRIPY, MPAS_TOOLS)
         for name, signature in functions.items()]


def holder(module, kind):
    return module if kind is None else getattr(module, kind)


@pytest.mark.parametrize("module, kind, name, signature", CASES)
def test_signatures(module, kind, name, signature):
    ours = holder(OURS[module], kind)
    assert str(inspect.signature(getattr(ours, name))) == signature
    try:
        original = holder(importlib.import_module(module), kind)
    except ImportError:
        return
    assert str(inspect.signature(getattr(original, name))) == signature


@pytest.mark.parametrize("kind", [calotte.scipy.SphericalVoronoi, calotte.stripy.sTriangulation])
def test_all_public_methods_are_listed(kind):
    """A method of ours that is no method of the original would be one that scripts cannot share."""
    listed = {**SCIPY[2], **STRIPY[2]}
    methods = {name for name, value in vars(kind).items()
               if inspect.isfunction(value) and not name.startswith("_")}
    assert methods <= set(listed)


def test_unknown_arguments_are_refused_as_the_originals_do():
    with pytest.raises(TypeError, match="jigsaw_options"):
        calotte.mpas_tools.build_spherical_mesh([[1]], [0], [0], 1.0, jigsaw_options={})
    with pytest.raises(TypeError, match="bounds"):
        calotte.mpas_tools.build_planar_mesh([[1]], [0], [0], [], [], bounds=1)
    with pytest.raises(TypeError, match="order"):
        calotte.stripy.sTriangulation([0], [0], order=1)
