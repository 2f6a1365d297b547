// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Cameras. A frame of a camera for a window of given size is
 *   {axes: rows of the rotation, centre: the looked-at place in rotated coordinates,
 *    scale: pixels per unit of the drawing, width, height}.
 * Screen coordinates are pixels from the window's middle, y downwards.
 */
import { degrees, dot, normalise, onArc, radian, unitVector } from "../data/vector.js";

/** Share of the window that the globe, or the plane, takes at zoom 1. */
const margin = 0.94;
const leastZoom = 0.5;

class Camera {
  constructor() {
    this.zoom = 1;
    this.greatestZoom = 1000;
  }

  setZoom(zoom) {
    this.zoom = Math.min(this.greatestZoom, Math.max(leastZoom, zoom));
  }

  frame(width, height) {
    return { ...this.look(), scale: this.zoom * this.fit(width, height), width, height };
  }

  /** Zooms and keeps the place under (x, y) where it is. */
  zoomAt(factor, x, y, width, height) {
    const before = this.unproject(x, y, width, height);
    this.setZoom(this.zoom * factor);
    // drags are exact only in the middle of the window; the second one corrects the first
    for (let round = 0; before && round < 2; round++) {
      const now = project(this.frame(width, height), before);
      if (!now.hidden) this.drag(x - now.x, y - now.y, width, height);
    }
  }
}

/** Orthographic, north up. */
export class SphereCamera extends Camera {
  /** @param home {lon, lat, zoom}. */
  constructor(home) {
    super();
    this.home = home;
    this.reset();
  }

  reset() {
    this.lookAt(this.home);
    this.setZoom(this.home.zoom);
  }

  fit(width, height) {
    return (margin * Math.min(width, height)) / 2;
  }

  look() {
    const [lon, lat] = [this.lon * radian, this.lat * radian];
    const [c, s] = [Math.cos(lon), Math.sin(lon)];
    const east = [-s, c, 0];
    const north = [-Math.sin(lat) * c, -Math.sin(lat) * s, Math.cos(lat)];
    return { axes: [east, north, unitVector(this.lon, this.lat)], centre: [0, 0, 0], sphere: true };
  }

  /** Turns the globe so that the place in the window's middle moves by (x, y) pixels. */
  drag(x, y, width, height) {
    const turn = 1 / (this.zoom * this.fit(width, height) * radian);
    const shrink = Math.max(0.15, Math.cos(this.lat * radian));
    this.lookAt({ lon: this.lon - (x * turn) / shrink, lat: this.lat + y * turn });
  }

  lookAt({ lon, lat }) {
    this.lon = ((((lon + 180) % 360) + 360) % 360) - 180;
    this.lat = Math.min(90, Math.max(-90, lat));
  }

  lookAtPoint(p) {
    this.lookAt(degrees(p));
  }

  /** The place under a pixel, or null beside the globe. */
  unproject(x, y, width, height) {
    const { axes, scale } = this.frame(width, height);
    const [u, v] = [x / scale, -y / scale];
    const rest = 1 - u * u - v * v;
    if (rest < 0) return null;
    const w = Math.sqrt(rest);
    return normalise([0, 1, 2].map((k) => u * axes[0][k] + v * axes[1][k] + w * axes[2][k]));
  }

  place() {
    return unitVector(this.lon, this.lat);
  }

  /** The place at the fraction t of the way from a to b. */
  between(a, b, t) {
    return onArc(a, b, t);
  }
}

export class PlaneCamera extends Camera {
  /** @param half half of the extent of the plane's points, in units of the drawing. */
  constructor(half) {
    super();
    this.half = half;
    this.reset();
  }

  reset() {
    [this.x, this.y] = [0, 0];
    this.setZoom(1);
  }

  fit(width, height) {
    const [x, y] = this.half.map((h) => Math.max(h, 1e-3));
    return (margin * Math.min(width / x, height / y)) / 2;
  }

  look() {
    return { axes: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], centre: [this.x, this.y, 0], sphere: false };
  }

  drag(x, y, width, height) {
    const scale = this.zoom * this.fit(width, height);
    this.lookAtPoint([this.x - x / scale, this.y + y / scale]);
  }

  /** The middle of the window stays on the plane. */
  lookAtPoint(p) {
    [this.x, this.y] = [0, 1].map((k) => Math.min(1.1, Math.max(-1.1, p[k])));
  }

  unproject(x, y, width, height) {
    const { scale } = this.frame(width, height);
    return [this.x + x / scale, this.y - y / scale, 0];
  }

  place() {
    return [this.x, this.y, 0];
  }

  between(a, b, t) {
    return a.map((from, k) => from + (b[k] - from) * t);
  }
}

/** The pixel of a place; hidden: on the far side. */
export function project({ axes, centre, scale, sphere }, p) {
  return {
    x: (dot(axes[0], p) - centre[0]) * scale,
    y: -(dot(axes[1], p) - centre[1]) * scale,
    hidden: sphere && dot(axes[2], p) < 0,
  };
}
