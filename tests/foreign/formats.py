# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh files in the way that other programs write them, without Calotte.

Each writer takes a path and a case: `points`, `triangles` (of points), and for formats of cells
`corners`, `cells` (lists of corners) and `centres`; `base` is the first index where a format leaves it
free."""
import json
import math
import struct

import netcdf3
import truth


def lon(p):
    return math.degrees(math.atan2(p[1], p[0])) % 360


def lat(p):
    return math.degrees(math.atan2(p[2], math.hypot(p[0], p[1])))


def flat(rows):
    return [x for row in rows for x in row]


def text(path, lines):
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def line(values, separator=" "):
    return separator.join(repr(v) for v in values)


# ---- Triangles of points

def off(path, case):
    text(path, ["OFF", f"{len(case.points)} {len(case.triangles)} 0"] +
         [line(p) for p in case.points] + ["3 " + line(t) for t in case.triangles])


def msh(path, case):
    text(path, ["# a mesh", "MSHID=3;EUCLIDEAN-MESH", "NDIMS=3", f"POINT={len(case.points)}"] +
         [line(p, ";") + ";0" for p in case.points] + [f"TRIA3={len(case.triangles)}"] +
         [line(t, ";") + ";0" for t in case.triangles])


def msh_ellipsoid(path, case):
    text(path, ["MSHID=3;ELLIPSOID-MESH", "RADII=1;1;1", "NDIMS=2", f"POINT={len(case.points)}"] +
         [line((math.radians(lon(p)), math.radians(lat(p))), ";") + ";0" for p in case.points] +
         [f"TRIA3={len(case.triangles)}"] + [line(t, ";") + ";0" for t in case.triangles])


def gmsh_elements(case):
    """A point of the geometry, and a line, before the triangles; nodes have numbers of their own."""
    number = [7 + 3 * i for i in range(len(case.points))]
    a, b = number[:2]
    return number, [(15, [5]), (1, [a, b])] + [(2, [number[i] for i in t]) for t in case.triangles]


def gmsh2(path, case):
    number, elements = gmsh_elements(case)
    text(path, ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "1", '2 1 "sea"',
                "$EndPhysicalNames", "$Nodes", str(len(number) + 1), "5 0 0 0"] +
         [f"{k} " + line(p) for k, p in zip(number, case.points)] +
         ["$EndNodes", "$Elements", str(len(elements))] +
         [f"{k + 1} {kind} 2 1 1 " + line(nodes) for k, (kind, nodes) in enumerate(elements)] +
         ["$EndElements"])


def gmsh4(path, case):
    number, elements = gmsh_elements(case)
    half = len(number) // 2
    blocks = [(0, [5], [(0.0, 0.0, 0.0)]), (2, number[:half], case.points[:half]),
              (2, number[half:], case.points[half:])]
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$Entities", "0 0 0 0", "$EndEntities", "$Nodes",
             f"3 {len(number) + 1} 5 {number[-1]}"]
    for k, (dimension, tags, places) in enumerate(blocks):
        lines += [f"{dimension} {k + 1} 0 {len(tags)}"] + [str(tag) for tag in tags] + [line(p) for p in places]
    lines += ["$EndNodes", "$Elements", f"3 {len(elements)} 1 {len(elements)}"]
    for kind, dimension in ((15, 0), (1, 1), (2, 2)):
        own = [(k + 1, nodes) for k, (other, nodes) in enumerate(elements) if other == kind]
        lines += [f"{dimension} 1 {kind} {len(own)}"] + [f"{k} " + line(nodes) for k, nodes in own]
    text(path, lines + ["$EndElements"])


def fesom(path, case):
    text(path, [str(len(case.points))] +
         [f"{i + 1} {lon(p)!r} {lat(p)!r} 0" for i, p in enumerate(case.points)])
    text(path.replace("nod2d", "elem2d"), [str(len(case.triangles))] +
         [line([i + 1 for i in t]) for t in case.triangles])


def columns(path, case):
    text(path, [line(t) for t in case.triangles])
    text(path.replace(".tri", ".points.txt"), [line(p) for p in case.points])


def ply_ascii(path, case):
    text(path, ["ply", "format ascii 1.0", f"element vertex {len(case.points)}", "property float64 x",
                "property float64 y", "property float64 z", f"element face {len(case.triangles)}",
                "property list uchar int vertex_index", "end_header"] +
         [line(p) for p in case.points] + ["3 " + line(t) for t in case.triangles])


def ply_binary(order):
    def write(path, case):
        name = "little" if order == "<" else "big"
        head = (f"ply\nformat binary_{name}_endian 1.0\ncomment by another\n"
                f"element vertex {len(case.points)}\nproperty double x\nproperty double y\n"
                f"property double z\nproperty uchar red\nelement face {len(case.triangles)}\n"
                "property list uchar uint vertex_indices\nend_header\n")
        with open(path, "wb") as file:
            file.write(head.encode())
            for p in case.points:
                file.write(struct.pack(order + "dddB", *p, 7))
            for t in case.triangles:
                file.write(struct.pack(order + "BIII", 3, *t))
    return write


def vtk_xml(data_set, cells, counts, types):
    def write(path, case):
        offsets = [3 * (k + 1) for k in range(len(case.triangles))]
        text(path, ['<?xml version="1.0"?>',
                    f'<VTKFile type="{data_set}" version="0.1" byte_order="LittleEndian">',
                    f"<{data_set}>", f'<Piece NumberOfPoints="{len(case.points)}" '
                    f'{counts}="{len(case.triangles)}">', "<Points>",
                    '<DataArray type="Float64" NumberOfComponents="3" format="ascii">',
                    line(flat(case.points)), "</DataArray>", "</Points>", f"<{cells}>",
                    '<DataArray type="Int64" Name="connectivity" format="ascii">',
                    line(flat(case.triangles)), "</DataArray>",
                    '<DataArray type="Int64" Name="offsets" format="ascii">', line(offsets),
                    "</DataArray>"] +
             (['<DataArray type="UInt8" Name="types" format="ascii">',
               line([5] * len(case.triangles)), "</DataArray>"] if types else []) +
             [f"</{cells}>", "</Piece>", f"</{data_set}>", "</VTKFile>"])
    return write


def vtk_legacy(path, case):
    text(path, ["# vtk DataFile Version 3.0", "a mesh", "ASCII", "DATASET POLYDATA",
                f"POINTS {len(case.points)} double"] + [line(p) for p in case.points] +
         [f"POLYGONS {len(case.triangles)} {4 * len(case.triangles)}"] +
         ["3 " + line(t) for t in case.triangles])


def ugrid_triangles(path, case):
    netcdf3.write(path, {"nMesh2_node": len(case.points), "nMesh2_face": len(case.triangles), "Three": 3},
                  {"Mesh2": ((), [0], {"cf_role": "mesh_topology", "topology_dimension": 2,
                                       "node_coordinates": "Mesh2_node_x Mesh2_node_y",
                                       "face_node_connectivity": "Mesh2_face_nodes"}),
                   "Mesh2_face_nodes": (("nMesh2_face", "Three"),
                                        [i + case.base for i in flat(case.triangles)],
                                        {"cf_role": "face_node_connectivity", "start_index": case.base}),
                   "Mesh2_node_x": (("nMesh2_node",), [lon(p) for p in case.points],
                                    {"units": "degrees_east", "standard_name": "longitude"}),
                   "Mesh2_node_y": (("nMesh2_node",), [lat(p) for p in case.points],
                                    {"units": "degrees_north", "standard_name": "latitude"})})


def fesom_diag(path, case):
    """FESOM's own description of its mesh: ids from 1 without start_index, the slower dimension last."""
    turned = [[t[k] + 1 for t in case.triangles] for k in range(3)]
    netcdf3.write(path, {"nod2": len(case.points), "elem": len(case.triangles), "n3": 3, "nz": 2},
                  {"fesom_mesh": ((), [0], {"cf_role": "mesh_topology", "topology_dimension": 2,
                                            "node_coordinates": "lon lat", "face_dimension": "elem",
                                            "face_node_connectivity": "elements"}),
                   "nlevels": (("elem",), [2] * len(case.triangles), {}),
                   "lon": (("nod2",), [lon(p) for p in case.points], {"long_name": "longitude", "units": "degrees"}),
                   "lat": (("nod2",), [lat(p) for p in case.points], {"long_name": "latitude", "units": "degrees"}),
                   "nod_area": (("nz", "nod2"), [1.0] * (2 * len(case.points)), {}),
                   "elements": (("n3", "elem"), flat(turned), {"long_name": "elements"})})


