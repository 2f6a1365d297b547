// SPDX-License-Identifier: GPL-3.0-or-later
/** Mouse, pen and touch on the canvas. */

/** A press that moves by fewer pixels is a click. */
const clickReach = 5;

export function listenToPointers(canvas, stage, navigation, selection) {
  new Gestures(canvas, stage, navigation, selection);
}

class Gestures {
  constructor(canvas, stage, navigation, selection) {
    Object.assign(this, { canvas, stage, navigation, selection });
    this.pointers = new Map();
    const on = (name, handler) => canvas.addEventListener(name, (event) => handler.call(this, event));
    on("pointerdown", this.down);
    on("pointermove", this.move);
    on("pointerup", this.up);
    on("pointercancel", this.up);
    on("dblclick", this.doubleClick);
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  at(event) {
    const box = this.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  down(event) {
    if (event.button > 0) return;
    this.canvas.setPointerCapture(event.pointerId);
    const at = this.at(event);
    this.pointers.set(event.pointerId, at);
    this.begin = this.pointers.size === 1 ? at : null;
    this.k = this.stage.viewAt(at.x, at.y).k;
    this.stage.onHover?.(null);
  }

  move(event) {
    const at = this.at(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType === "mouse") this.stage.onHover?.(at);
      return;
    }
    if (this.begin && Math.hypot(at.x - this.begin.x, at.y - this.begin.y) < clickReach) return;
    this.begin = null;
    if (this.pointers.size === 1) this.navigation.drag(this.k, at.x - before.x, at.y - before.y);
    else this.pinch(event.pointerId, before, at);
    this.pointers.set(event.pointerId, at);
  }

  /** Zooms by the distance of two fingers and drags by their middle. */
  pinch(id, before, at) {
    const other = [...this.pointers].find(([key]) => key !== id)[1];
    const length = (p) => Math.max(10, Math.hypot(p.x - other.x, p.y - other.y));
    const middle = this.stage.viewAt((at.x + other.x) / 2, (at.y + other.y) / 2);
    this.navigation.zoom(this.k, length(at) / length(before), middle.x, middle.y);
    this.navigation.drag(this.k, (at.x - before.x) / 2, (at.y - before.y) / 2);
  }

  up(event) {
    const clicked = this.begin && this.pointers.size === 1 && event.type === "pointerup";
    this.pointers.delete(event.pointerId);
    if (clicked) this.selection.pickAt(this.begin.x, this.begin.y);
    this.begin = null;
  }

  async doubleClick(event) {
    const { x, y } = this.at(event);
    const { k } = this.stage.viewAt(x, y);
    const cell = await this.selection.pickAt(x, y);
    if (cell >= 0) this.navigation.flyTo(k, "cells", cell, true);
  }

  wheel(event) {
    event.preventDefault();
    const { x, y } = this.at(event);
    const hit = this.stage.viewAt(x, y);
    const lines = event.deltaMode === 1 ? 16 : 1;
    const factor = Math.exp(-Math.max(-120, Math.min(120, event.deltaY * lines)) * 0.0025);
    this.navigation.zoom(hit.k, factor, hit.x, hit.y);
  }
}
