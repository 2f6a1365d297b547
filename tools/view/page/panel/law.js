// SPDX-License-Identifier: GPL-3.0-or-later
/** The spacing law: how many cells have a prescribed spacing and a spacing, both logarithmic. */
import { markRanges } from "../app/marking.js";
import { drawingTheme } from "../colour/theme.js";
import { mix } from "../colour/palettes.js";
import { labelOf } from "../data/format.js";
import { axisBelow, axisLeft, plainRange, ticks } from "./axis.js";
import { byId, element, show, svg } from "./dom.js";
import { rectangleBrush } from "./rectangle_brush.js";

const width = 308;
const left = 46;
const side = 244;
const top = 8;
const height = top + side + 36;

/** Bins along each axis. */
const bins = 61;

export class Law {
  constructor(app) {
    this.app = app;
    this.bins = bins;
    app.on("meshes colours", () => this.refresh());
    app.on("marks theme", () => this.paint());
  }

  /** Decodes both measures of the first view's mesh, when it changes. */
  async refresh() {
    const mesh = this.app.shown[0];
    const { law } = mesh.header;
    show(byId("law-section"), Boolean(law));
    if (!law || mesh === this.mesh) return;
    this.mesh = mesh;
    this.measures = [mesh.measures[law.prescribed], mesh.measures[law.spacing]];
    this.columns = await Promise.all(this.measures.map((m) => mesh.values(m.name)));
    if (mesh === this.mesh) this.render();
  }

  render() {
    const [low, high] = commonRange(this.columns);
    show(byId("law-section"), high > 0);
    if (!(high > 0)) return;
    this.range = plainRange(low, high, true);
    this.step = Math.log(high / low) / bins;
    this.image = element("canvas", { width: bins, height: bins, class: "density" });
    this.brush = svg("rect", { class: "brush", hidden: true });
    this.chart = svg("svg", {
      viewBox: `0 0 ${width} ${height}`, class: "chart", role: "application", tabindex: 0,
      "aria-roledescription": "density plot",
      "aria-label": `${this.measures[1].label} against ${this.measures[0].label}. Arrows move a `
        + "rectangle that marks cells, with Shift they change its size, Escape clears it.",
    }, ...this.drawAxes(), this.brush);
    rectangleBrush(this.chart, this);
    byId("law").replaceChildren(this.image, this.chart);
    this.paint();
  }

  drawAxes() {
    const [x, y] = this.measures;
    const list = ticks(this.range, side);
    const middle = top + side / 2;
    return [
      svg("rect", { class: "frame", x: left, y: top, width: side, height: side }),
      svg("line", { class: "identity", x1: left, y1: top + side, x2: left + side, y2: top }),
      ...axisBelow(list, left, top + side, side),
      ...axisLeft(ticks(this.range, side, 16), left, top + side),
      svg("text", { class: "title", x: left + side / 2, y: height - 4, "text-anchor": "middle" }, labelOf(x)),
      svg("text", { class: "title", x: 10, y: middle, "text-anchor": "middle",
                    transform: `rotate(-90 10 ${middle})` }, labelOf(y)),
    ];
  }

  /** Fills the picture: all cells in greys, the marked ones in the accent. */
  paint() {
    if (!this.image) return;
    const { marks } = this.app;
    const theme = drawingTheme();
    const all = this.density(null);
    const marked = marks?.on === "cells" ? this.density(marks.sets[0]) : null;
    const context = this.image.getContext("2d");
    const picture = context.createImageData(bins, bins);
    const most = Math.log1p(all.reduce((a, b) => Math.max(a, b), 1));
    const share = (c) => (c ? 0.25 + (0.75 * Math.log1p(c)) / most : 0);
    for (let k = 0; k < bins * bins; k++) {
      const base = mix(theme.background, theme.coast, share(all[k]) * (marked ? 0.45 : 0.85));
      const colour = marked?.[k] ? mix(base, theme.accent, 0.35 + 0.65 * share(marked[k])) : base;
      picture.data.set([...colour.map(Math.round), all[k] ? 255 : 0], 4 * k);
    }
    context.putImageData(picture, 0, 0);
    this.showBrush();
  }

  /** Cells in each bin, rows from the top; of a mask, or of all. */
  density(mask) {
    const counts = new Float64Array(bins * bins);
    const [x, y] = this.columns;
    for (let i = 0; i < x.length; i++) {
      if ((mask && !mask[i]) || !(x[i] > 0 && y[i] > 0)) continue;
      counts[(bins - 1 - this.bin(y[i])) * bins + this.bin(x[i])]++;
    }
    return counts;
  }

  bin(value) {
    return Math.max(0, Math.min(bins - 1, Math.floor(Math.log(value / this.range.low) / this.step)));
  }

  /** The bin column and row (from below) at a point of the chart, viewBox pixels. */
  cellAt(x, y) {
    const place = (at) => Math.max(0, Math.min(bins - 1, Math.floor(at * bins)));
    return [place((x - left) / side), place((top + side - y) / side)];
  }

  /** Marks the cells of the bins from a corner to the opposite one. */
  async select([x0, y0], [x1, y1]) {
    const [x, y] = this.measures;
    const value = (k) => (k === 0 ? 0 : k === bins ? Infinity : this.range.low * Math.exp(k * this.step));
    await markRanges(this.app, [
      { name: x.name, low: value(Math.min(x0, x1)), high: value(Math.max(x0, x1) + 1) },
      { name: y.name, low: value(Math.min(y0, y1)), high: value(Math.max(y0, y1) + 1) },
    ]);
  }

  clear() {
    return this.app.mark(null);
  }

  showBrush() {
    const ranges = this.measures.map((m) => this.app.marks?.ranges.find(({ name }) => name === m.name));
    const visible = this.app.marks?.ranges.length === 2 && ranges.every(Boolean);
    this.brush.toggleAttribute("hidden", !visible);
    if (!visible) return;
    const at = (value) => Math.min(1, Math.max(0, this.range.position(value))) * side;
    const [[x0, x1], [y0, y1]] = ranges.map(({ low, high }) => [at(low), at(high)]);
    const box = { x: left + x0, y: top + side - y1, width: x1 - x0, height: y1 - y0 };
    for (const [name, value] of Object.entries(box)) this.brush.setAttribute(name, value);
  }
}

/** The range of the positive values of both columns, a little widened. */
function commonRange(columns) {
  let [low, high] = [Infinity, 0];
  for (const column of columns) {
    for (let i = 0; i < column.length; i++) {
      const v = column[i];
      if (!(v > 0 && v < Infinity)) continue;
      if (v < low) low = v;
      if (v > high) high = v;
    }
  }
  return [low / 1.05, high * 1.05];
}