def icon(path, case):
    turned = [[t[k] + 1 for t in case.triangles] for k in range(3)]
    netcdf3.write(path, {"cell": len(case.triangles), "vertex": len(case.points), "nv": 3},
                  {"vlon": (("vertex",), [math.radians(lon(p)) for p in case.points], {"units": "radian"}),
                   "vlat": (("vertex",), [math.radians(lat(p)) for p in case.points], {"units": "radian"}),
                   "vertex_of_cell": (("nv", "cell"), flat(turned), {})})


def mpi_scvt(path, case):
    """Its triangles are in no order of turning."""
    text(path, [line(p) for p in case.points])
    text(path.replace("Vertices", "Triangles"), [line(t) for t in case.triangles])


def mpas_full(path, case):
    """All lists, places and measures of a closed mesh, which run as the triangles do."""
    corners = [circumcentre(*(case.points[i] for i in t)) for t in case.triangles]
    rings = [[] for _ in case.points]
    for v, triangle in enumerate(case.triangles):
        for i in triangle:
            rings[i].append(v)
    turned = [truth.area(*(truth.unit(case.points[i]) for i in t)) < 0 for t in case.triangles]
    rings = [ordered(truth.unit(case.points[i]), corners, ring, turned[ring[0]])
             for i, ring in enumerate(rings)]
    edges, at = [], {}
    for i, ring in enumerate(rings):
        for k, v in enumerate(ring):
            before = ring[k - 1]
            (other,) = (set(case.triangles[v]) & set(case.triangles[before])) - {i}
            if (key := (min(i, other), max(i, other))) not in at:
                at[key] = len(edges)
                edges.append((i, other, before, v))
    most = max(map(len, rings))
    beyond = [[(set(case.triangles[v]) & set(case.triangles[ring[k - 1]]) - {i}).pop()
               for k, v in enumerate(ring)] for i, ring in enumerate(rings)]

    def padded(rows):
        return flat([[i + 1 for i in row] + [0] * (most - len(row)) for row in rows])

    def arc(a, b):
        return case.radius * 2 * math.asin(math.dist(truth.unit(a), truth.unit(b)) / 2)

    cell, edge, vertex = ("nCells",), ("nEdges",), ("nVertices",)
    variables = {}
    for kind, dims, places in (("Cell", cell, case.points), ("Vertex", vertex, corners)):
        for k, axis in enumerate("xyz"):
            scale = 1.0 if kind == "Cell" else case.radius
            variables[axis + kind] = (dims, [scale * p[k] for p in places], {})
        variables["lon" + kind] = (dims, [math.radians(lon(p)) for p in places], {"units": "radians"})
        variables["lat" + kind] = (dims, [math.radians(lat(p)) for p in places], {"units": "radians"})
    variables.update({
        "nEdgesOnCell": (cell, [len(ring) for ring in rings], {}),
        "verticesOnCell": (("nCells", "maxEdges"), padded(rings), {}),
        "cellsOnCell": (("nCells", "maxEdges"), padded(beyond), {}),
        "edgesOnCell": (("nCells", "maxEdges"),
                        padded([[at[min(i, j), max(i, j)] for j in row] for i, row in enumerate(beyond)]), {}),
        "cellsOnVertex": (("nVertices", "vertexDegree"), [i + 1 for i in flat(case.triangles)], {}),
        "cellsOnEdge": (("nEdges", "TWO"), flat([(e[0] + 1, e[1] + 1) for e in edges]), {}),
        "verticesOnEdge": (("nEdges", "TWO"), flat([(e[2] + 1, e[3] + 1) for e in edges]), {}),
        "areaCell": (cell, [case.radius ** 2 * abs(truth.polygon_area([corners[v] for v in ring]))
                            for ring in rings], {}),
        "dcEdge": (edge, [arc(case.points[e[0]], case.points[e[1]]) for e in edges], {}),
        "dvEdge": (edge, [arc(corners[e[2]], corners[e[3]]) for e in edges], {}),
        "flow": (edge, [p - q for p, q in ((case.points[e[1]][0], case.points[e[0]][0]) for e in edges)],
                 {"long_name": "difference of x along the normal"})})
    netcdf3.write(path, {"nCells": len(rings), "nEdges": len(edges), "nVertices": len(corners),
                         "maxEdges": most, "TWO": 2, "vertexDegree": 3}, variables,
                  {"on_a_sphere": "YES", "is_periodic": "NO", "sphere_radius": float(case.radius)})


