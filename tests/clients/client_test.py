#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests whether other programs read the files that the command writes.

    client_test.py CLIENT CALOTTE

CLIENT is netcdf (netCDF4 for Python, ncdump), vtk or cdo; CALOTTE is the path of the command. Exit
code 77, which skips the test, where the client is not installed, unless the environment variable
CALOTTE_CLIENTS is "required".
"""

import os
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
RADIUS = 6371220.0  # metres
NETCDF_FORMATS = ["mpas", "mpas-minimal", "ugrid", "ugrid-triangles", "scrip", "esmf"]
FIELDS = ["area", "density", "spacing", "quality", "degree"]
# Cells of many sizes; and cocircular sites, whose cells have edges without length.
MESHES = {"random": ["random", "1500"], "lattice": ["latlon", "24"]}

try:
    import netCDF4
    import numpy
except ImportError:
    netCDF4 = numpy = None
try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
except ImportError:
    vtk_to_numpy = None


def check(truth, message):
    if not truth:
        sys.exit(f"FAILED: {message}")


def run(*command):
    """The standard output of a command that succeeds."""
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    check(result.returncode == 0, f"{' '.join(command)}: {result.stderr}")
    return result.stdout


def make_mesh(calotte, name):
    """The path of a mesh of that name, to be converted."""
    run(calotte, "points", *MESHES[name], "-o", f"{name}.txt")
    run(calotte, "delaunay", f"{name}.txt", "-o", f"{name}.ply")
    return f"{name}.ply"


# ---- Cells as polygons: arrays of cells x corners x 3, rows filled with the last corner


def unit_vectors(longitudes, latitudes):
    east, north = numpy.radians(longitudes), numpy.radians(latitudes)
    return numpy.stack(
        [numpy.cos(north) * numpy.cos(east), numpy.cos(north) * numpy.sin(east), numpy.sin(north)],
        axis=-1,
    )


def areas_of(centres, corners):
    """On the unit sphere; the centre may be anywhere near."""
    a, b, c = centres[:, None, :], corners, numpy.roll(corners, -1, axis=1)
    across = numpy.sum(a * numpy.cross(b - a, c - a), axis=-1)
    along = 1 + numpy.sum(a * b + b * c + c * a, axis=-1)
    parts = 2 * numpy.arctan2(across, along)
    areas = parts.sum(axis=1)
    check(areas.min() > 0, "a cell's corners do not run counter-clockwise")
    return areas


def filled(ids, start):
    """Node ids from 0 on, a masked row filled with its last one."""
    last = numpy.ma.count(ids, axis=1) - 1
    ends = numpy.take_along_axis(numpy.ma.getdata(ids), last[:, None], axis=1)
    return numpy.where(numpy.ma.getmaskarray(ids), ends, numpy.ma.getdata(ids)) - start


def require_close(values, expected, tolerance, message):
    check(values.shape == expected.shape, f"{message}: {values.shape}, not {expected.shape}")
    worst = numpy.abs(values / expected - 1).max()
    check(worst <= tolerance, f"{message} are off by {worst}")


def ugrid_areas(file):
    mesh = file["mesh"]
    node_lon, node_lat = (file[name][:] for name in mesh.node_coordinates.split())
    face_lon, face_lat = (file[name][:] for name in mesh.face_coordinates.split())
    faces = file[mesh.face_node_connectivity]
    ids = filled(faces[:], faces.start_index)
    return areas_of(unit_vectors(face_lon, face_lat), unit_vectors(node_lon, node_lat)[ids])


def esmf_areas(file):
    nodes, centres = (unit_vectors(*file[name][:].T) for name in ("nodeCoords", "centerCoords"))
    return areas_of(centres, nodes[filled(file["elementConn"][:], 1)])


def scrip_areas(file):
    centres, corners = (
        unit_vectors(file[f"grid_{what}_lon"][:], file[f"grid_{what}_lat"][:])
        for what in ("center", "corner")
    )
    return areas_of(centres, corners)


# ---- The clients


def read_whole(path):
    """A NetCDF file after a look at all that it holds."""
    file = netCDF4.Dataset(path)
    check(file.data_model == "NETCDF3_64BIT_OFFSET", f"{path} is {file.data_model}")
    check(run("ncdump", "-k", path).strip() == "64-bit offset", f"ncdump on the kind of {path}")
    dump = run("ncdump", "-p", "9,17", path).lower()
    check("nan" not in dump and "inf" not in dump.replace("info", ""), f"{path} has NaN or infinity")
    for name, variable in file.variables.items():
        check(f" {name.lower()} =" in dump, f"ncdump shows no values of {name} in {path}")
        variable[:]
        for attribute in ("units", "long_name"):
            check(getattr(variable, attribute, ""), f"{name} in {path} has no {attribute}")
    check(file.sphere_radius == RADIUS, f"the sphere_radius of {path} is {file.sphere_radius}")
    return file


def test_netcdf(calotte):
    for name in MESHES:
        mesh, files = make_mesh(calotte, name), {}
        for format_name in NETCDF_FORMATS:
            path = f"{name}-{format_name}.nc"
            run(calotte, "convert", mesh, path, "--format", format_name,
                "--sphere-radius", str(RADIUS))
            files[format_name] = read_whole(path)
        areas = files["scrip"]["grid_area"][:]
        check(abs(areas.sum() / (4 * numpy.pi) - 1) < 1e-13, f"areas sum to {areas.sum()}")
        # The cells have the same numbers in all.
        require_close(scrip_areas(files["scrip"]), areas, 1e-9, "areas of SCRIP's polygons")
        require_close(ugrid_areas(files["ugrid"]), areas, 1e-9, "areas of UGRID's polygons")
        require_close(esmf_areas(files["esmf"]), areas, 1e-9, "areas of ESMF's polygons")
        require_close(files["esmf"]["elementArea"][:], areas, 1e-14, "ESMF's areas")
        require_close(files["mpas"]["areaCell"][:], areas * RADIUS**2, 1e-12, "MPAS's areas")
        triangles = ugrid_areas(files["ugrid-triangles"])
        check(abs(triangles.sum() / (4 * numpy.pi) - 1) < 1e-11, "areas of UGRID's triangles")


def read_vtk(path):
    """Points, corners of each cell, point data and cell data."""
    reader = vtkXMLPolyDataReader() if path.endswith(".vtp") else vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    check(reader.GetErrorCode() == 0, f"VTK on {path}: error {reader.GetErrorCode()}")
    data = reader.GetOutput()
    cells = data.GetPolys() if path.endswith(".vtp") else data.GetCells()
    offsets = vtk_to_numpy(cells.GetOffsetsArray())
    types = {data.GetCellType(i) for i in range(data.GetNumberOfCells())}
    return data, vtk_to_numpy(data.GetPoints().GetData()), numpy.diff(offsets), types


def require_fields(path, data, count):
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    check(set(FIELDS) <= set(names), f"{path} has the arrays {names}")
    values = {name: vtk_to_numpy(data.GetArray(name)) for name in FIELDS}
    check(all(len(field) == count for field in values.values()), f"lengths of arrays in {path}")
    check(abs(values["area"].sum() / (4 * numpy.pi) - 1) < 1e-12, f"areas in {path}")
    check(values["degree"].sum() == 6 * count - 12, f"degrees in {path}")
    return values


def test_vtk(calotte):
    for name in MESHES:
        mesh = make_mesh(calotte, name)
        with open(f"{name}.txt", encoding="utf-8") as points:
            sites = sum(1 for _ in points)
        for suffix in ("vtp", "vtu"):
            path = f"{name}.{suffix}"
            run(calotte, "convert", mesh, path)
            data, points, corners, types = read_vtk(path)
            check(len(points) == sites and len(corners) == 2 * sites - 4, f"counts of {path}")
            check(set(corners) == {3} and types == {5}, f"{path} has other cells than triangles")
            require_fields(path, data.GetPointData(), sites)

            path = f"{name}-cells.{suffix}"
            run(calotte, "convert", mesh, path, "--format", f"{suffix}-cells")
            data, points, corners, types = read_vtk(path)
            check(len(points) == 2 * sites - 4 and len(corners) == sites, f"counts of {path}")
            check(types <= {5, 7, 9}, f"{path} has cells that are no polygons")
            fields = require_fields(path, data.GetCellData(), sites)
            check((corners == fields["degree"]).all(), f"corners and degrees in {path}")
            norms = numpy.linalg.norm(points, axis=1)
            check(numpy.abs(norms - 1).max() < 1e-12, f"corners in {path} are off the sphere")


def require_constant(path, count):
    with netCDF4.Dataset(path) as file:
        values = next(v[:] for v in file.variables.values() if v[:].size == count and v.ndim < 3
                      and v.name in ("const", "constant"))
        check(not numpy.ma.is_masked(values), f"{path} has cells without a value")
        worst = numpy.abs(values - 7).max()
        check(worst < 1e-12, f"a constant is off by {worst} in {path}")


def test_cdo(calotte):
    os.environ.pop("PLANET_RADIUS", None)
    earth = 6371000.0  # CDO's
    for name in MESHES:
        grid = f"{name}-scrip.nc"
        run(calotte, "convert", make_mesh(calotte, name), grid, "--format", "scrip")
        run("cdo", "-s", "-b", "F64", "gridarea", grid, "areas.nc")
        with netCDF4.Dataset("areas.nc") as file, netCDF4.Dataset(grid) as ours:
            areas = file["cell_area"][:]
            require_close(areas, ours["grid_area"][:] * earth**2, 1e-9, f"CDO's areas of {name}")
            sphere = 4 * numpy.pi * earth**2
            check(abs(areas.sum() / sphere - 1) < 1e-10, f"CDO's areas sum to {areas.sum()}")
        run("cdo", "-s", "-b", "F64", "-f", "nc", f"remapcon,{grid}", "-const,7,r36x18", "there.nc")
        require_constant("there.nc", areas.size)
        run("cdo", "-s", "-b", "F64", "remapcon,r36x18", "-expr,constant=7.0+0*grid_area", grid,
            "back.nc")
        require_constant("back.nc", 36 * 18)
        test_cdo_ugrid(calotte, name)


def test_cdo_ugrid(calotte, name):
    """CDO has no UGRID, but sees the faces as an unstructured grid with coordinates."""
    grid = f"{name}-ugrid.nc"
    run(calotte, "convert", f"{name}.ply", grid, "--format", "ugrid")
    with netCDF4.Dataset(grid) as file:
        places = [file[f"mesh_face_{axis}"][:] for axis in ("lon", "lat")]
    first = run("cdo", "-s", "sinfo", grid).split("Grid coordinates :")[1].splitlines()[1]
    check(first.split()[:4] == ["1", ":", "unstructured", ":"], f"CDO's first grid of {grid}: {first}")
    check(f"points={len(places[0])}" in first.split(), f"CDO's first grid of {grid}: {first}")
    words = run("cdo", "-s", "griddes", "-selname,cell_area", grid).replace("=", " ").split()
    check(words[words.index("gridtype") + 1] == "unstructured", f"the grid of {grid}: {words[:20]}")
    for key, expected in zip(("xvals", "yvals"), places):
        begin = words.index(key) + 1
        values = numpy.array([float(word) for word in words[begin:begin + len(expected)]])
        worst = numpy.abs(values - expected).max()
        check(worst < 1e-4, f"CDO's {key} of {grid} are off by {worst}")
    run("cdo", "-s", "-b", "F64", "-f", "nc", f"remapcon,{grid}", "-const,7,r36x18", "there.nc")
    require_constant("there.nc", len(places[0]))
    run("cdo", "-s", "-b", "F64", "remapcon,r36x18", "-expr,constant=7.0+0*cell_area", "-selname,cell_area", grid,
        "back.nc")
    require_constant("back.nc", 36 * 18)


CLIENTS = {
    "netcdf": (test_netcdf, lambda: netCDF4 and shutil.which("ncdump")),
    "vtk": (test_vtk, lambda: numpy and vtk_to_numpy),
    "cdo": (test_cdo, lambda: netCDF4 and shutil.which("cdo")),
}


def main():
    _, client, calotte = sys.argv
    test, installed = CLIENTS[client]
    if not installed():
        message = f"{client} is not installed: tools/setup --clients"
        check(os.environ.get("CALOTTE_CLIENTS") != "required", message)
        print(message)
        sys.exit(SKIPPED)
    calotte = os.path.abspath(calotte)
    with tempfile.TemporaryDirectory(prefix="calotte-clients-") as folder:
        os.chdir(folder)
        test(calotte)
        os.chdir("/")


if __name__ == "__main__":
    main()
