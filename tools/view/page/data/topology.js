// SPDX-License-Identifier: GPL-3.0-or-later
/** Which triangles and which cells meet at a site. */

/**
 * The triangles at each site, as a compressed list: those of site i are
 * `triangle[begin[i]]` to `triangle[begin[i + 1] - 1]`.
 */
export class TriangleTopology {
  /** @param corners 3 ids a triangle, counter-clockwise. @param sites their number. */
  constructor(corners, sites) {
    this.corners = corners;
    this.sites = sites;
    ({ begin: this.begin, entry: this.triangle } = incidence(corners, sites, 3));
  }

  /**
   * Triangles around site i, counter-clockwise, into `out`, and in `rim` the site that each
   * triangle shares with the one before. Returns their number; 0 if they do not surround the site.
   */
  ring(i, out, rim) {
    const { corners, begin, triangle } = this;
    const first = begin[i];
    const count = begin[i + 1] - first;
    if (count < 3) return 0;
    let wanted = -1;
    for (let k = 0; k < count; k++) {
      const t = k === 0 ? triangle[first] : this.triangleFrom(i, wanted);
      if (t < 0) return 0;
      const at = this.placeIn(t, i);
      out[k] = t;
      rim[k] = corners[3 * t + ((at + 1) % 3)];
      wanted = corners[3 * t + ((at + 2) % 3)];
    }
    return wanted === rim[0] ? count : 0;
  }

  /** The triangle (i, from, ...), or -1. */
  triangleFrom(i, from) {
    const { corners, begin, triangle } = this;
    for (let k = begin[i]; k < begin[i + 1]; k++) {
      const t = triangle[k];
      if (corners[3 * t + ((this.placeIn(t, i) + 1) % 3)] === from) return t;
    }
    return -1;
  }

  placeIn(t, i) {
    const { corners } = this;
    return corners[3 * t] === i ? 0 : corners[3 * t + 1] === i ? 1 : 2;
  }

  /** Sites that share a side of a triangle with site i. */
  neighbours(i) {
    const found = new Set();
    for (let k = this.begin[i]; k < this.begin[i + 1]; k++) {
      const t = this.triangle[k];
      const at = this.placeIn(t, i);
      for (const step of [1, 2]) {
        const j = this.corners[3 * t + ((at + step) % 3)];
        if (j < this.sites) found.add(j);
      }
    }
    return [...found];
  }
}

/** Neighbours of cells that are given as rings of corners: cells that share two corners. */
export class PolygonTopology {
  constructor(polygons, cornerCount) {
    this.ring = polygons.ring;
    this.begin = starts(polygons.sides);
    this.owner = new Uint32Array(this.ring.length);
    for (let i = 0; i + 1 < this.begin.length; i++) {
      this.owner.fill(i, this.begin[i], this.begin[i + 1]);
    }
    this.at = incidence(this.ring, cornerCount, 1);
  }

  neighbours(i) {
    const shared = new Map();
    for (let k = this.begin[i]; k < this.begin[i + 1]; k++) {
      const corner = this.ring[k];
      for (let e = this.at.begin[corner]; e < this.at.begin[corner + 1]; e++) {
        const j = this.owner[this.at.entry[e]];
        if (j !== i) shared.set(j, (shared.get(j) ?? 0) + 1);
      }
    }
    return [...shared].filter(([, corners]) => corners > 1).map(([j]) => j);
  }
}

/** Running sums of counts, with 0 before them. */
export function starts(counts) {
  const begin = new Uint32Array(counts.length + 1);
  for (let i = 0; i < counts.length; i++) begin[i + 1] = begin[i] + counts[i];
  return begin;
}

/** For each id below `limit` the groups of `size` ids that contain it. Greater ids are left out. */
function incidence(ids, limit, size) {
  const begin = new Uint32Array(limit + 1);
  for (let k = 0; k < ids.length; k++) if (ids[k] < limit) begin[ids[k] + 1]++;
  for (let i = 0; i < limit; i++) begin[i + 1] += begin[i];
  const next = begin.slice(0, limit);
  const entry = new Uint32Array(begin[limit]);
  for (let k = 0, group = 0, left = size; k < ids.length; k++) {
    if (ids[k] < limit) entry[next[ids[k]]++] = group;
    if (--left === 0) {
      group++;
      left = size;
    }
  }
  return { begin, entry };
}
