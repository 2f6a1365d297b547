// SPDX-License-Identifier: GPL-3.0-or-later
/** Shapes in patches: runs of a space-filling curve that are culled and drawn together. */
import { offsetOf } from "../gl/context.js";
import { keysOfFace, planeKey, sortByKey, sphereKey } from "./curve.js";

const patchSize = 1024;

/** Half of the window of neighbours on the curve whose mean distance is a shape's size. */
const halfWindow = 8;

/**
 * Steps along the curve are longer than the side of a square of the shape's area. The factor is
 * measured on hexagonal cells.
 */
const sizeOfStep = 0.83;

/** The longest step of a curve through shapes without gaps, over the median of those near it. */
const longestStep = 2.5;

/**
 * The shapes of one kind in the order of drawing.
 *   order[slot]: the shape; sizes[slot]: the side of a square of its area, estimated;
 *   centres: 4 numbers a slot, the place relative to the patch's centre and the size;
 *   patches: {first, count, centre, radius, size}, slots [first, first + count).
 * Within a patch every prefix of the slots is spread evenly over the patch.
 */
export class ShapeSet {
  constructor(shapes) {
    this.shapes = shapes;
    const { keys, ids } = sortedByCurve(shapes);
    this.order = ids;
    this.centres = new Float32Array(4 * ids.length);
    this.patches = runs(keys).map(([first, end]) => this.makePatch(first, end));
    this.least = this.patches.reduce((least, p) => Math.min(least, p.least), Infinity);
  }

  /** The slot of a shape; -1 if it is not shown. */
  slotOf(shape) {
    if (!this.slots) {
      this.slots = new Int32Array(this.shapes.count).fill(-1);
      this.order.forEach((id, slot) => (this.slots[id] = slot));
    }
    return this.slots[shape] ?? -1;
  }

  /** The estimated size of a shape, in units of the drawing. */
  sizeOf(shape) {
    const slot = this.slotOf(shape);
    return slot < 0 ? 0 : this.centres[4 * slot + 3];
  }

  /** The shapes whose centres are in a frame's window. */
  idsIn(frame) {
    const ids = [];
    for (const patch of this.patches) {
      if (!inWindow(patch, frame)) continue;
      for (let slot = patch.first; slot < patch.first + patch.count; slot++) {
        const centre = [0, 1, 2].map((d) => patch.centre[d] + this.centres[4 * slot + d]);
        if (inWindow({ centre, radius: 0 }, frame)) ids.push(this.order[slot]);
      }
    }
    return ids;
  }

  makePatch(first, end) {
    const { shapes, order } = this;
    const count = end - first;
    const places = new Float64Array(3 * count);
    const place = [0, 0, 0];
    const centre = [0, 0, 0];
    for (let k = 0; k < count; k++) {
      places.set(shapes.centre(order[first + k], place), 3 * k);
      for (let d = 0; d < 3; d++) centre[d] += place[d] / count;
    }
    const sizes = localSizes(places, shapes);
    const patch = { first, count, centre, radius: 0, size: 0, least: Infinity };
    this.spread(patch, places, sizes);
    return patch;
  }

  /** Writes a patch's slots in stratified order, and its radius and sizes. */
  spread(patch, places, sizes) {
    const { first, count, centre } = patch;
    const ids = this.order.slice(first, first + count);
    stratified(count).forEach((k, rank) => {
      const slot = first + rank;
      this.order[slot] = ids[k];
      const x = places[3 * k] - centre[0];
      const y = places[3 * k + 1] - centre[1];
      const z = places[3 * k + 2] - centre[2];
      this.centres.set([x, y, z, sizes[k]], 4 * slot);
      patch.radius = Math.max(patch.radius, Math.hypot(x, y, z) + 1.5 * sizes[k]);
      patch.size += sizes[k] / count;
      patch.least = Math.min(patch.least, sizes[k]);
    });
  }
}

/** Whether what is around a place, such as a patch, can be seen: on the near side, and in the window. */
export function inWindow({ centre, radius }, frame) {
  const [x, y, z] = offsetOf(frame, centre);
  const reach = radius * frame.scale;
  return (!frame.sphere || z + radius > 0)
    && Math.abs(x) * frame.scale < frame.width / 2 + reach
    && Math.abs(y) * frame.scale < frame.height / 2 + reach;
}

function sortedByCurve(shapes) {
  const keyOf = shapes.mesh.plane ? planeKey : sphereKey;
  const keys = new Uint32Array(shapes.count);
  const ids = new Uint32Array(shapes.count);
  const place = [0, 0, 0];
  let shown = 0;
  for (let i = 0; i < shapes.count; i++) {
    if (!shapes.shown(i)) continue;
    keys[shown] = keyOf(shapes.centre(i, place));
    ids[shown++] = i;
  }
  return sortByKey(keys.slice(0, shown), ids.slice(0, shown));
}

/** Runs of the curve of at most patchSize places that stay on one face. */
function runs(keys) {
  const found = [];
  for (let first = 0; first < keys.length; ) {
    const face = Math.floor(keys[first] / keysOfFace);
    let end = first + 1;
    while (end < keys.length && end - first < patchSize && keys[end] < (face + 1) * keysOfFace) end++;
    found.push([first, end]);
    first = end;
  }
  return found;
}

/** For each place of a run the mean length of the steps near it, scaled to the side of a square. */
function localSizes(places, shapes) {
  const count = places.length / 3;
  const steps = withoutJumps(stepsOf(places));
  const sums = new Float64Array(count);
  steps.forEach((step, k) => (sums[k + 1] = sums[k] + step));
  const alone = shapes.mesh.plane ? 2 / Math.sqrt(shapes.count) : Math.sqrt(12.6 / shapes.count);
  return Float64Array.from(sums, (_, k) => {
    const from = Math.max(0, k - halfWindow);
    const to = Math.min(count - 1, k + halfWindow);
    return to > from ? (sizeOfStep * (sums[to] - sums[from])) / (to - from) || alone : alone;
  });
}

function stepsOf(places) {
  const steps = new Float64Array(Math.max(0, places.length / 3 - 1));
  for (let k = 0; k < steps.length; k++) {
    const [x, y, z] = [0, 1, 2].map((d) => places[3 * k + 3 + d] - places[3 * k + d]);
    steps[k] = Math.sqrt(x * x + y * y + z * z);
  }
  return steps;
}

/** A step over a gap between the shapes, such as land in an ocean, becomes a long one between neighbours. */
function withoutJumps(steps) {
  const limits = [];
  for (let first = 0; first < steps.length; first += halfWindow) {
    const near = steps.slice(Math.max(0, first - halfWindow), first + 2 * halfWindow).sort();
    limits.push(longestStep * near[near.length >> 1]);
  }
  return steps.map((step, k) => Math.min(step, limits[Math.floor(k / halfWindow)]));
}

const orders = new Map();

/** The numbers below count in the order of their reversed bits: every prefix is spread evenly. */
function stratified(count) {
  if (!orders.has(count)) orders.set(count, reversedBits(count));
  return orders.get(count);
}

function reversedBits(count) {
  const bits = Math.ceil(Math.log2(Math.max(2, count)));
  const order = new Uint32Array(count);
  let rank = 0;
  for (let i = 0; i < 2 ** bits; i++) {
    let reversed = 0;
    for (let b = 0; b < bits; b++) reversed |= ((i >> b) & 1) << (bits - 1 - b);
    if (reversed < count) order[rank++] = reversed;
  }
  return order;
}
