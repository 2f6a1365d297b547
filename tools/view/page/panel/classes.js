// SPDX-License-Identifier: GPL-3.0-or-later
/** The legend of a measure with classes: a button for each, which marks its cells. */
import { count } from "../data/format.js";
import { css } from "../colour/palettes.js";
import { markRanges } from "../app/marking.js";
import { byId, element } from "./dom.js";

export class Classes {
  constructor(app) {
    this.app = app;
    app.on("colours", () => this.render());
    app.on("marks", () => this.showPressed());
  }

  render() {
    const { app } = this;
    const box = byId("classes");
    box.hidden = !app.measure?.classes;
    box.replaceChildren();
    this.buttons = [];
    if (box.hidden) return;
    const counts = app.own.map((values) => countClasses(values, app.scale));
    const most = Math.max(1, ...counts.flat());
    app.scale.classes.forEach((c, k) => {
      if (counts.some((column) => column[k])) box.append(this.row(c, counts.map((column) => column[k]), most));
    });
    this.showPressed();
  }

  row(c, counts, most) {
    const swatch = element("span", { class: "swatch" });
    swatch.style.background = css(c.colour);
    const bar = element("span", { class: "share" });
    bar.style.width = `${Math.max(1, (100 * counts[0]) / most)}%`;
    bar.style.background = css(c.colour);
    const button = element("button", { type: "button", click: () => this.toggle(c) },
      swatch, element("span", { class: "label" }, c.label),
      element("span", { class: "track" }, bar),
      element("span", { class: "count" }, counts.map(count).join(" / ")));
    this.buttons.push({ button, value: c.value });
    return element("li", {}, button);
  }

  async toggle({ value, label }) {
    const { app } = this;
    if (this.isMarked(value)) await app.mark(null);
    else await markRanges(app, [{ name: app.measure.name, low: value, high: value }], label);
  }

  isMarked(value) {
    const { marks, measure } = this.app;
    const range = marks?.ranges.length === 1 ? marks.ranges[0] : null;
    return range?.name === measure?.name && range?.low === value && range?.high === value;
  }

  showPressed() {
    for (const { button, value } of this.buttons ?? []) {
      button.setAttribute("aria-pressed", this.isMarked(value));
    }
  }
}

function countClasses(values, scale) {
  const counts = new Array(scale.size + 1).fill(0);
  for (let i = 0; i < (values?.length ?? 0); i++) counts[scale.indexOf(values[i])]++;
  return counts;
}
