# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects of shapely, geopandas and xarray in place of files, and results as such objects."""
import json

import numpy as np
import pytest

import calotte
from calotte import widths

SQUARE = {"type": "Polygon", "coordinates": [[(0, 0), (20, 0), (20, 20), (0, 20), (0, 0)], [(5, 5), (5, 9), (9, 9), (9, 5), (5, 5)]]}
LINE = {"type": "LineString", "coordinates": [(0, 0), (10, 10)]}


class Geometry:
    """What any package has that knows geometries."""

    def __init__(self, given):
        self.__geo_interface__ = given


class Frame(Geometry):
    """What geopandas has beside it."""

    def __init__(self, features, geographic):
        super().__init__({"type": "FeatureCollection", "features": features})
        self.crs = type("CRS", (), {"is_geographic": geographic})()


def feature(geometry, **properties):
    return {"type": "Feature", "id": "0", "properties": properties, "geometry": geometry, "bbox": (0, 0, 1, 1)}


@pytest.fixture(name="square")
def square_file(tmp_path):
    path = tmp_path / "square.geojson"
    path.write_text(json.dumps(SQUARE))
    return path


def test_regions(square):
    mesh = calotte.delaunay(calotte.fibonacci_sphere(2000))
    expected = calotte.polygon(square)
    times = np.datetime64("2026-01-01"), np.float64("nan"), np.int64(3)
    for given in (SQUARE, Geometry(SQUARE), feature(SQUARE), Frame([feature(SQUARE, time=times[0], x=times[1], n=times[2])], True),
                  [Geometry(SQUARE)]):
        assert calotte.polygon(given) == expected
    assert len(calotte.refine(mesh, region=Geometry(SQUARE), factor=2).mesh) > len(mesh)
    points = calotte.random_points(20, Geometry(SQUARE))
    assert expected.contains(points).all()


def test_many_geometries():
    squares = [{"type": "Polygon", "coordinates": [[(x, y), (x + .5, y), (x + .5, y + .5), (x, y + .5), (x, y)]]}
               for x in range(-60, 60) for y in range(-5, 5)]
    assert len(calotte.polygon([Geometry(each) for each in squares]).rings) == 1200
    assert calotte.polygon(Geometry(squares[0]), Geometry(squares[25])) == calotte.polygon([squares[0], squares[25]])
    with pytest.raises(calotte.Error, match="rings are geometries and others"):
        calotte.polygon(Geometry(SQUARE), [(40, 0), (50, 0), (50, 10)])


def test_geometries_are_made_once():
    class Counted:
        made = 0

        @property
        def __geo_interface__(self):
            Counted.made += 1
            return SQUARE

    calotte.polygon(Counted())
    assert Counted.made == 1


def test_planes(square):
    expected = calotte.planar_polygon(square)
    assert calotte.planar_polygon(Geometry(SQUARE)) == expected
    assert calotte.planar_polygon(Frame([feature(SQUARE)], False)) == expected  # in metres, say


def test_lines_and_coasts(square):
    at = [0, 15, 40], [0, 2, 50]
    by_file = widths.by_distance(str(square), profile=[(-500, 20), (1000, 100)])
    by_object = widths.by_distance(Geometry(SQUARE), profile=[(-500, 20), (1000, 100)])
    assert (by_file(*at) == by_object(*at)).all()
    line = np.array(LINE["coordinates"], float)
    for given in (Geometry(LINE), LINE, [Geometry(LINE), Geometry(LINE)]):
        assert (widths.by_distance(given, 10, 60, 500)(*at) == widths.by_distance(line, 10, 60, 500)(*at)).all()
    sea = calotte.generalised_sea(Geometry(SQUARE), 500)
    assert sea.sea == calotte.generalised_sea(square, 500).sea
    assert calotte.generalised_sea([Geometry(SQUARE)], 500, passages=Geometry(LINE)).sea.area > sea.sea.area
    run = calotte.cvt(300, lines=Geometry(LINE))
    assert len(run.mesh) > 200
    other = np.array([(30, 0), (40, 10)], float)
    both = widths.by_distance([line, other], 10, 60, 500)
    for given in (other, calotte.from_lonlat(*other.T)):  # beside a geometry
        mixed = widths.by_distance([Geometry(LINE), given], 10, 60, 500)
        assert np.allclose(mixed(*at), both(*at), rtol=1e-12)
    xarray = pytest.importorskip("xarray")
    assert calotte.polygon(xarray.DataArray([(0, 0), (9, 0), (0, 9)])) == calotte.polygon([(0, 0), (9, 0), (0, 9)])


def test_errors_name_the_object():
    cases = [(Frame([feature(SQUARE)], False), "surface is the Frame of projected coordinates; .*to_crs"),
             (Frame([], True), "the Frame: "), (Geometry(LINE), "the Geometry: "),
             ([Frame([feature(SQUARE)], False)], r"surface\[0\] is the Frame of projected coordinates; .*to_crs"),
             ({"type": "FeatureCollection"}, 'the GeoJSON: no array "features"'),
             (Geometry({"type": "Polygon", "coordinates": [[(0, 0), (5, float("nan")), (5, 5)]]}),
              "feature 0: position 1 of ring 0 is not a position"),
             (feature(None), "the GeoJSON: "), ([Geometry(SQUARE), Geometry({"type": "Polygon", "coordinates": [[(0, 95)]]})],
                                                "the list of the Geometry: feature 1")]
    for given, text in cases:
        with pytest.raises(calotte.Error, match=text):
            calotte.random_points(5, given)
    with pytest.raises(calotte.Error, match="leave inside out"):
        calotte.polygon(Geometry(SQUARE), inside=(1, 1))