def circumcentre(a, b, c):
    a, b, c = truth.unit(a), truth.unit(b), truth.unit(c)
    centre = truth.unit(truth.cross(truth.minus(b, a), truth.minus(c, a)))
    return centre if truth.dot(centre, a) > 0 else tuple(-x for x in centre)


def ordered(centre, corners, ring, clockwise):
    """The corners around a place, by their direction from there."""
    east = truth.unit(truth.cross(centre, (0.1, 0.2, 0.97)))
    north = truth.cross(centre, east)
    return sorted(ring, reverse=clockwise,
                  key=lambda v: math.atan2(truth.dot(corners[v], north), truth.dot(corners[v], east)))


def exodus_triangles(path, case):
    exodus(path, case.points, case.triangles, "TRI3")


def mpas_minimal(path, case):
    n, m = len(case.points), len(case.triangles)
    variables = {}
    for k, axis in enumerate("xyz"):
        variables[axis + "Cell"] = (("nCells",), [p[k] for p in case.points], {})
    variables["cellsOnVertex"] = (("nVertices", "vertexDegree"), [i + 1 for i in flat(case.triangles)], {})
    netcdf3.write(path, {"nCells": n, "nVertices": m, "vertexDegree": 3}, variables,
                  {"on_a_sphere": "YES", "sphere_radius": float(case.radius)})


