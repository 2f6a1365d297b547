// SPDX-License-Identifier: GPL-3.0-or-later
/** Moves of the cameras: by the user, to a cell, back to the start. */
import { fly } from "./flight.js";

/** Share of the window that a cell takes after a flight to it, and after a double click. */
const flightShare = 0.06;
const closeShare = 0.2;

export class Navigation {
  constructor(stage) {
    this.stage = stage;
    this.stop = () => {};
  }

  window(k = 0) {
    return this.stage.windows()[k];
  }

  drag(k, x, y) {
    this.stop();
    const { width, height } = this.window(k);
    this.stage.views[k].camera.drag(x, y, width, height);
    this.stage.moved();
  }

  /** @param x, y the fixed pixel, from the window's middle. */
  zoom(k, factor, x = 0, y = 0) {
    this.stop();
    const { width, height } = this.window(k);
    this.stage.views[k].camera.zoomAt(factor, x, y, width, height);
    this.stage.moved();
  }

  reset() {
    this.stop();
    for (const camera of Object.values(this.stage.cameras)) camera.reset();
    this.stage.moved();
  }

  /** Flies to a shape; @param close zooms until it is large. */
  flyTo(k, kind, id, close = false) {
    const view = this.stage.views[k];
    const { shapes } = view.sets[kind];
    const place = shapes.centre(id, [0, 0, 0]);
    const share = close ? closeShare : flightShare;
    const zoom = this.zoomFor(k, view.sizeOf(kind, id), share);
    this.flyToPlace(k, place, close ? zoom : Math.max(zoom, view.camera.zoom));
  }

  flyToPlace(k, place, zoom) {
    this.stop();
    const { camera } = this.stage.views[k];
    this.stop = fly(camera, place, zoom ?? camera.zoom, () => this.stage.moved());
  }

  /** The zoom at which a size of the drawing takes a share of the window. */
  zoomFor(k, size, share) {
    const { width, height } = this.window(k);
    const fit = this.stage.views[k].camera.fit(width, height);
    return size > 0 ? (share * Math.min(width, height)) / (size * fit) : this.stage.views[k].camera.zoom;
  }
}