def test_rasters(tmp_path):
    xarray = pytest.importorskip("xarray")
    latitudes, longitudes = np.arange(-87.5, 90, 5), np.arange(2.5, 360, 5)
    heights = 3000 * np.sin(np.radians(latitudes))[:, None] * np.cos(np.radians(longitudes)) - 200
    array = xarray.DataArray(heights, {"lat": latitudes, "lon": longitudes}, ("lat", "lon"), "z", {"units": "m"})
    array.to_netcdf(tmp_path / "z.nc")
    at = np.arange(-180, 180, 30.), np.arange(-60, 60, 10.)
    expected = widths.by_depth(str(tmp_path / "z.nc"), 20, cells=60, period="12.42h")(*at)
    for given in (array, array.transpose("lon", "lat"), array[::-1]):
        assert np.array_equal(widths.by_depth(given, 20, cells=60, period="12.42h")(*at), expected, equal_nan=True)
    calotte.write(tmp_path / "m.nc", calotte.delaunay(calotte.fibonacci_sphere(600)), format="mpas")
    counts = [calotte.cull(tmp_path / "m.nc", tmp_path / f"{k}.nc", raster=given)
              for k, given in enumerate((tmp_path / "z.nc", array, array.transpose("lon", "lat")))]
    assert counts[0] == counts[1] == counts[2]


def test_rasters_that_are_none():
    xarray = pytest.importorskip("xarray")
    values = np.ones((3, 4))
    coordinates = {"lat": [-60., 0, 60], "lon": [0., 90, 180, 270]}
    cases = [(xarray.DataArray(values, dims=("y", "x")), r"dimensions \('y', 'x'\); name one of them lat"),
             (xarray.DataArray(values, coordinates, ("lat", "lon"), attrs={"of": {}}), "cannot be written to NetCDF: ")]
    for given, text in cases:
        with pytest.raises(calotte.Error, match=text) as refusal:
            widths.by_depth(given, 20, slope=6)
        assert "\n" not in str(refusal.value)
    with pytest.raises(calotte.Error, match="raster is an array of the shape .3, 4.; give the name of a file"):
        calotte.cull("a.nc", "b.nc", raster=values)
    once = xarray.DataArray(300 * values, coordinates, ("lat", "lon"))
    assert calotte.plan(once.expand_dims("time")).cells == calotte.plan(once).cells
    with pytest.raises(calotte.Error, match="isel"):
        calotte.plan(xarray.concat([once, once], "time"))


def test_shapely():
    shapely = pytest.importorskip("shapely.geometry")
    region = calotte.polygon(shapely.box(0, 0, 20, 10))
    assert abs(region.area / calotte.polygon([(0, 0), (20, 0), (20, 10), (0, 10)]).area - 1) < 1e-14
    parts = calotte.polygon(shapely.MultiPolygon([shapely.box(0, 0, 5, 5), shapely.box(10, 0, 15, 5)]))
    assert len(parts.rings) == 2


def test_graphs():
    mesh = calotte.delaunay(calotte.random_points(300))
    around = calotte.neighbours(mesh)
    pytest.importorskip("scipy")
    matrix = mesh.to_scipy_sparse()
    assert matrix.shape == (300, 300) and matrix.nnz == 2 * (3 * 300 - 6) and (matrix != matrix.T).nnz == 0
    assert sorted(around[17]) == matrix[[17]].indices.tolist()
    networkx = pytest.importorskip("networkx")
    graph = mesh.to_networkx()
    assert len(graph) == 300 and graph.number_of_edges() == 3 * 300 - 6 and networkx.is_connected(graph)


def test_geodataframe():
    geopandas = pytest.importorskip("geopandas")
    mesh = calotte.delaunay(calotte.fibonacci_sphere(100))
    frame = mesh.to_geodataframe()
    assert isinstance(frame, geopandas.GeoDataFrame) and len(frame) == 100 and frame.crs.to_epsg() == 4326
    assert frame.is_valid.all() and frame.total_bounds.tolist() == [-180, -90, 180, 90]
    assert frame["id"].tolist() == list(range(100)) and abs(frame["area"].sum() / (4 * np.pi) - 1) < 1e-9
    region = calotte.polygon(SQUARE)
    back = calotte.polygon(region.to_geodataframe())
    assert abs(back.area / region.area - 1) < 1e-12
    plane = calotte.delaunay(calotte.random_points(30, calotte.rectangle((0, 0), (1, 1))), calotte.rectangle((0, 0), (1, 1)))
    assert plane.to_geodataframe().crs is None


def test_regions_are_valid_in_the_plane():
    geopandas = pytest.importorskip("geopandas")
    triangle = calotte.polygon([(0, 60), (90, 60), (180, 60)])  # an edge through the pole
    for region, area in ((calotte.circle((0, 90), 20), 7200), (calotte.circle((0, -90), 20), 7200), (calotte.box(170, -10, 190, 10), 400),
                         (calotte.channel(-30, 40), 25200), (calotte.box(-20, 60, 40, 90), 1800), (triangle, 5400),
                         (calotte.circle((30, 85), 20), None), (calotte.circle((180, 0), 5), None)):
        frame = region.to_geodataframe()
        assert isinstance(frame, geopandas.GeoDataFrame) and len(frame) == 1 and frame.is_valid.all()
        west, south, east, north = frame.total_bounds
        assert -180 <= west < east <= 180 and -90 <= south < north <= 90
        if area:
            assert abs(frame.geometry.iloc[0].area / area - 1) < 1e-9
        assert abs(calotte.polygon(frame).area / region.area - 1) < 1e-9
    sea = calotte.generalised_sea(SQUARE, 500).sea.to_geodataframe()  # all but an island
    assert sea.is_valid.all() and sea.total_bounds.tolist() == [-180, -90, 180, 90] and 64000 < sea.geometry.iloc[0].area < 64700