# ---- Cells

def exodus(path, corners, cells, kind):
    most = max(len(c) for c in cells)
    netcdf3.write(path, {"num_dim": 3, "num_nodes": len(corners), "num_elem": len(cells), "num_el_blk": 1,
                         "num_el_in_blk1": len(cells), "num_nod_per_el1": most},
                  {"coord": (("num_dim", "num_nodes"), [p[k] for k in range(3) for p in corners], {}),
                   "connect1": (("num_el_in_blk1", "num_nod_per_el1"),
                                flat([[c[min(k, len(c) - 1)] + 1 for k in range(most)] for c in cells]),
                                {"elem_type": kind})})


def exodus_cells(path, case):
    exodus(path, case.corners, case.cells, "SHELL")


def scrip(path, case):
    most = max(len(c) for c in case.cells)
    rows = [[case.corners[c[min(k, len(c) - 1)]] for k in range(most)] for c in case.cells]
    netcdf3.write(path, {"grid_size": len(case.cells), "grid_corners": most, "grid_rank": 1},
                  {"grid_dims": (("grid_rank",), [len(case.cells)], {}),
                   "grid_center_lat": (("grid_size",), [lat(p) for p in case.centres], {"units": "degrees"}),
                   "grid_center_lon": (("grid_size",), [lon(p) for p in case.centres], {"units": "degrees"}),
                   "grid_corner_lat": (("grid_size", "grid_corners"), [lat(p) for p in flat(rows)],
                                       {"units": "degrees"}),
                   "grid_corner_lon": (("grid_size", "grid_corners"), [lon(p) for p in flat(rows)],
                                       {"units": "degrees"}),
                   "grid_imask": (("grid_size",), [1] * len(case.cells), {})})


def rows_of(case, pad):
    """The longitudes and latitudes of the corners, in rows of one length."""
    most = max(len(c) for c in case.cells)
    return [[f(case.corners[c[k]]) if k < len(c) else pad for c in case.cells for k in range(most)]
            for f in (lon, lat)], most


