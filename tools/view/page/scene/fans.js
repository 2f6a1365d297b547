// SPDX-License-Identifier: GPL-3.0-or-later
/** The triangles that fill the shapes of a patch. */
import { onArc } from "../data/vector.js";
import { longestRing } from "./shapes.js";

/** Arcs longer than this (a chord of the unit sphere) are drawn in pieces. */
const longestChord = 0.06;

const ids = new Uint32Array(longestRing);
let stamps = new Int32Array(0);
let stampedAt = new Uint32Array(0);
let stamp = 0;

/**
 * A fan of triangles (centre, rim k, rim k + 1) for each shape of a patch.
 * Returns {points, indices, slots}:
 *   points: 4 numbers a vertex, the place relative to the patch's centre, and 1 at centres, 0 at rims;
 *   indices: 3 a triangle, counter-clockwise, the vertex that holds the colour first or last;
 *   slots: for each vertex the slot whose colour it has; null if vertex k has that of slot first + k.
 * @param centreFirst the place of the vertex with the colour.
 */
export function buildFans(set, patch, centreFirst) {
  const { shapes } = set;
  const curved = !shapes.mesh.plane && 2 * patch.size > longestChord;
  return curved ? curvedFans(set, patch) : flatFans(set, patch, centreFirst);
}

function flatFans(set, patch, centreFirst) {
  const { shapes, order } = set;
  const { first, count, centre } = patch;
  const vertices = new Vertices(centre);
  const indices = [];
  for (let k = 0; k < count; k++) vertices.copy(set.centres, 4 * (first + k));
  beginStamps(shapes.rimCount);
  const place = [0, 0, 0];
  for (let k = 0; k < count; k++) {
    const sides = shapes.ring(order[first + k], ids);
    let before = sides ? rimVertex(shapes, vertices, ids[sides - 1], place) : 0;
    for (let side = 0; side < sides; side++) {
      const next = rimVertex(shapes, vertices, ids[side], place);
      if (centreFirst) indices.push(k, before, next);
      else indices.push(before, next, k);
      before = next;
    }
  }
  // shared colours are addressed by 16 bits
  const own = vertices.count > 65535 ? Uint32Array.from({ length: vertices.count }, (_, k) =>
    first + (k < count ? k : 0)) : null;
  return packed(vertices, indices, own);
}

function beginStamps(rimCount) {
  if (stamps.length < rimCount) {
    stamps = new Int32Array(rimCount);
    stampedAt = new Uint32Array(rimCount);
    stamp = 0;
  }
  stamp++;
}

/** The vertex of a rim point in the present patch; it is made when first met. */
function rimVertex(shapes, vertices, id, place) {
  if (stamps[id] !== stamp) {
    stamps[id] = stamp;
    stampedAt[id] = vertices.add(shapes.rim(id, place), 0);
  }
  return stampedAt[id];
}

/** Fans whose triangles are divided, so that coarse meshes bulge as the sphere does. */
function curvedFans(set, patch) {
  const { shapes, order } = set;
  const { first, count, centre } = patch;
  const vertices = new Vertices(centre);
  const out = { vertices, indices: [], slots: [] };
  const rows = Math.min(16, Math.ceil(patch.size / longestChord) + 1);
  for (let slot = first; slot < first + count; slot++) {
    const sides = shapes.ring(order[slot], ids);
    const middle = shapes.centre(order[slot], [0, 0, 0]);
    const rim = Array.from(ids.subarray(0, sides), (id) => shapes.rim(id, [0, 0, 0]));
    rim.forEach((to, k) => divided(out, slot, [middle, rim[(k + sides - 1) % sides], to], rows));
  }
  return packed(vertices, out.indices, Uint32Array.from(out.slots));
}

/** Rows of small triangles from the middle to the side (from, to); all have the slot's colour. */
function divided(out, slot, [middle, from, to], rows) {
  let above = [];
  for (let row = 0; row <= rows; row++) {
    const left = onArc(middle, from, row / rows);
    const right = onArc(middle, to, row / rows);
    const line = [];
    for (let k = 0; k <= row; k++) {
      line.push(out.vertices.add(onArc(left, right, row ? k / row : 0), 1 - row / rows));
      out.slots.push(slot);
    }
    for (let k = 0; k < row; k++) {
      out.indices.push(above[k], line[k], line[k + 1]);
      if (k + 1 < row) out.indices.push(above[k], line[k + 1], above[k + 1]);
    }
    above = line;
  }
}

function packed(vertices, indices, slots) {
  const Type = vertices.count > 65535 ? Uint32Array : Uint16Array;
  return { points: vertices.array(), indices: Type.from(indices), slots };
}

/** A growing list of vertices relative to a centre. */
class Vertices {
  constructor(centre) {
    this.centre = centre;
    this.numbers = new Float32Array(16384);
    this.count = 0;
  }

  reserve() {
    if (4 * this.count + 4 <= this.numbers.length) return;
    const longer = new Float32Array(2 * this.numbers.length);
    longer.set(this.numbers);
    this.numbers = longer;
  }

  add(place, inside) {
    this.reserve();
    const at = 4 * this.count;
    for (let d = 0; d < 3; d++) this.numbers[at + d] = place[d] - this.centre[d];
    this.numbers[at + 3] = inside;
    return this.count++;
  }

  /** A centre: three of the numbers at `from`, and 1. */
  copy(numbers, from) {
    this.reserve();
    const at = 4 * this.count++;
    for (let d = 0; d < 3; d++) this.numbers[at + d] = numbers[from + d];
    this.numbers[at + 3] = 1;
  }

  array() {
    return this.numbers.slice(0, 4 * this.count);
  }
}

/** The outline of one shape as a closed ring of places; empty if it has none. */
export function outline(shapes, id) {
  const sides = shapes.ring(id, ids);
  const corners = Array.from(ids.subarray(0, sides), (corner) => shapes.rim(corner, [0, 0, 0]));
  const ring = [];
  corners.forEach((to, k) => {
    const from = corners[(k + sides - 1) % sides];
    const length = Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    const pieces = shapes.mesh.plane ? 1 : Math.min(32, Math.ceil(length / longestChord));
    for (let j = 0; j < pieces; j++) ring.push(pieces > 1 ? onArc(from, to, j / pieces) : from);
  });
  return ring;
}
