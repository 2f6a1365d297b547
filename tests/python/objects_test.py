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


def test_errors_name_the_object():
    cases = [(Frame([feature(SQUARE)], False), "surface is the Frame of projected coordinates; .*to_crs"),
             (Frame([], True), "the Frame: "), (Geometry(LINE), "the Geometry: "),
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