def scrip_filled(path, case):
    (east, north), most = rows_of(case, -9999.0)
    degrees = {"units": "degrees", "_FillValue": -9999.0}
    netcdf3.write(path, {"grid_size": len(case.cells), "grid_corners": most, "grid_rank": 1},
                  {"grid_dims": (("grid_rank",), [len(case.cells)], {}),
                   "grid_center_lat": (("grid_size",), [lat(p) for p in case.centres], {"units": "degrees"}),
                   "grid_center_lon": (("grid_size",), [lon(p) for p in case.centres], {"units": "degrees"}),
                   "grid_corner_lat": (("grid_size", "grid_corners"), north, degrees),
                   "grid_corner_lon": (("grid_size", "grid_corners"), east, degrees),
                   "grid_imask": (("grid_size",), [1] * len(case.cells), {})})


def bounds(path, case):
    """Output of a model by the CF conventions, in radians, whose bounds have no unit of their own. The
    edges have places with bounds, too, but no variable of their own."""
    (east, north), most = rows_of(case, math.nan)
    filled = {"missing_value": math.nan}
    places = lambda of, name: {"standard_name": name, "units": "radian", "bounds": of + "_bnds"}
    netcdf3.write(path, {"time": 1, "edge": 2, "four": 4, "ncells": len(case.cells), "vertices": most},
                  {"elon": (("edge",), [0.0, 1.0], places("elon", "longitude")),
                   "elat": (("edge",), [0.0, 1.0], places("elat", "latitude")),
                   "elon_bnds": (("edge", "four"), [0.0, 0.1, 0.2, 0.3] * 2, {}),
                   "elat_bnds": (("edge", "four"), [0.0, 0.1, 0.2, 0.3] * 2, {}),
                   "clon": (("ncells",), [math.radians(lon(p)) for p in case.centres], places("clon", "longitude")),
                   "clat": (("ncells",), [math.radians(lat(p)) for p in case.centres], places("clat", "latitude")),
                   "clon_bnds": (("ncells", "vertices"), [math.radians(x) for x in east], filled),
                   "clat_bnds": (("ncells", "vertices"), [math.radians(x) for x in north], filled),
                   "size": (("time", "ncells"), list(case.areas), {"coordinates": "clon clat", "units": "1"})},
                  {"Conventions": "CF-1.6"})


def oasis(path, case):
    """The grids of OASIS: corners first, then y and x."""
    (east, north), most = rows_of(case, None)
    for values in (east, north):
        for k, value in enumerate(values):
            values[k] = values[k - 1] if value is None else value
    turn = lambda values: [values[i * most + k] for k in range(most) for i in range(len(case.cells))]
    degrees = {"units": "degrees"}
    netcdf3.write(path, {"x": len(case.cells), "y": 1, "crn": most},
                  {"atmo.lon": (("y", "x"), [lon(p) for p in case.centres], degrees),
                   "atmo.lat": (("y", "x"), [lat(p) for p in case.centres], degrees),
                   "atmo.clo": (("crn", "y", "x"), turn(east), degrees),
                   "atmo.cla": (("crn", "y", "x"), turn(north), degrees)})


def scrip_bare(path, case):
    """Without centres."""
    (east, north), most = rows_of(case, -999.0)
    degrees = {"units": "degrees", "missing_value": -999.0}
    netcdf3.write(path, {"grid_size": len(case.cells), "grid_corners": most, "grid_rank": 1},
                  {"grid_dims": (("grid_rank",), [len(case.cells)], {}),
                   "grid_corner_lat": (("grid_size", "grid_corners"), north, degrees),
                   "grid_corner_lon": (("grid_size", "grid_corners"), east, degrees)})


def esmf(path, case):
    most = max(len(c) for c in case.cells)
    rows = [[c[k] + case.base if k < len(c) else -1 for k in range(most)] for c in case.cells]
    netcdf3.write(path, {"nodeCount": len(case.corners), "elementCount": len(case.cells),
                         "maxNodePElement": most, "coordDim": 2},
                  {"nodeCoords": (("nodeCount", "coordDim"), flat([(lon(p), lat(p)) for p in case.corners]),
                                  {"units": "degrees"}),
                   "elementConn": (("elementCount", "maxNodePElement"), flat(rows),
                                   {"start_index": case.base, "_FillValue": -1}),
                   "numElementConn": (("elementCount",), [len(c) for c in case.cells], {}),
                   "centerCoords": (("elementCount", "coordDim"), flat([(lon(p), lat(p)) for p in case.centres]),
                                    {"units": "degrees"})},
                  {"gridType": "unstructured"})


