// SPDX-License-Identifier: GPL-3.0-or-later
/** Picking cells, in all views at once, and going through the worst ones. */
import { cellAt, nearestCell } from "../scene/nearest.js";
import { shapesOf } from "../scene/shapes.js";
import { worstOf } from "./worst.js";

/** Pixels from a cell without a shape at which a click picks it. */
const dotReach = 8;

export class Selection {
  /** @param stage, navigation null where nothing can be drawn. */
  constructor(app, stage, navigation) {
    Object.assign(this, { app, stage, navigation });
    this.place = -1;
    app.on("colours", () => {
      if (app.measure === this.measure) return; // such as a scale that fits what is in sight
      this.measure = app.measure;
      this.place = -1;
    });
  }

  /** The cell under a pixel of the canvas; none clears the selection. Returns the cell or -1. */
  async pickAt(x, y) {
    const hit = this.stage.viewAt(x, y);
    const { width, height } = hit.window;
    const place = hit.view.camera.unproject(hit.x, hit.y, width, height);
    const set = await hit.view.setOf("cells");
    await set.shapes.prepare();
    const dot = dotReach / hit.view.camera.frame(width, height).scale;
    const cell = place ? cellAt(set, place, dot) : -1;
    if (cell < 0) this.clear();
    else this.pickCell(hit.k, cell);
    return cell;
  }

  /** Picks a cell of a view, and in the other views the cells that are nearest to it. */
  pickCell(k, cell, { triangle = null } = {}) {
    const { shown } = this.app;
    const place = shown[k].site(cell);
    const cells = shown.map((mesh, j) => {
      if (j === k) return cell;
      return mesh.plane === shown[k].plane ? this.near(j, place) : -1;
    });
    this.app.pick(cells, triangle);
  }

  /** The cell of a view that is nearest to a place of the drawing; -1 if there is none. */
  near(k, place) {
    return nearestCell(shapesOf(this.app.shown[k], "cells"), place);
  }

  async goTo(k, cell, close = false) {
    this.pickCell(k, cell);
    if (!this.stage) return;
    await this.stage.views[k].setOf("cells");
    this.navigation.flyTo(k, "cells", cell, close);
  }

  clear() {
    this.app.pick(null);
  }

  /** Ids of the worst shapes of a view by the chosen measure. */
  worst(k = 0) {
    const { measure, own } = this.app;
    return measure && own?.[k] ? worstOf(measure, own[k]) : [];
  }

  /** Goes to one of the worst shapes: a cell, or a triangle with one of its corners. */
  async goToWorst(k, id) {
    const { app, stage } = this;
    if (app.measure.on === "cells") return this.goTo(k, id);
    const mesh = app.shown[k];
    const corners = await mesh.triangles();
    const cell = [0, 1, 2].map((c) => corners[3 * id + c]).find((c) => c < mesh.cells) ?? -1;
    if (cell >= 0) this.pickCell(k, cell, { triangle: k === 0 ? id : null });
    if (!stage) return;
    await stage.views[k].setOf("triangles");
    this.navigation.flyTo(k, "triangles", id);
  }

  /** The next (1) or previous (-1) of the worst ten of the first view. */
  async step(direction) {
    const ids = this.worst();
    if (!ids.length) return;
    const from = this.place < 0 && direction < 0 ? 0 : this.place;
    this.place = (from + direction + ids.length) % ids.length;
    await this.goToWorst(0, ids[this.place]);
  }
}
