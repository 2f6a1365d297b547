# SPDX-License-Identifier: GPL-3.0-or-later
"""The sea of a grid that ends at the coast."""
import dataclasses
from dataclasses import dataclass

from . import _display
from ._calotte import Surface


@dataclass(frozen=True)
class ClosedSea:
    """A part of the sea that became land, of generalised_sea().

    at: longitude and latitude of the point of it that is farthest from the coast, degrees.
    area: steradians, of squares with sides of a sixth of a cell.
    """

    at: tuple[float, float]
    area: float


@dataclass(frozen=True, repr=False)
class GeneralisedSea:
    """The sea at the widths of a grid, of generalised_sea(). It is a `surface` of other functions.

    sea: the Surface, to the left of its rings, which do not meet.
    islands: number of the coast's closed lines that were left out as islands.
    lakes: number of those that were left out as lakes.
    parts: as wide as a cell, but without a seed; largest first. See ClosedSea.
    straits: between the sea and another part of it, or one that is left out, narrower than a cell;
        largest first. Those narrower than a third of a cell may be missing.
    stranded_passages: without effect, as they reach no sea: their numbers among all lines, from 0 on.
    land_to_sea: area of land that became sea, steradians.
    sea_to_land: area of sea that became land, steradians.
    displacement: the largest distance of the rings from the coast, in local widths, away from
        passages.
    usual_displacement: the distance that 95% of the points of the rings keep within.
    """

    sea: Surface
    islands: int
    lakes: int
    parts: tuple[ClosedSea, ...]
    straits: tuple[ClosedSea, ...]
    stranded_passages: tuple[int, ...]
    land_to_sea: float
    sea_to_land: float
    displacement: float
    usual_displacement: float

    def __repr__(self) -> str:
        region = repr(self.sea).removeprefix("<calotte.Surface: ").removesuffix(">")
        counts = ", ".join(_display.counted(number, noun) for number, noun in
                           ((self.islands, "island"), (self.lakes, "lake"), (len(self.parts), "part"),
                            (len(self.straits), "strait")))
        return f"<calotte.GeneralisedSea: {region}, without {counts}>"

    def _repr_html_(self) -> str:
        rows = [(field.name, getattr(self, field.name), "") for field in dataclasses.fields(self)]
        return _display.table(repr(self).strip("<>"), rows)
