// SPDX-License-Identifier: GPL-3.0-or-later
/** Brushing of a rectangle of bins: by pointer, and by the arrow keys. */
import { oneAtATime } from "../app/one_at_a_time.js";

/** @param owner has bins (along each side), cellAt(x, y), select(corner, corner) and clear(). */
export function rectangleBrush(chart, owner) {
  const brush = new RectangleBrush(chart, owner);
  chart.addEventListener("pointerdown", (event) => brush.down(event));
  chart.addEventListener("pointermove", (event) => brush.move(event));
  chart.addEventListener("pointerup", () => brush.up());
  chart.addEventListener("pointercancel", () => brush.up());
  chart.addEventListener("keydown", (event) => brush.key(event));
}

const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

class RectangleBrush {
  constructor(chart, owner) {
    Object.assign(this, { chart, owner, corners: null, pressed: false });
    this.apply = oneAtATime(() => this.mark());
  }

  under(event) {
    const box = this.chart.getBoundingClientRect();
    const { width, height } = this.chart.viewBox.baseVal;
    return this.owner.cellAt(((event.clientX - box.left) / box.width) * width,
                             ((event.clientY - box.top) / box.height) * height);
  }

  down(event) {
    if (event.button > 0) return;
    this.chart.setPointerCapture(event.pointerId);
    this.pressed = true;
    this.moved = false;
    this.corners = [this.under(event), this.under(event)];
  }

  move(event) {
    if (!this.pressed) return;
    this.corners = [this.corners[0], this.under(event)];
    this.moved = true;
    this.apply();
  }

  /** A click without a rectangle clears. */
  up() {
    if (this.pressed && !this.moved) this.clear();
    this.pressed = false;
  }

  key(event) {
    if (event.key === "Escape") this.clear();
    const arrow = arrows[event.key];
    if (!arrow) return;
    event.preventDefault();
    const middle = this.owner.bins >> 1;
    const bound = (k) => Math.max(0, Math.min(this.owner.bins - 1, k));
    this.corners ??= [[middle - 3, middle - 3], [middle + 3, middle + 3]];
    const move = ([x, y]) => [bound(x + arrow[0]), bound(y + arrow[1])];
    const [first, last] = this.corners;
    this.corners = [event.shiftKey ? first : move(first), move(last)];
    this.apply();
  }

  clear() {
    this.corners = null;
    this.apply();
  }

  /** Marks what is chosen. */
  async mark() {
    if (this.corners) await this.owner.select(...this.corners);
    else await this.owner.clear();
  }
}
