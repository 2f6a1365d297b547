# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields with times and levels: with names by xarray and without, from grid to grid, in files and pictures."""
import sys

import numpy as np
import pytest

import calotte

BOXES = calotte.raster(36, 18)
TIMES, LEVELS = 3, 2


@pytest.fixture(scope="module", name="mesh")
def fixture_mesh():
    return calotte.cvt(642).mesh


def heights():
    """Numbers of a raster by time and level, and the same for all longitudes of a latitude."""
    sine = np.sin(np.radians(BOXES.latitudes))[:, np.newaxis] * np.ones(36)
    return np.multiply.outer(np.arange(1.0, TIMES + 1), np.multiply.outer([1.0, 10.0], sine))


def labelled(**attributes):
    xarray = pytest.importorskip("xarray")
    return xarray.DataArray(heights(), dims=("time", "lev", "lat", "lon"), name="h",
                            coords={"time": [10, 20, 30], "lev": [0.5, 1.5], "lat": BOXES.latitudes,
                                    "lon": BOXES.longitudes, "run": 7}, attrs=attributes)


# ---- From grid to grid

def test_arrays_without_names(mesh):
    given = heights()
    found = calotte.interpolate(BOXES, given, mesh)
    assert found.shape == (TIMES, LEVELS, 642)
    flat = calotte.interpolate(BOXES, given[2, 1].ravel(), mesh)
    assert (found[2, 1] == flat).all()
    assert (calotte.interpolate(BOXES, given[2, 1], mesh) == flat).all()
    assert (calotte.interpolate(mesh, found, BOXES)[2, 1] == calotte.interpolate(mesh, flat, BOXES)).all()
    weights = calotte.interpolation_weights(BOXES, mesh)
    assert weights.apply(np.moveaxis(given, (2, 3), (0, 1)).reshape(648, 3, 2)).shape == (642, 3, 2)


def test_named_dimensions_are_kept(mesh):
    array = labelled(units="m", long_name="height", mesh="a mesh that it is not on", grid_mapping="crs")
    found = calotte.interpolate(BOXES, array, mesh)
    assert type(found) is type(array)
    assert found.dims == ("time", "lev", "nCells") and found.name == "h"
    assert found.attrs == {"units": "m", "long_name": "height"}
    assert found.time.values.tolist() == [10, 20, 30] and found.lev.values.tolist() == [0.5, 1.5] and found.run == 7
    assert (found.lon == mesh.lon).all() and found.lat.attrs["units"] == "degrees_north"
    assert (found.values == calotte.interpolate(BOXES, array.values, mesh)).all()
    back = calotte.interpolate(mesh, found.transpose("time", "nCells", "lev"), BOXES)
    assert back.dims == ("time", "lat", "lon", "lev") and (back.lat == BOXES.latitudes).all()
    other = calotte.interpolate(mesh, found.rename(nCells="ncol"), mesh, method="nearest")
    assert other.dims == ("time", "lev", "ncol") and (other.values == found.values).all()


def test_any_order_of_dimensions_and_nodes(mesh):
    array = labelled()
    expected = calotte.interpolate(BOXES, array, mesh)
    for given in (array.transpose("lon", "time", "lat", "lev"), array.isel(lat=slice(None, None, -1)),
                  array.rename(lat="latitude", lon="longitude"), array.drop_vars(["lat", "lon"]),
                  array.assign_coords(lon=BOXES.longitudes - 360)):
        found = calotte.interpolate(BOXES, given, mesh)
        assert (found.transpose(*expected.dims).values == expected.values).all()
    by_units = array.rename(lat="y", lon="x")
    by_units.y.attrs["units"], by_units.x.attrs["standard_name"] = "degrees_north", "longitude"
    assert (calotte.interpolate(calotte.raster(by_units), by_units, mesh).values == expected.values).all()
    assert (calotte.interpolate(array, array, mesh).values == expected.values).all()
    back = calotte.interpolate(mesh, expected, array)
    assert back.dims == array.dims and (back.lat == array.lat).all()
    assert len(calotte.raster(array)) == len(calotte.raster(array.to_dataset())) == 648


def test_at_positions_and_of_a_file(mesh, tmp_path):
    xarray = pytest.importorskip("xarray")
    array = labelled()
    stations = xarray.DataArray([(-105.0, 40.0), (0.0, 51.5)], dims=("station", "axis"))
    found = calotte.interpolate(BOXES, array, stations)
    assert found.dims == ("time", "lev", "station") and found.lat.values.tolist() == pytest.approx([40, 51.5])
    assert calotte.interpolate(BOXES, array, [(-105.0, 40.0)]).dims == ("time", "lev", "position")
    calotte.interpolation_weights(BOXES, mesh).write(tmp_path / "w.nc")
    again = calotte.read_weights(tmp_path / "w.nc").apply(array)
    assert again.dims == ("time", "lev", "nCells")
    assert np.allclose(again.values, calotte.interpolate(BOXES, array, mesh, method="conservative").values)