def ugrid_cells(path, case):
    most = max(len(c) for c in case.cells)
    rows = [[c[k] + case.base if k < len(c) else -1 for k in range(most)] for c in case.cells]
    places = {}
    for prefix, points, dim in (("node", case.corners, "nNodes"), ("face", case.centres, "nFaces")):
        places["grid_" + prefix + "_lat"] = ((dim,), [lat(p) for p in points],
                                             {"units": "degrees_north", "standard_name": "latitude"})
        places["grid_" + prefix + "_lon"] = ((dim,), [lon(p) for p in points],
                                             {"units": "degrees_east", "standard_name": "longitude"})
    netcdf3.write(path, {"nNodes": len(case.corners), "nFaces": len(case.cells), "nMaxNodes": most},
                  {"grid": ((), [0], {"cf_role": "mesh_topology", "topology_dimension": 2,
                                      "node_coordinates": "grid_node_lat grid_node_lon",
                                      "face_coordinates": "grid_face_lon grid_face_lat",
                                      "face_dimension": "nFaces", "face_node_connectivity": "grid_nodes"}),
                   "grid_nodes": (("nFaces", "nMaxNodes"), flat(rows),
                                  {"start_index": case.base, "_FillValue": -1}), **places})


def rings_of(case):
    """Longitudes and latitudes that do not jump; a ring around a pole is closed along the pole."""
    for cell in case.cells:
        ring = [[lon(case.corners[k]), lat(case.corners[k])] for k in cell + cell[:1]]
        for last, here in zip(ring, ring[1:]):
            here[0] += 360 * round((last[0] - here[0]) / 360)
        if abs(ring[-1][0] - ring[0][0]) > 1:
            pole = math.copysign(90, ring[0][1])
            ring += [[ring[-1][0], pole], [ring[0][0], pole], list(ring[0])]
        yield ring


def geojson(path, case):
    features = [{"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [ring]},
                 "properties": dict(zip("xyz", centre), name=f"cell {i}", size=area)}
                for i, (ring, centre, area) in enumerate(zip(rings_of(case), case.centres, case.areas))]
    text(path, [json.dumps({"type": "FeatureCollection", "features": features})])


def geojson_shapes(path, case):
    text(path, [json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [ring]}, "properties": {}}
        for ring in rings_of(case)]})])


TRIANGLES = {"mesh.off": off, "mesh.msh": msh, "ellipsoid.msh": msh_ellipsoid, "nod2d.out": fesom,
             "mesh.tri": columns, "ascii.ply": ply_ascii, "little.ply": ply_binary("<"),
             "big.ply": ply_binary(">"), "mesh.vtp": vtk_xml("PolyData", "Polys", "NumberOfPolys", False),
             "mesh.vtu": vtk_xml("UnstructuredGrid", "Cells", "NumberOfCells", True),
             "legacy.vtk": vtk_legacy, "ugrid.nc": ugrid_triangles, "icon.nc": icon,
             "triangles.g": exodus_triangles, "minimal.nc": mpas_minimal,
             "full.nc": mpas_full, "SaveVertices": mpi_scvt, "gmsh2.msh": gmsh2, "gmsh4.msh": gmsh4,
             "fesom.mesh.diag.nc": fesom_diag}
CELLS = {"cells.g": exodus_cells, "scrip.nc": scrip, "esmf.nc": esmf, "cells.nc": ugrid_cells,
         "cells.geojson": geojson, "shapes.geojson": geojson_shapes, "filled.nc": scrip_filled,
         "bounds.nc": bounds, "oasis.nc": oasis, "bare.nc": scrip_bare}
WITHOUT_CENTRES = {"cells.g", "shapes.geojson", "bare.nc"}
FREE_TURNING = {"cells.geojson", "shapes.geojson"}  # of each cell
ANGLES = {"ellipsoid.msh", "nod2d.out", "ugrid.nc", "icon.nc", "fesom.mesh.diag.nc"}  # hold no radius
FREE_BASE = {"ugrid.nc", "esmf.nc", "cells.nc"}
