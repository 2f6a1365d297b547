# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh files that VTK and the NetCDF library write themselves, through their modules for Python."""
import netCDF4
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_POLYGON, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

import formats

VTK_DOUBLE = 11


def shapes_of(case, cells):
    points, faces = vtkPoints(), vtkCellArray()
    points.SetDataType(VTK_DOUBLE)
    for p in case.corners if cells else case.points:
        points.InsertNextPoint(p)
    for face in case.cells if cells else case.triangles:
        faces.InsertNextCell(len(face))
        for corner in face:
            faces.InsertCellPoint(corner)
    return points, faces


def poly_data(case, cells):
    data = vtkPolyData()
    points, faces = shapes_of(case, cells)
    data.SetPoints(points)
    data.SetPolys(faces)
    return data


def grid(case, cells):
    data = vtkUnstructuredGrid()
    points, faces = shapes_of(case, cells)
    data.SetPoints(points)
    data.SetCells(VTK_POLYGON if cells else 5, faces)
    return data


def vtk_file(writer_class, data_of, cells=False, settings=()):
    def write(path, case):
        writer = writer_class()
        writer.SetFileName(path)
        writer.SetInputData(data_of(case, cells))
        for setting in settings:
            setting(writer)
        assert writer.Write() == 1, path
    return write


def ascii_xml(writer):
    writer.SetDataModeToAscii()


def appended_raw(writer):
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()


def base64_plain(writer):
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt32()


def binary(writer):
    writer.SetFileTypeToBinary()


def version_4(writer):
    writer.SetFileVersion(42)


def by_netcdf_4(write_classic):
    """The same contents as NetCDF-4, compressed, in the types that the library's users take."""
    def write(path, case):
        write_classic(path + ".classic", case)
        with netCDF4.Dataset(path + ".classic") as old, netCDF4.Dataset(path, "w") as new:
            for name, dimension in old.dimensions.items():
                new.createDimension(name, len(dimension))
            for name in old.ncattrs():
                new.setncattr(name, old.getncattr(name))
            for name, variable in old.variables.items():
                kind = "i8" if variable.dtype.kind == "i" and variable.dimensions else variable.dtype
                attributes = {key: variable.getncattr(key) for key in variable.ncattrs()}
                copy = new.createVariable(name, kind, variable.dimensions, zlib=bool(variable.dimensions),
                                          fill_value=attributes.pop("_FillValue", None))
                copy.setncatts(attributes)
                copy.set_auto_maskandscale(False)
                variable.set_auto_maskandscale(False)
                copy[...] = variable[...]
    return write


TRIANGLES = {
    "vtk-ascii.vtp": vtk_file(vtkXMLPolyDataWriter, poly_data, settings=[ascii_xml]),
    "vtk-zlib.vtp": vtk_file(vtkXMLPolyDataWriter, poly_data),
    "vtk-raw.vtp": vtk_file(vtkXMLPolyDataWriter, poly_data, settings=[appended_raw]),
    "vtk-base64.vtu": vtk_file(vtkXMLUnstructuredGridWriter, grid, settings=[base64_plain]),
    "vtk-zlib.vtu": vtk_file(vtkXMLUnstructuredGridWriter, grid),
    "vtk-ascii.vtk": vtk_file(vtkPolyDataWriter, poly_data),
    "vtk-binary.vtk": vtk_file(vtkPolyDataWriter, poly_data, settings=[binary]),
    "vtk-version4.vtk": vtk_file(vtkUnstructuredGridWriter, grid, settings=[binary, version_4]),
    "netcdf4-full.nc": by_netcdf_4(formats.mpas_full),
    "netcdf4-ugrid.nc": by_netcdf_4(formats.ugrid_triangles),
}
CELLS = {
    "vtk-cells.vtp": vtk_file(vtkXMLPolyDataWriter, poly_data, cells=True),
    "vtk-cells.vtu": vtk_file(vtkXMLUnstructuredGridWriter, grid, cells=True, settings=[appended_raw]),
    "vtk-cells.vtk": vtk_file(vtkPolyDataWriter, poly_data, cells=True, settings=[binary]),
    "netcdf4-scrip.nc": by_netcdf_4(formats.scrip),
    "netcdf4-esmf.nc": by_netcdf_4(formats.esmf),
    "netcdf4-cells.nc": by_netcdf_4(formats.ugrid_cells),
}
WITHOUT_CENTRES = {"vtk-cells.vtp", "vtk-cells.vtu", "vtk-cells.vtk"}
