// SPDX-License-Identifier: GPL-3.0-or-later
/** The cell at a place. */
import { cross, dot, normalise } from "../data/vector.js";
import { longestRing } from "./shapes.js";

const candidates = 16;

/** A place farther from every site than this many cell sizes is in no cell. */
const farthest = 2;

/**
 * The cell of a set that holds a place of the drawing: the nearest site; of explicit polygons the
 * one that contains the place, if any of the nearest sixteen does. -1 if there is none near.
 * @param dot how far from its site a cell without a shape is found.
 */
export function cellAt(set, place, dot) {
  const { shapes } = set;
  const polygons = Boolean(shapes.polygons);
  const near = nearestCells(shapes, place, polygons ? candidates : 1);
  if (!near.length) return -1;
  const inside = polygons ? near.find(({ id }) => contains(shapes, id, place)) : undefined;
  const dotted = ({ id }) => shapes.dotted && !hasShape(shapes, id);
  const found = inside ?? near.find((cell) => !shapes.dotted || !polygons || dotted(cell));
  if (!found) return -1;
  const reach = dotted(found) ? dot : farthest * set.sizeOf(found.id);
  return inside || found.square <= reach * reach ? found.id : -1;
}

const ids = new Uint32Array(longestRing);

export const hasShape = (shapes, id) => shapes.ring(id, ids) > 0;

/** The nearest shown cell, however far. */
export function nearestCell(shapes, place) {
  return nearestCells(shapes, place, 1)[0]?.id ?? -1;
}

/** Up to `wanted` cells {id, square of the distance}, nearest first. */
function nearestCells(shapes, place, wanted) {
  const { mesh } = shapes;
  const found = [];
  let worst = Infinity;
  const p = [0, 0, 0];
  for (let id = 0; id < mesh.cells; id++) {
    mesh.site(id, p);
    const x = p[0] - place[0], y = p[1] - place[1], z = p[2] - place[2];
    const square = x * x + y * y + z * z;
    if (square >= worst || !shapes.shown(id)) continue;
    if (found.length === wanted) found.pop();
    const at = found.findIndex((f) => f.square > square);
    found.splice(at < 0 ? found.length : at, 0, { id, square });
    if (found.length === wanted) worst = found[wanted - 1].square;
  }
  return found;
}

/** Whether a place is inside a polygon, by the crossings of its sides with a ray in the tangent plane. */
function contains(shapes, id, place) {
  const sides = shapes.ring(id, ids);
  const project = tangentPlane(shapes.mesh.plane, place);
  const ring = Array.from(ids.subarray(0, sides), (corner) => project(shapes.rim(corner, [0, 0, 0])));
  let inside = false;
  ring.forEach(([x, y], k) => {
    const [u, v] = ring[(k + sides - 1) % sides];
    if (y > 0 !== v > 0 && x - (y * (u - x)) / (v - y) > 0) inside = !inside;
  });
  return inside;
}

function tangentPlane(plane, place) {
  if (plane) return (p) => [p[0] - place[0], p[1] - place[1]];
  const side = normalise(cross(Math.abs(place[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], place));
  const up = cross(place, side);
  return (p) => [dot(p, side) / dot(p, place), dot(p, up) / dot(p, place)];
}
