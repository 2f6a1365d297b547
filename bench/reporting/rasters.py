# SPDX-License-Identifier: GPL-3.0-or-later
"""Rasters of cell widths on longitudes and latitudes, as grids of climate models require them, and
their files: NetCDF as MPAS-Tools writes it, and JIGSAW's .msh."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "foreign"))
import netcdf3  # noqa: E402

RADIUS = 6371.0  # km


def unit(lon, lat):
    """The unit vector at a place in degrees."""
    lon, lat = math.radians(lon), math.radians(lat)
    return (math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def angle(a, b):
    return math.acos(max(-1.0, min(1.0, dot(a, b))))


def step(distance, beta, alpha, ratio):
    """The paper's density of a bump (Jacobsen et al., 2013, Sect. 4.3): 1 within beta, then falling
    to ratio^-4, where widths are that many times larger. Angles in radians."""
    least = ratio**-4
    return (math.tanh((beta - distance) / alpha) + 1) / 2 * (1 - least) + least


CENTRE = unit(270, 30)


def bump(ratio):
    return lambda x, _: 20 * step(angle(x, CENTRE), math.pi / 6, 0.2, ratio) ** -0.25


def by_latitude(_, latitude):
    """30 km at the equator and in polar seas, 60 km between."""
    poles = 1 / (1 + math.exp(-(latitude - 55) / 5)) + 1 / (1 + math.exp((latitude + 62) / 5))
    return 60 - 30 * math.exp(-((latitude / 15) ** 2)) - 25 * poles


def tropical_band(_, latitude):
    """30 km within some 25 degrees of the equator and 120 km beyond, over 12 degrees."""
    return 75 + 45 * math.tanh((abs(latitude) - 25) / 6)


def rossby(_, latitude):
    """The first baroclinic Rossby radius c/f with c = 2.5 m/s, at most 60 km at the equator."""
    coriolis = 2 * 7.292e-5 * math.sin(math.radians(latitude))
    return 1 / math.hypot(1 / 60, 1000 * coriolis / 2.5)


def coast():
    """15 km along a winding line, 120 km away from it."""
    line = [
        unit(-80 + 25 * math.sin(7 * k / 59), -50 + 105 * k / 59) for k in range(60)
    ]

    def width(x, _):
        px, py, pz = x
        nearest = max(px * a + py * b + pz * c for a, b, c in line)
        distance = RADIUS * math.acos(max(-1.0, min(1.0, nearest)))
        return 15 + 105 * 0.5 * (1 + math.tanh((distance - 900) / 350))

    return width


WIDTHS = {
    "x4": bump(4),
    "x8": bump(8),
    "latitude": by_latitude,
    "band": tropical_band,
    "rossby": rossby,
    "coast": coast(),
}


class Raster:
    """Widths in km at nodes from -180 to 180 E and -90 to 90 N, both included."""

    def __init__(self, lon, lat, rows):
        self.lon, self.lat = lon, lat  # degrees
        self.rows = rows  # by latitude, then longitude

    def cells(self):
        """The number of cells that the widths imply: a hexagon of width h has the area
        sqrt(3)/2 h^2."""
        across = math.radians(self.lon[1] - self.lon[0])
        total = 0.0
        for latitude, row in zip(self.lat, self.rows):
            half = math.radians(self.lat[1] - self.lat[0]) / 2
            middle = math.radians(latitude)
            south, north = max(middle - half, -math.pi / 2), min(middle + half, math.pi / 2)
            band = (math.sin(north) - math.sin(south)) * across
            total += band * sum(1 / (h * h) for h in row[:-1])
        return 2 / math.sqrt(3) * RADIUS**2 * total

    def scaled(self, factor):
        return Raster(self.lon, self.lat, [[factor * h for h in row] for row in self.rows])

    def with_cells(self, count):
        """The same widths times a factor, so that they imply so many cells."""
        return self.scaled(math.sqrt(self.cells() / count))

    def write_netcdf(self, path):
        netcdf3.write(
            path,
            {"lat": len(self.lat), "lon": len(self.lon)},
            {
                "lat": (["lat"], self.lat, {"units": "degrees_north"}),
                "lon": (["lon"], self.lon, {"units": "degrees_east"}),
                "cellWidth": (
                    ["lat", "lon"],
                    [h for row in self.rows for h in row],
                    {"units": "km"},
                ),
            },
        )

    def write_jigsaw(self, path):
        with open(path, "w", encoding="ascii") as out:
            out.write("mshid=3;ellipsoid-grid\nndims=2\n")
            for axis, values in ((1, self.lon), (2, self.lat)):
                out.write(f"coord={axis};{len(values)}\n")
                out.writelines(f"{math.radians(v)!r}\n" for v in values)
            out.write(f"value={len(self.lon) * len(self.lat)};1\n")
            for column in range(len(self.lon)):
                out.writelines(f"{row[column]:.8f}\n" for row in self.rows)


def make_raster(name, degrees=0.5):
    """One of WIDTHS on a grid of so many degrees, which divide 180."""
    width = WIDTHS[name]
    half = round(180 / degrees)
    lon = [-180 + degrees * i for i in range(2 * half + 1)]
    lat = [-90 + degrees * j for j in range(half + 1)]
    rows = []
    for latitude in lat:
        row = [width(unit(longitude, latitude), latitude) for longitude in lon[:-1]]
        rows.append(row + row[:1])
    return Raster(lon, lat, rows)
