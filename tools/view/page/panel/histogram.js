// SPDX-License-Identifier: GPL-3.0-or-later
/** Legend and histogram: bars over the colour bar, on one axis; brushing marks cells. */
import { barsOf, countBars } from "../data/bins.js";
import { count, labelOf, number, withUnit } from "../data/format.js";
import { css } from "../colour/palettes.js";
import { markRanges } from "../app/marking.js";
import { axisBelow, ticks } from "./axis.js";
import { barBrush } from "./bar_brush.js";
import { byId, svg } from "./dom.js";

const width = 308;
const left = 20;
const inner = width - 2 * left;
const top = 16;
const tall = 70;
const barTop = top + tall + 2;
const barTall = 12;
const height = barTop + barTall + 20;

export class Histogram {
  constructor(app) {
    this.app = app;
    app.on("colours", () => this.render());
    app.on("marks", () => this.showBrush());
  }

  render() {
    const { app } = this;
    const box = byId("histogram");
    box.hidden = !app.measure || Boolean(app.measure.classes);
    box.replaceChildren();
    this.brush = null;
    if (box.hidden) return;
    const { scale } = app;
    this.bars = barsOf(scale);
    this.counts = app.own.map((values) => (values ? countBars(values, scale, this.bars) : []));
    this.brush = svg("rect", { class: "brush", y: top, height: tall + barTall + 2, hidden: true });
    const chart = svg("svg", this.attributes(), ...this.drawBars(), ...this.drawLegend(), this.brush);
    if (this.bars.length) barBrush(chart, this);
    box.append(chart);
    this.showBrush();
  }

  attributes() {
    const { measure, scale } = this.app;
    const range = scale.empty
      ? "no values"
      : `${number(scale.range.least)} to ${withUnit(scale.range.greatest, measure.unit)}`;
    return {
      viewBox: `0 0 ${width} ${this.bars.length ? height : top}`,
      class: "chart",
      role: "application",
      tabindex: this.bars.length ? 0 : null,
      "aria-roledescription": "histogram",
      "aria-label": `Histogram of ${labelOf(measure)}, ${range}. Left and right arrows mark a bar, `
        + "with Shift they extend the range, Escape clears it.",
    };
  }

  x(position) {
    return left + position * inner;
  }

  drawBars() {
    const most = this.counts.map((counts) => Math.max(1, ...counts));
    const tallness = (c, k = 0) => (c ? Math.max(1.5, (c / most[k]) * tall) : 0);
    const [first, ...others] = this.counts;
    const bars = this.bars.map((bar, k) => svg("rect", {
      x: this.x(bar.from) + 0.25,
      width: Math.max(0.5, (bar.to - bar.from) * inner - 0.5),
      y: top + tall - tallness(first[k] ?? 0),
      height: tallness(first[k] ?? 0),
      fill: this.barColour(bar),
    }));
    const steps = others.map((counts, k) => (counts.length ? svg("path", {
      class: "steps", d: this.stepPath(counts.map((c) => tallness(c, k + 1))),
    }) : "")); // each mesh has its own height
    const ceiling = svg("text", { class: "note", x: left, y: 10 }, this.ceilingText(most));
    return [svg("g", { class: "bars" }, ...bars), ...steps, ceiling];
  }

  ceilingText(most) {
    if (!this.bars.length) return "no finite values";
    const { measure } = this.app;
    const tallest = `tallest bar: ${most.map(count).join(" / ")} ${measure.on}`;
    return most.length > 1 ? `${tallest}; line: second mesh` : tallest;
  }

  barColour(bar) {
    const { scale } = this.app;
    const middle = scale.constant ? 0.5 : (bar.from + bar.to) / 2;
    return css(scale.rgb(Math.min(scale.size - 1, Math.max(0, Math.floor(middle * scale.size)))));
  }

  stepPath(tallness) {
    return this.bars.map((bar, k) => {
      const y = top + tall - tallness[k];
      return `${k ? "L" : "M"}${this.x(bar.from)},${y}L${this.x(bar.to)},${y}`;
    }).join("");
  }

  /** The colour bar with arrows where values lie beyond, its axis, and the colour of no value. */
  drawLegend() {
    const { scale } = this.app;
    if (scale.empty) return [];
    const pieces = 64;
    const parts = Array.from({ length: pieces }, (_, k) => svg("rect", {
      x: this.x(k / pieces), width: inner / pieces + 0.6, y: barTop, height: barTall,
      fill: css(scale.rgb(Math.floor(((k + 0.5) / pieces) * scale.size))),
    }));
    const constant = scale.constant;
    const bar = constant
      ? [svg("rect", { x: this.x(0.45), width: 0.1 * inner, y: barTop, height: barTall,
                       fill: css(scale.rgb(scale.size >> 1)) })]
      : parts;
    const axis = ticks({ ...scale, position: (v) => scale.position(v) }, inner);
    return [svg("g", { class: "colours" }, ...bar), ...this.drawArrows(),
            ...axisBelow(axis, left, barTop + barTall, inner)];
  }

  drawArrows() {
    const { scale } = this.app;
    const middle = barTop + barTall / 2;
    const arrow = (x, tip, index) => svg("path", {
      d: `M${x},${barTop}L${tip},${middle}L${x},${barTop + barTall}Z`,
      fill: css(scale.rgb(index)),
    }, svg("title", {}, "Values beyond the end have the end's colour."));
    return [scale.below ? arrow(left - 1, left - 12, 0) : null,
            scale.above ? arrow(left + inner + 1, left + inner + 12, scale.size - 1) : null]
      .filter(Boolean);
  }

  /** The bar at a place of the chart, from its left side in pixels of the viewBox. */
  barAt(x) {
    const position = (x - left) / inner;
    const found = this.bars.findIndex((bar) => position < bar.to);
    return found < 0 ? this.bars.length - 1 : found;
  }

  /** Marks the shapes of bars first to last. */
  async select(first, last) {
    const { measure } = this.app;
    const [low, high] = [this.bars[first].low, this.bars[last].high];
    await markRanges(this.app, [{ name: measure.name, low, high }]);
  }

  clear() {
    return this.app.mark(null);
  }

  /** The rectangle over the bars whose range is marked. */
  showBrush() {
    if (!this.brush) return;
    const { marks, measure } = this.app;
    const range = marks?.ranges?.length === 1 && marks.ranges[0].name === measure?.name
      ? marks.ranges[0] : null;
    this.brush.toggleAttribute("hidden", !range || !this.bars.length);
    if (!range || !this.bars.length) return;
    const from = this.edge(range.low);
    const to = this.edge(range.high, true);
    this.brush.setAttribute("x", this.x(from));
    this.brush.setAttribute("width", Math.max(1, (to - from) * inner));
  }

  /** The place of an end of a range on the axis. */
  edge(value, upper = false) {
    const [first, last] = [this.bars[0].from, this.bars[this.bars.length - 1].to];
    if (value === -Infinity) return first;
    if (value === Infinity) return last;
    const position = this.app.scale.constant ? (upper ? last : first) : this.app.scale.position(value);
    return Math.min(last, Math.max(first, position));
  }
}
