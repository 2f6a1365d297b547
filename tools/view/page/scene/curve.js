// SPDX-License-Identifier: GPL-3.0-or-later
/** The order of places along a Hilbert curve: of the plane, or of the faces of a cube. */

const bits = 13;
const side = 2 ** bits;

/** Keys of a face begin at multiples of this. */
export const keysOfFace = 2 ** (2 * bits);

/** The place on the curve of (u, v), both from -1 to 1. */
function hilbert(u, v) {
  let x = Math.min(side - 1, Math.max(0, ((u + 1) / 2) * side)) | 0;
  let y = Math.min(side - 1, Math.max(0, ((v + 1) / 2) * side)) | 0;
  let key = 0;
  for (let s = side >> 1; s > 0; s >>= 1) {
    const right = (x & s) > 0 ? 1 : 0;
    const upper = (y & s) > 0 ? 1 : 0;
    key = key * 4 + ((3 * right) ^ upper);
    x &= s - 1;
    y &= s - 1;
    if (!upper) {
      if (right) {
        x = s - 1 - x;
        y = s - 1 - y;
      }
      const swap = x;
      x = y;
      y = swap;
    }
  }
  return key;
}

/** The key of a unit vector: faces +x, -x, +y, -y, +z, -z. */
export function sphereKey(p) {
  const x = Math.abs(p[0]), y = Math.abs(p[1]), z = Math.abs(p[2]);
  if (x >= y && x >= z) return (p[0] > 0 ? 0 : keysOfFace) + hilbert(p[1] / x, p[2] / x);
  if (y >= z) return (p[1] > 0 ? 2 : 3) * keysOfFace + hilbert(p[0] / y, p[2] / y);
  return (p[2] > 0 ? 4 : 5) * keysOfFace + hilbert(p[0] / z, p[1] / z);
}

/** The key of a place of the square from -1 to 1. */
export const planeKey = (p) => hilbert(p[0], p[1]);

/** Sorts `ids` by `keys` (both changed), stably: three passes of 11 bits. */
export function sortByKey(keys, ids) {
  const digits = 2048;
  let from = [keys, ids];
  let to = [new Uint32Array(keys.length), new Uint32Array(ids.length)];
  for (let shift = 0; shift < 33; shift += 11) {
    const next = new Uint32Array(digits + 1);
    for (let i = 0; i < keys.length; i++) next[((from[0][i] >>> shift) & (digits - 1)) + 1]++;
    for (let d = 0; d < digits; d++) next[d + 1] += next[d];
    for (let i = 0; i < keys.length; i++) {
      const at = next[(from[0][i] >>> shift) & (digits - 1)]++;
      to[0][at] = from[0][i];
      to[1][at] = from[1][i];
    }
    [from, to] = [to, from];
  }
  return { keys: from[0], ids: from[1] };
}
