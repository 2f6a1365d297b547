// SPDX-License-Identifier: GPL-3.0-or-later
/** Three-vectors as arrays, and places on the sphere. */

export const radian = Math.PI / 180;

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function normalise(p) {
  const length = Math.hypot(p[0], p[1], p[2]) || 1;
  p[0] /= length;
  p[1] /= length;
  p[2] /= length;
  return p;
}

export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

/** The unit vector of a longitude and latitude in degrees. */
export function unitVector(lon, lat) {
  const c = Math.cos(lat * radian);
  return [c * Math.cos(lon * radian), c * Math.sin(lon * radian), Math.sin(lat * radian)];
}

/** Longitude from -180 to 180 and latitude, in degrees, of a vector. */
export function degrees(p) {
  return {
    lon: Math.atan2(p[1], p[0]) / radian,
    lat: Math.atan2(p[2], Math.hypot(p[0], p[1])) / radian,
  };
}

/** The point of the great-circle arc from a to b (unit vectors) at the fraction t of its angle. */
export function onArc(a, b, t) {
  const angle = Math.atan2(Math.hypot(...cross(a, b)), dot(a, b));
  const s = Math.sin(angle);
  const [u, v] =
    s > 1e-9 ? [Math.sin((1 - t) * angle) / s, Math.sin(t * angle) / s] : [1 - t, t];
  return normalise([u * a[0] + v * b[0], u * a[1] + v * b[1], u * a[2] + v * b[2]]);
}
