// SPDX-License-Identifier: GPL-3.0-or-later
/** A mesh of the page: its coordinates, triangles, polygons and values, decoded when first used. */
import { readBlock } from "./blocks.js";
import { degrees } from "./vector.js";

/**
 * Coordinates are those of the drawing. On a sphere it is the unit sphere; in a plane `frame` maps
 * the file's coordinates: (x - origin) / unit.
 */
export class Mesh {
  /** @param header the mesh's entry of the page's header. */
  constructor(header) {
    this.header = header;
    this.name = header.name;
    this.plane = header.plane;
    this.dimension = header.plane ? 2 : 3;
    this.cells = header.cells;
    this.measures = header.measures;
    this.promises = new Map();
  }

  /** Whether the page holds a part of the mesh's cells, and the shapes of some of them. */
  get part() {
    return this.header.total > this.cells;
  }

  /** Decodes what every drawing needs; once. @param frame of a plane, of the page's first plane. */
  load(frame) {
    return this.once("load", async () => {
      const { points, sides, number } = this.header;
      const read = (block) => (block ? readBlock(block) : null);
      [this.points, this.sides, this.number] =
        await Promise.all([read(points), read(sides), read(number)]);
      this.setFrame(frame);
    });
  }

  setFrame(frame) {
    const { low, step } = this.header;
    if (this.plane) {
      this.frame = frame ?? planeFrame(this);
    } else {
      const first = [0, 1, 2].map((k) => low[k] + step[k] * (this.points[k] ?? 0));
      this.frame = { origin: [0, 0, 0], unit: Math.hypot(...first) || 1, half: [1, 1] };
    }
    const { origin, unit } = this.frame;
    this.factor = step.map((s) => s / unit);
    this.start = low.map((l, k) => (l - origin[k]) / unit);
  }

  /** Point i of `numbers` (points or corners) into `out`, three numbers. */
  coordinate(numbers, i, out) {
    const { factor, start, dimension } = this;
    const at = i * dimension;
    out[0] = start[0] + factor[0] * numbers[at];
    out[1] = start[1] + factor[1] * numbers[at + 1];
    out[2] = dimension === 3 ? start[2] + factor[2] * numbers[at + 2] : 0;
    return out;
  }

  site(i, out = [0, 0, 0]) {
    return this.coordinate(this.points, i, out);
  }

  /** The place of the drawing of x and y of the file, in a plane. */
  fromFile([x, y]) {
    const { origin, unit } = this.frame;
    return [(x - origin[0]) / unit, (y - origin[1]) / unit, 0];
  }

  /** Longitude and latitude in degrees, or x and y of the file, of a place of the drawing. */
  placeOf(p) {
    const { origin, unit } = this.frame;
    return this.plane
      ? { x: p[0] * unit + origin[0], y: p[1] * unit + origin[1] }
      : degrees(p);
  }

  /** The index in the file of the page's cell i. */
  fileIndex(i) {
    return this.number ? this.number[i] : i;
  }

  /** The page's cell with this index in the file; -1 if the page does not hold it. */
  cellOf(index) {
    if (!Number.isInteger(index) || index < 0) return -1;
    if (this.number) return this.number.indexOf(index);
    return index < this.cells ? index : -1;
  }

  /** Ids of the triangles' corners, or null. */
  triangles() {
    const { triangles } = this.header;
    return this.once("triangles", async () => (triangles ? await readBlock(triangles) : null));
  }

  /** The triangles between the cells: a copy of a site across a period counts as that site. */
  connectivity() {
    return this.once("connectivity", async () => {
      const [triangles, copied] = await Promise.all(
        [this.triangles(), this.header.copied ? readBlock(this.header.copied) : null]);
      return triangles && copied ? triangles.map((i) => (i < this.cells ? i : copied[i - this.cells])) : triangles;
    });
  }

  /** Explicit polygons {corners, sides, ring}, or null. */
  polygons() {
    const { corners, ring } = this.header;
    return this.once("polygons", async () => {
      if (!corners) return null;
      const [c, r] = await Promise.all([readBlock(corners), readBlock(ring)]);
      return { corners: c, sides: this.sides, ring: r };
    });
  }

  measure(name) {
    return this.measures.find((m) => m.name === name);
  }

  /** The values of a measure, or null if the mesh has none of this name. */
  values(name) {
    const measure = this.measure(name);
    return this.once(`values ${name}`, async () => {
      if (!measure) return null;
      const numbers = await readBlock(measure.values);
      return measure.classes ? valuesOfClasses(numbers, measure.classes) : numbers;
    });
  }

  once(key, make) {
    if (!this.promises.has(key)) this.promises.set(key, make());
    return this.promises.get(key);
  }
}

/** Values from their places among the classes; NaN beyond the last. */
function valuesOfClasses(places, classes) {
  const values = [...classes.map((c) => c.value), NaN];
  return Float64Array.from(places, (place) => values[place]);
}

/** The frame in which the longer side of the points' box is 2 and its middle 0. */
function planeFrame(mesh) {
  const { low, step } = mesh.header;
  const least = [Infinity, Infinity];
  const greatest = [-Infinity, -Infinity];
  for (let i = 0; i < mesh.points.length; i++) {
    const value = mesh.points[i];
    if (value < least[i & 1]) least[i & 1] = value;
    if (value > greatest[i & 1]) greatest[i & 1] = value;
  }
  const end = (k, number) => low[k] + step[k] * number;
  const origin = [0, 1].map((k) => (end(k, least[k]) + end(k, greatest[k])) / 2);
  const extent = [0, 1].map((k) => (end(k, greatest[k]) - end(k, least[k])) / 2);
  const unit = Math.max(...extent) || 1;
  return { origin, unit, half: extent.map((e) => e / unit) };
}
