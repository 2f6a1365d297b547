// SPDX-License-Identifier: GPL-3.0-or-later
/** The coastlines as lines of places on the unit sphere. */
import { readBlock } from "../data/blocks.js";
import { unitVector } from "../data/vector.js";

/** Longer steps, in degrees, are divided. */
const longestStep = 2;

/** @param header {lon, lat, begin, unit}: whole numbers of a unit in degrees; where each line begins. */
export async function coastlines({ lon, lat, begin, unit }) {
  const degrees = async (block) => Float64Array.from(await readBlock(block), (n) => unit * (n | 0));
  const [lons, lats, begins] = await Promise.all([degrees(lon), degrees(lat), readBlock(begin)]);
  const ends = [...begins.slice(1), lons.length];
  return Array.from(begins, (first, k) => line(lons, lats, first, ends[k])).filter((l) => l.length > 1);
}

function line(lons, lats, first, end) {
  const places = [];
  for (let i = first; i < end; i++) {
    const pieces = i === first ? 1 : stepsBetween(lons, lats, i);
    for (let j = 1; j <= pieces; j++) {
      const t = 1 - j / pieces;
      const before = i === first ? i : i - 1;
      places.push(unitVector(lons[i] + (lons[before] - lons[i]) * t, lats[i] + (lats[before] - lats[i]) * t));
    }
  }
  return places;
}

function stepsBetween(lons, lats, i) {
  const step = Math.max(Math.abs(lons[i] - lons[i - 1]), Math.abs(lats[i] - lats[i - 1]));
  return Math.max(1, Math.ceil(step / longestStep));
}