def test_arrays_that_do_not_fit(mesh):
    array = labelled()
    for given, text in ((array.isel(lat=slice(9)), "9 latitudes and 36 longitudes, and the raster 18 and 36"),
                        (array.to_dataset(), "give one of them.*: h"),
                        (array.rename(lat="y"), "'y', 'lon'.*name one of them lat"),
                        (array.assign_coords(lon=BOXES.longitudes + 3), "coordinate lon of the values is not"),
                        (array.astype(str), "must be numbers")):
        with pytest.raises(calotte.Error, match=text):
            calotte.interpolate(BOXES, given, mesh)
    with pytest.raises(calotte.Error, match="'time': 3, 'ncol': 641.*each of the 642 cells"):
        calotte.interpolate(mesh, array.isel(lev=0, lat=0, lon=0).expand_dims(ncol=641, axis=1), BOXES)
    with pytest.raises(calotte.Error, match="2 of their number, named nCells"):
        calotte.interpolate(mesh, array.isel(time=0, lev=0, lat=0, lon=0).expand_dims(a=642, b=642), BOXES)
    with pytest.raises(calotte.Error, match="no coordinate.*assign_coords"):
        calotte.raster(array.drop_vars("lat"))
    with pytest.raises(calotte.Error, match="there are no latitudes"):
        calotte.raster([1.0, 2.0, 3.0])


def test_what_is_not_installed_is_named(mesh, monkeypatch):
    weights = calotte.interpolation_weights(mesh, BOXES)
    monkeypatch.setitem(sys.modules, "scipy.sparse", None)
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(calotte.Error, match="needs scipy; install it.*or use apply"):
        weights.to_scipy_sparse()
    with pytest.raises(calotte.Error, match="needs xarray and netCDF4; install them"):
        mesh.to_xarray()
    monkeypatch.undo()
    pytest.importorskip("scipy.sparse")
    assert (weights.to_scipy_sparse() != weights.matrix).nnz == 0


# ---- What a grid tells of its cells

def test_longitudes_latitudes_and_neighbours(mesh):
    assert np.allclose(calotte.from_lonlat(mesh.lon, mesh.lat), mesh.points)
    around = calotte.neighbours(mesh)
    assert len(around) == 642 and repr(around) == "<calotte.IdLists: 642 lists, 3840 ids>"
    assert sorted(around[-1].tolist()) == sorted(around.ids[around.begin[-2]:].tolist())
    assert all(i in around[j] for i in range(642) for j in around[i]) and len(list(around)) == 642
    cells = calotte.voronoi(mesh)
    assert (around.ids == cells.cells_on_cell).all() and (around.begin == cells.begin).all()
    with pytest.raises(IndexError, match="642 lists"):
        around[642]
    with pytest.raises(calotte.Error, match="give a Mesh or Polygons"):
        calotte.neighbours(mesh.points)
    plane = calotte.delaunay([(0, 0), (1, 0), (0, 1), (3, 2)], calotte.plane())
    with pytest.raises(AttributeError, match="a plane has no longitudes"):
        plane.lat
    assert not hasattr(plane, "lon")


def test_neighbours_of_a_part(mesh, tmp_path):
    mesh.to_mpas(tmp_path / "mesh.nc")
    calotte.cut(tmp_path / "mesh.nc", tmp_path / "part.nc", "circle=0,0,40deg")
    part = calotte.read(tmp_path / "part.nc")
    around = calotte.neighbours(part)
    assert len(around) == len(part.cells) == len(part.lon)
    assert {len(ids) for ids in around} > {5, 6} and (calotte.neighbours(part.cells).ids == around.ids).all()


def test_what_a_raster_says():
    assert repr(BOXES) == "<calotte.Raster: 36 x 18 boxes, longitudes 0 to 360, latitudes -90 to 90 degrees>"
    width = calotte.widths.by_latitude([(-90, 300), (0, 500), (90, 300)]).sampled(10)
    assert repr(width) == ("<calotte.CellWidth: 36 x 19 nodes, longitudes -180 to 170, latitudes -90 to 90 degrees, cell "
                           "widths 300 to 500 km>")


# ---- Files

