// SPDX-License-Identifier: GPL-3.0-or-later
/** Sets of marked shapes, by ranges of measures. */
import { count } from "../data/format.js";

/**
 * Marks the shapes of all views whose values are in all ranges, and returns the marks.
 * @param ranges [{name, low, high}], all of measures on the same shapes.
 */
export async function markRanges(app, ranges, text) {
  const on = app.measures.find((m) => m.name === ranges[0].name).on;
  const sets = [];
  for (const mesh of app.shown) {
    const columns = await Promise.all(ranges.map(({ name }) => mesh.values(name)));
    sets.push(inRanges(columns, ranges, on === "cells" ? mesh.cells : trianglesOf(mesh)));
  }
  const counts = sets.map((set) => set.reduce((sum, marked) => sum + marked, 0));
  const totals = sets.map((set) => set.length);
  const marks = { on, sets, counts, totals, ranges, text };
  await app.mark(marks);
  return marks;
}

const trianglesOf = (mesh) => (mesh.header.triangles?.count ?? 0) / 3;

/** 1 where every column has a value in its range; the ends belong to it. */
function inRanges(columns, ranges, length) {
  const set = new Uint8Array(length);
  if (columns.some((column) => !column)) return set;
  set.fill(1);
  ranges.forEach((range, c) => {
    const values = columns[c];
    const rounded = values instanceof Float32Array ? Math.fround : Number; // as the values are
    const [low, high] = [rounded(range.low), rounded(range.high)];
    for (let i = 0; i < length; i++) if (!(values[i] >= low && values[i] <= high)) set[i] = 0;
  });
  return set;
}

/** Words such as "1 234 of 40 962 cells", for each view. */
export function marksText(app) {
  const { marks } = app;
  if (!marks) return "";
  const numbers = marks.counts.map((c, k) => {
    const text = `${count(c)} of ${count(marks.totals[k])} ${marks.on}`;
    return marks.counts.length > 1 ? `${app.shown[k].name}: ${text}` : text;
  });
  return numbers.join("; ");
}
