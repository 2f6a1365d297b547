# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids of a part of the sphere, and cells of any shape, as files of the command hold them."""
import json
import math
import os
import pickle
import pydoc
import subprocess
import sys

import numpy as np
import pytest

import calotte

COMMAND = os.environ.get("CALOTTE_COMMAND", "calotte")
LAND = {"type": "Polygon",  # a quarter of the sphere, whose sides are great circles
        "coordinates": [[[0, -90], [0, 0], [0, 90], [90, 0], [0, -90]]]}


def run(*words):
    result = subprocess.run([COMMAND, *map(str, words)], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    return result.stdout


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A globe, an ocean and a limited area, with a field."""
    folder = tmp_path_factory.mktemp("grids")
    grid = calotte.cvt(2562)
    latitude = calotte.to_lonlat(grid.mesh.points)[:, 1]
    grid.mesh.to_mpas(folder / "globe.nc", sphere_radius=6371229.0, fields={"latitude": latitude})
    (folder / "land.geojson").write_text(json.dumps(LAND))
    calotte.cull(folder / "globe.nc", folder / "ocean.nc", land=folder / "land.geojson")
    calotte.cut(folder / "globe.nc", folder / "area.nc", "circle=178,60,2500km",
                sphere_radius=None)
    return folder


@pytest.mark.parametrize("name", ["ocean.nc", "area.nc"])
def test_a_part_of_the_sphere_has_the_cells_of_its_file(files, name):
    netcdf = pytest.importorskip("netCDF4")
    grid = calotte.read(files / name)
    cells = calotte.voronoi(grid)
    with netcdf.Dataset(files / name) as file:
        radius, counts = file.sphere_radius, file["nEdgesOnCell"][:]
        areas, mpas_vertices = file["areaCell"][:] / radius**2, file.dimensions["nVertices"].size
    order = np.argsort(areas)
    assert len(grid.cells) == len(areas) and not grid.closed
    assert np.allclose(np.sort(cells.cell_area), areas[order], rtol=1e-9)
    assert np.allclose(np.sort(grid.cells.areas), areas[order], rtol=1e-9)
    assert cells.cell_area.sum() == pytest.approx(areas.sum(), rel=1e-12)
    assert sorted(np.diff(cells.begin)) == sorted(counts)
    assert len(cells.vertices) == mpas_vertices
    assert (cells.cells_on_edge[:, 1] == -1).sum() > 20  # the boundary
    assert repr(grid).endswith("polygons>") and "cells" in repr(grid.cells)


@pytest.mark.parametrize("name", ["ocean.nc", "area.nc"])
def test_it_is_written_with_its_fields_and_radius(files, tmp_path, name):
    netcdf = pytest.importorskip("netCDF4")
    grid = calotte.read(files / name)
    assert np.allclose(grid.fields["latitude"], calotte.to_lonlat(grid.points)[:, 1])
    with pytest.raises(TypeError):
        grid.fields["other"] = 1
    grid.to_mpas(tmp_path / "again.nc")
    run("check", tmp_path / "again.nc")
    run("convert", files / name, tmp_path / "command.nc")
    with netcdf.Dataset(tmp_path / "command.nc") as a, netcdf.Dataset(tmp_path / "again.nc") as b:
        assert a.sphere_radius == b.sphere_radius == 6371229.0
        assert set(a.variables) == set(b.variables)
        for field in a.variables:
            assert (a[field][:] == b[field][:]).all(), field
    grid.to_mpas(tmp_path / "unit.nc", sphere_radius=1.0, fields={"more": np.arange(len(grid))})
    assert calotte.read_fields(tmp_path / "unit.nc").keys() >= {"latitude", "more"}
    for suffix in ("vtp", "geojson"):
        calotte.write(tmp_path / f"grid.{suffix}", grid)


def test_it_becomes_a_dataset(files):
    pytest.importorskip("xarray")
    pytest.importorskip("netCDF4")
    grid = calotte.read(files / "ocean.nc")
    for kind, dimension in (("mpas", "nCells"), ("ugrid", "nMesh2_face"), ("scrip", "grid_size")):
        dataset = grid.to_xarray(kind)
        assert len(grid) in dataset.sizes.values(), (dimension, dataset.sizes)
        assert "latitude" in dataset or kind == "scrip"
    topology = grid.topology()
    assert topology["face_node_connectivity"].shape[0] == len(grid)


def polygons_of(grid):
    return grid if isinstance(grid, calotte.Polygons) else grid.cells


def test_cells_of_any_shape(tmp_path):
    """Latitudes and longitudes: quadrilaterals that are no Voronoi cells."""
    netcdf = pytest.importorskip("netCDF4")
    lon, lat = np.arange(0, 360, 30.0), np.arange(-60, 60, 20.0)
    with netcdf.Dataset(tmp_path / "scrip.nc", "w") as file:
        file.createDimension("grid_size", lon.size * lat.size)
        file.createDimension("grid_corners", 4)
        file.createDimension("grid_rank", 2)
        file.createVariable("grid_dims", "i4", ("grid_rank",))[:] = [lon.size, lat.size]
        places = np.array([(x, y) for y in lat for x in lon])
        for name, values in (("lon", places[:, 0] + 15), ("lat", places[:, 1] + 10)):
            variable = file.createVariable(f"grid_center_{name}", "f8", ("grid_size",))
            variable.units = "degrees"
            variable[:] = values
        for k, (name, steps) in enumerate((("lon", (0, 30, 30, 0)), ("lat", (0, 0, 20, 20)))):
            variable = file.createVariable(f"grid_corner_{name}", "f8",
                                           ("grid_size", "grid_corners"))
            variable.units = "degrees"
            variable[:] = places[:, [k]] + steps
        file.createVariable("grid_imask", "i4", ("grid_size",))[:] = 1
    grid = calotte.read(tmp_path / "scrip.nc")
    cells = polygons_of(grid)
    assert len(cells) == 72 and cells.surface.is_sphere
    # The spherical excess of a quadrilateral with sides of great circles, by its four angles.
    corners = calotte.from_lonlat([0, 30, 30, 0], [0, 0, 20, 20])
    angles = 0.0
    for k in range(4):
        at, following, before = corners[k], corners[(k + 1) % 4], corners[k - 1]
        a, b = np.cross(at, following), np.cross(at, before)
        angles += math.acos(a @ b / np.linalg.norm(a) / np.linalg.norm(b))
    middle = np.flatnonzero(np.isclose(np.abs(calotte.to_lonlat(cells.centres)[:, 1]), 10))
    assert len(middle) == 24 and np.allclose(cells.areas[middle], angles - 2 * math.pi)
    with pytest.raises(calotte.Error, match="not Voronoi cells"):
        calotte.voronoi(grid)
    with pytest.raises(calotte.Error, match="MPAS needs Voronoi cells"):
        grid.to_mpas(tmp_path / "no.nc")
    shapes = cells.shapes()
    assert shapes.not_convex == 0 and shapes.area.max == pytest.approx(cells.areas.max())
    assert "not centroidal" in repr(shapes)
    if grid is cells:
        with pytest.raises(calotte.Error, match="polygons have no triangles"):
            calotte.quality(grid)
    calotte.write(tmp_path / "again.nc", grid, format="ugrid")
    assert len(polygons_of(calotte.read(tmp_path / "again.nc")).areas) == 72


def test_the_cells_of_a_plane_need_a_surface_with_an_end():
    mesh = calotte.delaunay([(0, 0), (1, 0), (0, 1), (1, 1), (0.5, 0.4)], calotte.plane())
    with pytest.raises(calotte.Error, match="give surface="):
        calotte.voronoi(mesh)
    cells = calotte.voronoi(mesh, calotte.rectangle((-1, -1), (2, 2)))
    assert cells.cell_area.sum() == pytest.approx(9)


def test_the_cells_of_sites_in_a_hemisphere():
    mesh = calotte.delaunay([(0, 50), (90, 50), (180, 50), (270, 50), (30, 70)], calotte.Surface())
    cells = calotte.voronoi(mesh)
    assert cells.cell_area.sum() == pytest.approx(4 * math.pi) and len(cells.vertices) == 6
    three = calotte.voronoi(calotte.delaunay(calotte.random_points(3)))
    assert three.cell_area.sum() == pytest.approx(4 * math.pi) and len(three.vertices) == 2
    ends = calotte.cvt(300, surface=calotte.polygon(
        [(0, 0), (60, 0), (60, 10), (30, 12), (60, 14), (60, 40), (0, 40)])).mesh
    with pytest.raises(calotte.Error, match="into several parts"):
        calotte.voronoi(ends)


def test_a_region_clips_its_cells(tmp_path):
    region = calotte.circle((10, 50), "1000km")
    mesh = calotte.cvt(200, surface=region).mesh
    assert calotte.voronoi(mesh).cell_area.sum() == pytest.approx(region.area, rel=1e-12)
    calotte.write(tmp_path / "sea.nc", mesh)
    read = calotte.voronoi(calotte.read(tmp_path / "sea.nc"))
    assert read.cell_area.sum() == pytest.approx(region.area, rel=5e-3)


# ---- What is kept and shown

def same(a, b):
    assert type(a) is type(b)
    if isinstance(a, np.ndarray):
        assert a.dtype == b.dtype and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    elif isinstance(a, list):
        assert len(a) == len(b)
        for p, q in zip(a, b):
            same(p, q)
    elif isinstance(a, (int, float, str, bool, type(None))):
        assert a == b or (a != a and b != b)
    elif hasattr(a, "items"):
        assert a.keys() == b.keys()
        for name in a.keys():
            same(a[name], b[name])
    else:
        names = [name for name in dir(a)
                 if not name.startswith("_") and hasattr(a, name) and not callable(getattr(a, name))]
        assert names or repr(a) == repr(b)
        for name in names:
            same(getattr(a, name), getattr(b, name))


def results(files):
    grid = calotte.cvt(200, density="x4")
    domain = calotte.planar_polygon([(0, 0), (2, 0), (2, 1)])
    box = calotte.cvt(100, surface=calotte.periodic_box(2, 1))
    return [grid, grid.mesh, calotte.voronoi(grid.mesh), calotte.quality(grid.mesh),
            calotte.quality(grid.mesh).spacing, calotte.check(grid.mesh),
            calotte.operator_errors(grid.mesh), box, calotte.quality(box.mesh), domain,
            calotte.circle((0, 0), 10), calotte.plan(120.0), calotte.read(files / "ocean.nc"),
            calotte.read(files / "ocean.nc").cells]


def test_results_can_be_pickled(files):
    for value in results(files):
        same(value, pickle.loads(pickle.dumps(value)))
    error = pickle.loads(pickle.dumps(calotte.Error("what is wrong")))
    assert isinstance(error, calotte.Error) and str(error) == "what is wrong"
    again = pickle.loads(pickle.dumps(calotte.read(files / "ocean.nc")))
    assert calotte.voronoi(again).cell_area.sum() > 8


def test_results_show_themselves_in_a_line(files):
    for value in results(files) + [calotte.Density(), calotte.density("x8")]:
        line = repr(value)
        assert len(line) < 160 and "\n" not in line and " at 0x" not in line and "[" not in line
        table = getattr(value, "_repr_html_", lambda: "")()
        assert "nan nan" not in table and len(table) < 150_000
    assert repr(calotte.cvt(642)).startswith("<calotte.Cvt: 642 cells, converged after ")
    assert repr(calotte.circle((0, 0), 10)) == \
        "<calotte.Surface: 1 ring, 360 corners, 0.09545 steradians>"


def test_lengths_are_shown_in_km_where_the_planet_is_known(tmp_path):
    points, earth = calotte.cvt(642).mesh, calotte.cvt(cell_width="960km").mesh
    mars = calotte.cvt(cell_width="960km", earth_radius=3390).mesh
    assert (points.earth_radius, earth.earth_radius, mars.earth_radius) == (None, 6371, 3390)
    measured = calotte.quality(earth)
    assert (measured.unit.name, measured.unit.area, measured.unit.of_radian) == ("km", "km^2", 6371)
    assert f"spacing {measured.spacing.min * 6371:.4g} to " in repr(measured) and " km, " in repr(measured)
    assert pickle.loads(pickle.dumps(measured)).unit.name == "km"
    assert " degrees, " in repr(calotte.quality(points))
    assert " radians, " in repr(calotte.quality(earth, units="radians"))
    plane = calotte.cvt(100, surface=calotte.periodic_box(2, 1)).mesh
    assert calotte.quality(plane).unit is None and plane.earth_radius is None
    with pytest.raises(calotte.Error, match="radius"):
        calotte.quality(points, units="km")
    with pytest.raises(calotte.Error, match="plane"):
        calotte.quality(plane, units="km")
    with pytest.raises(calotte.Error, match="give km, degrees or radians"):
        calotte.quality(points, units="miles")
    for name, mesh, options, radius in (
            ("a.nc", earth, {}, 6371), ("b.nc", points, {}, None), ("c.nc", mars, {"format": "ugrid"}, 3390),
            ("d.nc", points, {"model": "mpas-atmosphere"}, 6371.229),
            ("e.nc", points, {"model": "mpas-ocean"}, 6371.22),
            ("f.nc", points, {"sphere_radius": 2e6}, 2000), ("g.vtp", earth, {}, None)):
        calotte.write(tmp_path / name, mesh, **options)
        assert calotte.read(tmp_path / name).earth_radius == radius, name
    again = calotte.read(tmp_path / "a.nc")
    assert calotte.refine(again, region="circle=0,0,3000km", factor=1.3).mesh.earth_radius == 6371
    assert calotte.refine(earth, region="circle=0,0,3000km", factor=1.3).mesh.earth_radius == 6371
    assert pickle.loads(pickle.dumps(again)).earth_radius == 6371
    calotte.cut(tmp_path / "a.nc", tmp_path / "part.nc", "circle=0,0,3000km", rings=2)
    shapes = calotte.read(tmp_path / "part.nc").cells.shapes()
    assert f"area {shapes.area.min * 6371**2:.4g} to " in repr(shapes) and " km^2, " in repr(shapes)


def test_every_attribute_has_documentation():
    for kind in (calotte.Mesh, calotte.Polygons, calotte.Voronoi, calotte.Quality, calotte.Check,
                 calotte.OperatorErrors, calotte.Surface, calotte.CellWidth, calotte.Density):
        assert kind.__doc__
        for name, member in vars(kind).items():
            if not name.startswith("_"):
                assert member.__doc__, f"{kind.__name__}.{name}"


def test_help_is_readable():
    text = pydoc.plain(pydoc.render_doc(calotte.cvt))
    assert "Union" not in text and "numpy.typing" not in text and "fixed: generators" in text


def test_submodules_load_on_access():
    code = ("import calotte, sys; assert 'calotte.scipy' not in sys.modules\n"
            "assert {'scipy', 'stripy', 'mpas_tools'} <= set(dir(calotte))\n"
            "calotte.scipy.SphericalVoronoi, calotte.stripy.sTriangulation\n"
            "calotte.mpas_tools.build_spherical_mesh\n"
            "try:\n    calotte.numpy\nexcept AttributeError as error:\n"
            "    assert 'numpy' in str(error)\nelse:\n    sys.exit(1)\n")
    subprocess.run([sys.executable, "-c", code], check=True)


# ---- Pictures

def test_pictures(files, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt
    grid = calotte.cvt(642)
    for draw, cells in (
            (lambda: grid.plot(), 642),
            (lambda: grid.mesh.plot("area", coast=False, edgecolor="k"), 642),
            (lambda: grid.plot(np.arange(642.0), view=(10, 50)), 321),
            (lambda: calotte.read(files / "ocean.nc").plot("latitude"), 1800),
            (lambda: calotte.read(files / "area.nc").plot(), 100),
            (lambda: calotte.read(files / "area.nc").cells.plot(), 100),
            (lambda: calotte.cvt(100, surface=calotte.rectangle((0, 0), (2, 1))).plot(), 100),
            (lambda: calotte.cvt(100, surface=calotte.periodic_box(2, 1)).plot(), 100),
            (lambda: calotte.cvt(100, surface=calotte.circle((0, 0), 20)).plot(), 50)):
        axes = draw()
        shapes = axes.collections[0]
        assert len(shapes.get_paths()) > 0.8 * cells
        assert len(shapes.get_array()) == len(shapes.get_paths())
        axes.figure.savefig(tmp_path / "picture.png")
        plt.close(axes.figure)
    earth = calotte.cvt(cell_width="960km")
    for draw, label in ((lambda: grid.plot(), "cell width, degrees"),
                        (lambda: grid.plot("area", earth_radius=6371), "cell area, km^2"),
                        (lambda: earth.plot("area"), "cell area, km^2"),
                        (lambda: earth.plot(units="radians"), "cell width, radians")):
        axes = draw()
        assert axes.figure.axes[1].get_ylabel() == label
        plt.close(axes.figure)
    with pytest.raises(calotte.Error, match="no field salinity"):
        calotte.read(files / "ocean.nc").plot("salinity")
    with pytest.raises(calotte.Error, match="give a number, or an array of them, for each"):
        grid.plot(np.ones(3))
    with pytest.raises(calotte.Error, match="the radius of the sphere is -1 km; give a positive number"):
        grid.plot(earth_radius=-1)
    plt.close("all")


def test_a_map_covers_the_earth():
    """The areas of the polygons of a map, clipped to it, are those of its rectangle."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    import matplotlib.pyplot as plt
    axes = calotte.cvt(642).plot(coast=False)
    figure = axes.figure
    axes.set_axis_off()
    axes.collections[0].set(facecolor="black", edgecolor="black", array=None)
    figure.canvas.draw()
    box = axes.get_window_extent().extents.astype(int)
    image = np.asarray(figure.canvas.buffer_rgba())[::-1, :, 0]
    inside = image[box[1] + 2:box[3] - 2, box[0] + 2:box[2] - 2]
    assert (inside < 128).mean() > 0.999
    plt.close("all")


def test_a_model_sets_the_order_of_the_vertices_around_cells(tmp_path):
    netcdf = pytest.importorskip("netCDF4")
    mesh = calotte.cvt(2562).mesh

    def before_edges(name):
        """Whether edge k of the first cell lies between vertices k and k + 1."""
        with netcdf.Dataset(tmp_path / name) as file:
            ends = set(file["verticesOnEdge"][file["edgesOnCell"][0, 0] - 1])
            return ends == set(file["verticesOnCell"][0, :2])

    mesh.to_mpas(tmp_path / "plain.nc")
    mesh.to_mpas(tmp_path / "air.nc", model="mpas-atmosphere")
    mesh.to_mpas(tmp_path / "sea.nc", model="mpas-ocean")
    assert [before_edges(name + ".nc") for name in ("plain", "air", "sea")] == [False, True, False]
    calotte.read(tmp_path / "air.nc").to_mpas(tmp_path / "again.nc")
    calotte.cut(tmp_path / "plain.nc", tmp_path / "part.nc", "circle=10,20,3000km")
    calotte.cut(tmp_path / "air.nc", tmp_path / "ocean.nc", "circle=10,20,3000km", model="mpas-ocean")
    assert before_edges("again.nc") and before_edges("part.nc") and not before_edges("ocean.nc")
    assert calotte.read(tmp_path / "ocean.nc").to_xarray().sphere_radius == 6371220
    with pytest.raises(calotte.Error, match="mpas-atmosphere needs a sphere with another radius"):
        mesh.to_mpas(tmp_path / "bad.nc", model="mpas-atmosphere", sphere_radius=6371220.0)
    with pytest.raises(calotte.Error, match="model fesom reads the format fesom, not mpas"):
        mesh.to_mpas(tmp_path / "bad.nc", model="fesom")
    with pytest.raises(calotte.Error, match="no model wrf; give one of: mpas-atmosphere"):
        mesh.to_mpas(tmp_path / "bad.nc", model="wrf")
