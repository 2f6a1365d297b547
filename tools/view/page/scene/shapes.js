// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * What is drawn: cells or triangles. Each kind has
 *   count; dotted: whether some are shown that have no shape; prepare(), before rings are asked for;
 *   shown(i); centre(i, out); ring(i, ids), which writes ids of rim points and returns their number
 *   (0: no shape); rim(id, out); rimCount.
 */
import { cross, dot, normalise } from "../data/vector.js";
import { PolygonTopology, starts, TriangleTopology } from "../data/topology.js";

/** The longest ring that is drawn. */
export const longestRing = 8192;

/** The shapes of a mesh. @param kind "cells" or "triangles". */
export function shapesOf(mesh, kind) {
  if (kind === "triangles") return new Triangles(mesh);
  return mesh.header.corners ? new PolygonCells(mesh) : new VoronoiCells(mesh);
}

/** The neighbours of cells, by triangles if there are, else by polygons. */
export function topologyOf(mesh) {
  return mesh.once("topology", async () => {
    const triangles = await mesh.connectivity();
    if (triangles) return new TriangleTopology(triangles, mesh.cells);
    const polygons = await mesh.polygons();
    return polygons ? new PolygonTopology(polygons, mesh.header.cornerCount) : null;
  });
}

class Shapes {
  constructor(mesh) {
    this.mesh = mesh;
    this.dotted = mesh.part;
    this.ready = false;
  }

  shown() {
    return true;
  }

  /** Decodes what rings need; once. */
  prepare() {
    this.preparing ??= this.load().then(() => {
      this.ready = true;
    });
    return this.preparing;
  }
}

/** Voronoi cells of a sphere: the corners are the circumcentres of the triangles. */
class VoronoiCells extends Shapes {
  constructor(mesh) {
    super(mesh);
    this.count = mesh.cells;
    this.scratch = new Uint32Array(longestRing);
    [this.a, this.b, this.c] = [0, 1, 2].map(() => [0, 0, 0]);
  }

  async load() {
    this.topology = await topologyOf(this.mesh);
    this.rimCount = this.topology ? this.topology.corners.length / 3 : 0;
  }

  centre(i, out) {
    return this.mesh.site(i, out);
  }

  ring(i, ids) {
    if (!this.topology || this.topology.begin[i + 1] - this.topology.begin[i] > longestRing) return 0;
    return this.topology.ring(i, ids, this.scratch);
  }

  rim(t, out) {
    const { mesh, a, b, c, topology } = this;
    const { corners } = topology;
    mesh.site(corners[3 * t], a);
    mesh.site(corners[3 * t + 1], b);
    mesh.site(corners[3 * t + 2], c);
    return circumcentre(a, b, c, out);
  }
}

/** The point of the unit sphere that is equally far from a, b and c, on their side. */
function circumcentre(a, b, c, out) {
  const ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  out[0] = uy * vz - uz * vy;
  out[1] = uz * vx - ux * vz;
  out[2] = ux * vy - uy * vx;
  return normalise(out);
}

/** Cells whose corners the file holds. */
class PolygonCells extends Shapes {
  constructor(mesh) {
    super(mesh);
    this.count = mesh.cells;
    this.begin = starts(mesh.sides);
    this.rimCount = mesh.header.cornerCount;
  }

  async load() {
    this.polygons = await this.mesh.polygons();
  }

  shown(i) {
    return this.dotted || this.begin[i + 1] > this.begin[i];
  }

  centre(i, out) {
    return this.mesh.site(i, out);
  }

  ring(i, ids) {
    const first = this.begin[i];
    const sides = this.begin[i + 1] - first;
    if (sides < 3 || sides > longestRing) return 0;
    for (let k = 0; k < sides; k++) ids[k] = this.polygons.ring[first + k];
    if (!this.counterClockwise(i, ids, sides)) ids.subarray(0, sides).reverse();
    return sides;
  }

  /** Files differ in the orientation of their polygons; the drawing culls by it. */
  counterClockwise(i, ids, sides) {
    const centre = this.centre(i, [0, 0, 0]);
    const up = this.mesh.plane ? [0, 0, 1] : centre;
    let sum = 0;
    let before = this.arm(ids[sides - 1], centre);
    for (let k = 0; k < sides; k++) {
      const arm = this.arm(ids[k], centre);
      sum += dot(cross(before, arm), up);
      before = arm;
    }
    return sum >= 0;
  }

  arm(id, centre) {
    const p = this.rim(id, [0, 0, 0]);
    return [p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]];
  }

  rim(id, out) {
    return this.mesh.coordinate(this.polygons.corners, id, out);
  }
}

/** Delaunay triangles; their centres are the centroids. */
class Triangles extends Shapes {
  constructor(mesh) {
    super(mesh);
    this.dotted = false;
    this.count = mesh.header.triangles ? mesh.header.triangles.count / 3 : 0;
    this.rimCount = mesh.points?.length / mesh.dimension;
    [this.a, this.b, this.c] = [0, 1, 2].map(() => [0, 0, 0]);
  }

  async load() {
    this.corners = (await this.mesh.triangles()) ?? new Uint32Array(0);
  }

  centre(t, out) {
    const { mesh, corners, a, b, c } = this;
    mesh.site(corners[3 * t], a);
    mesh.site(corners[3 * t + 1], b);
    mesh.site(corners[3 * t + 2], c);
    for (let k = 0; k < 3; k++) out[k] = (a[k] + b[k] + c[k]) / 3;
    return mesh.plane ? out : normalise(out);
  }

  ring(t, ids) {
    for (let k = 0; k < 3; k++) ids[k] = this.corners[3 * t + k];
    return 3;
  }

  rim(id, out) {
    return this.mesh.site(id, out);
  }
}
