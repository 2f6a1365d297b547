// SPDX-License-Identifier: GPL-3.0-or-later
/** Brushing of bars: by pointer, and by the arrow keys. */
import { oneAtATime } from "../app/one_at_a_time.js";


/**
 * @param chart the SVG element. @param owner has app, bars, barAt(x), select(first, last) and clear().
 */
export function barBrush(chart, owner) {
  const brush = new BarBrush(chart, owner);
  chart.addEventListener("pointerdown", (event) => brush.down(event));
  chart.addEventListener("pointermove", (event) => brush.move(event));
  chart.addEventListener("pointerup", () => brush.up());
  chart.addEventListener("pointercancel", () => brush.up());
  chart.addEventListener("keydown", (event) => brush.key(event));
}

class BarBrush {
  constructor(chart, owner) {
    Object.assign(this, { chart, owner, range: null, pressed: false });
    this.apply = oneAtATime(() => this.mark());
  }

  barUnder(event) {
    const box = this.chart.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * this.chart.viewBox.baseVal.width;
    return this.owner.barAt(x);
  }

  down(event) {
    if (event.button > 0) return;
    this.chart.setPointerCapture(event.pointerId);
    this.pressed = true;
    const bar = this.barUnder(event);
    // a second click on the one marked bar clears it
    if (!this.owner.app.marks) this.range = null;
    if (this.range && this.range[0] === bar && this.range[1] === bar) {
      this.pressed = false;
      this.clear();
      return;
    }
    this.range = [bar, bar];
    this.apply();
  }

  move(event) {
    if (!this.pressed) return;
    const bar = this.barUnder(event);
    if (bar === this.range[1]) return;
    this.range = [this.range[0], bar];
    this.apply();
  }

  up() {
    this.pressed = false;
  }

  key(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (event.key === "Escape") {
      this.clear();
    } else if (step) {
      event.preventDefault();
      this.step(step, event.shiftKey);
    }
  }

  step(step, extend) {
    const last = this.owner.bars.length - 1;
    const bound = (k) => Math.max(0, Math.min(last, k));
    if (!this.range) this.range = step > 0 ? [0, 0] : [last, last];
    else if (extend) this.range = [this.range[0], bound(this.range[1] + step)];
    else this.range = [bound(this.range[1] + step), bound(this.range[1] + step)];
    this.apply();
  }

  clear() {
    this.range = null;
    this.apply();
  }

  /** Marks what is chosen. */
  async mark() {
    const [a, b] = this.range ?? [];
    if (this.range) await this.owner.select(Math.min(a, b), Math.max(a, b));
    else await this.owner.clear();
  }
}
