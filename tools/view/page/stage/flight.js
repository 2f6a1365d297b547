// SPDX-License-Identifier: GPL-3.0-or-later
/** Short animations of a camera towards a place. */
import { distance } from "../data/vector.js";

const duration = 650;

const still = matchMedia("(prefers-reduced-motion: reduce)");

const ease = (t) => (t < 0.5 ? 4 * t ** 3 : 1 - (2 - 2 * t) ** 3 / 2);

/**
 * Moves a camera to a place of the drawing and a zoom, and calls `moved` after each step. Returns a
 * function that ends the flight where it is.
 */
export function fly(camera, place, zoom, moved) {
  const from = { place: camera.place(), zoom: camera.zoom };
  camera.setZoom(zoom); // within the camera's bounds
  const to = camera.zoom;
  if (still.matches) {
    camera.lookAtPoint(place);
    moved();
    return () => {};
  }
  camera.setZoom(from.zoom);
  let running = true;
  const begin = performance.now();
  // far flights rise, so that the way is seen
  const rise = Math.max(0, Math.log(Math.min(from.zoom, to) * distance(from.place, place)));
  const step = () => {
    if (!running) return;
    const t = Math.min(1, (performance.now() - begin) / duration);
    const s = ease(t);
    camera.lookAtPoint(t < 1 ? camera.between(from.place, place, s) : place);
    const level = Math.log(from.zoom) + s * Math.log(to / from.zoom);
    camera.setZoom(Math.exp(level - rise * Math.sin(Math.PI * s)));
    moved();
    if (t < 1) requestAnimationFrame(step);
  };
  step();
  return () => {
    running = false;
  };
}