def history(path, mesh, xarray):
    """Fields without their mesh, as a model writes them."""
    depth = np.arange(4.0)
    values = mesh.points[:, 2] + np.arange(TIMES)[:, np.newaxis]
    fields = {"ssh": (("Time", "nCells"), values, {"units": "m"}),
              "theta": (("Time", "nCells", "nVertLevels"), values[:, :, np.newaxis] + 10 * depth),
              "mask": (("nCells",), (mesh.lon > 0).astype("i4")),
              "dcEdge": (("nEdges",), np.ones(1920))}
    xarray.Dataset(fields).to_netcdf(path, unlimited_dims="Time", format="NETCDF3_64BIT")
    return values


def test_fields_without_a_mesh(mesh, tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    mesh.to_mpas(tmp_path / "grid.nc", order="input")
    values = history(tmp_path / "history.nc", mesh, xarray)
    grid = calotte.read(tmp_path / "history.nc", mesh=tmp_path / "grid.nc", at={"time": -1, "lev": 2})
    assert len(grid) == 642 and set(grid.fields) == {"ssh", "theta", "mask"}
    assert (grid.fields["ssh"] == values[2]).all() and (grid.fields["theta"] == values[2] + 20).all()
    every = calotte.read(tmp_path / "history.nc", mesh=tmp_path / "grid.nc", fields="all")
    assert every.fields["theta"].shape == (642, 3, 4)
    assert set(calotte.read(tmp_path / "history.nc", mesh=tmp_path / "grid.nc").fields) == {"mask"}
    only = calotte.read_fields(tmp_path / "history.nc", mesh=tmp_path / "grid.nc", at={"Time": 1})
    assert set(only) == {"ssh", "mask"} and (only["ssh"] == values[1]).all()
    for at, text in (({"time": 3}, "indices 0 to 2"), ({"x": 0}, r"no field has a dimension x; there are Time \(3\)"),
                     ({"time": 0.5}, "give an index"), ({"time": 0, "TIME": 1}, "two indices of the dimension Time")):
        with pytest.raises(calotte.Error, match=text):
            calotte.read(tmp_path / "history.nc", mesh=tmp_path / "grid.nc", at=at)


def test_writing_fields_of_any_dimensions(mesh, tmp_path):
    xarray = pytest.importorskip("xarray")
    netcdf = pytest.importorskip("netCDF4")
    values = np.random.default_rng(1).random((TIMES, 642, 4))
    array = xarray.DataArray(values, dims=("time", "cell", "depth"), attrs={"units": "K", "standard_name": "s", "n": 3})
    mesh.to_mpas(tmp_path / "a.nc", order="input",
                 fields={"plain": values, "named": array, "levels": values[0], "times": values[:, :, 0], "one": values[0, :, 0]})
    with netcdf.Dataset(tmp_path / "a.nc") as file:
        assert file["plain"].dimensions == ("Time", "nCells", "levels") and (file["plain"][:] == values).all()
        assert file["named"].dimensions == ("time", "nCells", "depth") and (file["named"][:] == values).all()
        assert file["levels"].dimensions == ("nCells", "levels") and (file["levels"][:] == values[0]).all()
        assert file["times"].dimensions == ("Time", "nCells") and (file["times"][:] == values[:, :, 0]).all()
        assert file["named"].units == "K" and file["named"].standard_name == "s"
    again = calotte.read(tmp_path / "a.nc", fields="all")
    assert again.fields["named"].shape == (642, 3, 4) and again._content.dimensions["named"] == ("time", "depth")
    again.to_mpas(tmp_path / "b.nc", order="input")
    with netcdf.Dataset(tmp_path / "b.nc") as file:
        assert file["plain"].dimensions == ("Time", "nCells", "levels") and (file["plain"][:] == values).all()
    with pytest.raises(calotte.Error, match=r"the values of wrong have the shape \(3, 4\).*each of the 642 cells"):
        mesh.to_mpas(tmp_path / "never.nc", fields={"wrong": values[:, 0]})
    assert not (tmp_path / "never.nc").exists()


def test_the_order_of_cells(mesh, tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    latitude = calotte.interpolate(BOXES, xarray.DataArray(
        np.broadcast_to(BOXES.latitudes[:, np.newaxis], (18, 36)), dims=("lat", "lon"), name="warmth",
        coords={"lat": BOXES.latitudes, "lon": BOXES.longitudes}), mesh)
    dataset = mesh.to_xarray(fields={"warmth": latitude})
    assert np.allclose(np.degrees(dataset.latCell), mesh.lat) and (dataset.warmth == latitude.values).all()
    mesh.to_mpas(tmp_path / "curve.nc")
    mesh.to_mpas(tmp_path / "input.nc", order="input")
    latitude.to_netcdf(tmp_path / "history.nc")
    read = calotte.read(tmp_path / "history.nc", mesh=tmp_path / "input.nc")
    assert (read.fields["warmth"] == latitude.values).all() and np.abs(read.fields["warmth"] - read.lat).max() < 5
    with pytest.raises(calotte.Error, match=r"history.nc: cell \d+ is at longitude .*, latitude .*, and that of .*curve.nc at .*input"):
        calotte.read(tmp_path / "history.nc", mesh=tmp_path / "curve.nc")
    other = calotte.read(tmp_path / "curve.nc")
    for use in (lambda: calotte.interpolate(other, latitude, BOXES), lambda: other.plot(latitude),
                lambda: other.to_mpas(tmp_path / "x.nc", fields={"w": latitude})):
        with pytest.raises(calotte.Error, match=r"have cell \d+ at .*not in cell \d+ of the mesh"):
            use()
    radians = latitude.drop_vars(["lon", "lat"]).assign_coords(
        lonCell=("nCells", np.radians(mesh.lon), {"units": "radians"}), latCell=("nCells", np.radians(mesh.lat)))
    assert calotte.interpolate(mesh, radians, BOXES).shape == (18, 36)
    with pytest.raises(calotte.Error, match="not in cell"):
        calotte.interpolate(other, radians, BOXES)
    plain = latitude.drop_vars(["lon", "lat"])  # nothing to compare
    assert calotte.interpolate(other, plain, BOXES).shape == (18, 36)


def test_fields_that_a_format_does_not_hold(mesh, tmp_path):
    times = np.random.default_rng(2).random((TIMES, 642))
    for name, fields, text in (
            ("a.nc", {"latCell": times[0]}, "MPAS has a variable latCell of its own; give the field another"),
            ("a.vtp", {"h": times}, r"several numbers for each of the cells: Time \(3\)"),
            ("a.vtp", {"spacing": times[0]}, "VTK has a variable spacing of its own"),
            ("a.ply", {"h": times[0]}, "PLY holds no fields; write .nc,")):
        with pytest.raises(calotte.Error, match=text):
            calotte.write(tmp_path / name, mesh, fields=fields)
        assert not any(tmp_path.iterdir())


def test_missing_numbers_have_a_fill_value(mesh, tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    values = np.where(mesh.lat > 0, np.nan, mesh.lat)
    mesh.to_mpas(tmp_path / "a.nc", order="input", fields={"h": values})
    calotte.read(tmp_path / "a.nc").to_mpas(tmp_path / "b.nc", order="input")
    for name in ("a.nc", "b.nc"):
        with netcdf.Dataset(tmp_path / name) as file:
            assert "_FillValue" in file["h"].ncattrs() and (file["h"][:].mask == np.isnan(values)).all()


# ---- Pictures

def test_pictures_of_an_index(mesh, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    xarray = pytest.importorskip("xarray")
    matplotlib.use("agg")
    values = mesh.points[:, 2] + np.arange(TIMES)[:, np.newaxis]
    array = xarray.DataArray(values, dims=("time", "nCells"), name="ssh")

    def drawn(field, **options):
        axes = mesh.plot(field, coast=False, **options)
        found = axes.collections[0].get_array()
        label = axes.figure.axes[1].get_ylabel()
        matplotlib.pyplot.close(axes.figure)
        return (found.min().round(6), found.max().round(6)), label

    assert drawn(array, at={"time": 2}) == ((1, 3), "ssh at time=2")
    assert drawn(values, at={"axis 0": -1})[0] == (1, 3)
    assert drawn(values[1]) == ((0, 2), "")
    mesh.to_mpas(tmp_path / "a.nc", fields={"ssh": array, "flat": values[0]})
    grid = calotte.read(tmp_path / "a.nc", fields="all")
    matplotlib.pyplot.close(grid.plot("ssh", at={"Time": 1}).figure)
    for field, at, text in ((array, None, r"numbers for each cell: time \(3\); choose one index of each by at: time=0"),
                            (array, {"time": 3}, "indices 0 to 2"), (array, {"lev": 0}, "no dimension lev; it has time"),
                            (values[0], {"lev": 0}, "it has one number for each cell"), (None, {"time": 0}, "give the field"),
                            (values[:, :5], None, r"shape \(3, 5\)")):
        with pytest.raises(calotte.Error, match=text):
            mesh.plot(field, at=at)
