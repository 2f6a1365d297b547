# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the rasters of bench/widths: python3 -m unittest reporting.rasters_test (in bench/)."""

import math
import tempfile
import unittest
from pathlib import Path

from reporting import rasters
from reporting.rasters import RADIUS, Raster, make_raster


def even(width):
    lon, lat = [-180 + 10 * i for i in range(37)], [-90 + 10 * j for j in range(19)]
    return Raster(lon, lat, [[width] * 37 for _ in lat])


class Laws(unittest.TestCase):
    def test_even_widths_imply_the_sphere_over_a_hexagon(self):
        hexagon = math.sqrt(3) / 2 * 100**2
        self.assertAlmostEqual(even(100.0).cells() * hexagon / (4 * math.pi * RADIUS**2), 1, 12)

    def test_all_names_scale_to_the_cells_asked_for_and_close_at_180_degrees(self):
        for name in rasters.WIDTHS:
            raster = make_raster(name, 10).with_cells(5000)
            self.assertAlmostEqual(raster.cells() / 5000, 1, 9, name)
            for row in raster.rows:
                self.assertEqual(row[0], row[-1], name)
                self.assertGreater(min(row), 0, name)

    def test_bumps_are_as_fine_as_their_names(self):
        for ratio in (4, 8):
            widths = [h for row in make_raster(f"x{ratio}", 5).rows for h in row]
            self.assertAlmostEqual(max(widths) / min(widths) / ratio, 1, 1)


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = Path(self.folder.name) / "widths"
        self.raster = make_raster("coast", 30)

    def test_netcdf_has_the_widths_by_latitude_then_longitude(self):
        self.raster.write_netcdf(self.path)
        file = rasters.netcdf3.File(self.path)
        dims, values = file.variables["cellWidth"]
        self.assertEqual(dims, ["lat", "lon"])
        self.assertEqual(list(values), [h for row in self.raster.rows for h in row])
        self.assertEqual(list(file.values("lat")), self.raster.lat)

    def test_jigsaw_has_the_widths_by_longitude_then_latitude(self):
        self.raster.write_jigsaw(self.path)
        lines = self.path.read_text().splitlines()
        columns, rows = len(self.raster.lon), len(self.raster.lat)
        self.assertEqual(lines[:3], ["mshid=3;ellipsoid-grid", "ndims=2", f"coord=1;{columns}"])
        self.assertAlmostEqual(float(lines[3]), -math.pi)
        begin = lines.index(f"value={columns * rows};1") + 1
        self.assertAlmostEqual(float(lines[begin + rows + 2]), self.raster.rows[2][1], 7)
        self.assertEqual(len(lines), begin + columns * rows)


if __name__ == "__main__":
    unittest.main()
