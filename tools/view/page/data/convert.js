// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Values and marks of cells on triangles, and of triangles on cells. `corners` are ids of cells, as
 * connectivity() of a mesh gives them.
 */

/** For each triangle the mean of its corners; of classes the value that most corners have. */
export function valuesOnTriangles(values, corners, classes) {
  const out = new values.constructor(corners.length / 3);
  for (let t = 0; t < out.length; t++) {
    const [a, b, c] = [values[corners[3 * t]], values[corners[3 * t + 1]], values[corners[3 * t + 2]]];
    if (classes) out[t] = b === c ? b : a;
    else out[t] = meanOfFinite(a, b, c);
  }
  return out;
}

function meanOfFinite(a, b, c) {
  const mean = (a + b + c) / 3;
  if (Number.isFinite(mean)) return mean;
  let sum = 0;
  let found = 0;
  for (const v of [a, b, c]) {
    if (!Number.isFinite(v)) continue;
    sum += v;
    found++;
  }
  return found ? sum / found : NaN;
}

/** A triangle is marked if one of its corners is. */
export function marksOnTriangles(marks, corners) {
  const out = new Uint8Array(corners.length / 3);
  for (let k = 0; k < corners.length; k++) if (marks[corners[k]]) out[(k / 3) | 0] = 1;
  return out;
}

/** A cell is marked if one of its triangles is. */
export function marksOnCells(marks, corners, cells) {
  const out = new Uint8Array(cells);
  for (let k = 0; k < corners.length; k++) {
    if (marks[(k / 3) | 0]) out[corners[k]] = 1;
  }
  return out;
}
