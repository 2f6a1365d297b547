// SPDX-License-Identifier: GPL-3.0-or-later
/** The controls of colours: measure, shapes, palette, scale, filter, coastlines. */
import { filters, filterWorks } from "../app/filters.js";
import { marksText } from "../app/marking.js";
import { palettes } from "../colour/palettes.js";
import { labelOf } from "../data/format.js";
import { announce, byId, element, show } from "./dom.js";

export class Controls {
  constructor(app, stage) {
    this.app = app;
    this.fillMeasures();
    this.fill("palette", palettes.map(({ name, label }) => [name, label]));
    this.fill("filter", filters.map(({ name, label }) => [name, label]));
    this.listen();
    show(byId("coast-control"), Boolean(app.header.coastlines && stage));
    app.on("colours filter", () => this.show());
    app.on("marks", () => this.showMarks());
    app.on("coast", () => (byId("coast").checked = app.coast));
    show(byId("fit-control"), Boolean(stage));
  }

  fill(id, options) {
    byId(id).replaceChildren(...options.map(([value, text]) => element("option", { value }, text)));
  }

  fillMeasures() {
    const group = (label, on) => {
      const own = this.app.measures.filter((m) => m.on === on);
      const options = own.map((m) => element("option", { value: m.name }, labelOf(m)));
      return own.length ? element("optgroup", { label }, ...options) : null;
    };
    byId("measure").replaceChildren(
      ...[group("On cells", "cells"), group("On triangles", "triangles")].filter(Boolean));
  }

  listen() {
    const { app } = this;
    const on = (id, change) => byId(id).addEventListener("change", (event) => change(event.target));
    on("measure", (e) => app.chooseMeasure(e.value));
    on("palette", (e) => app.chooseScale({ palette: e.value }));
    on("logarithmic", (e) => app.chooseScale({ logarithmic: e.checked }));
    on("filter", (e) => app.chooseFilter(e.value));
    on("shapes-cells", () => app.chooseShapes("cells"));
    on("shapes-triangles", () => app.chooseShapes("triangles"));
    on("fit", (e) => app.chooseScale({ fit: e.checked }));
    on("coast", (e) => app.chooseCoast(e.checked));
    byId("marks-clear").addEventListener("click", () => app.mark(null));
  }

  show() {
    const { app } = this;
    const { measure, scale } = app;
    const ranged = Boolean(measure && !measure.classes);
    byId("measure").disabled = app.measures.length === 0;
    show(byId("measure-hint"), app.measures.length === 0);
    if (measure) byId("measure").value = measure.name;
    byId("measure-help").textContent = measure?.help ?? "";
    byId("shapes-cells").checked = app.shapes === "cells";
    byId("shapes-triangles").checked = app.shapes === "triangles";
    byId("shapes-triangles").disabled = !app.hasTriangles;
    show(byId("scale-controls"), ranged && !scale.empty && (app.fit || !scale.constant));
    byId("fit").checked = app.fit;
    byId("palette").value = app.palettes[app.paletteKind];
    byId("logarithmic").checked = Boolean(scale?.logarithmic);
    byId("logarithmic").disabled = !scale?.canBeLogarithmic;
    this.showMissing();
    this.showMarksText();
    this.showFilter();
  }

  showMarksText() {
    byId("marks-text").textContent = marksText(this.app) || this.marksHint();
    show(byId("marks-clear"), Boolean(this.app.marks));
  }

  marksHint() {
    const { measure, scale } = this.app;
    if (!measure || scale?.empty) return "";
    return measure.classes ? "Click a class to mark it." : `Drag over the bars to mark ${measure.on}.`;
  }

  showMissing() {
    const { own, measure } = this.app;
    const missing = measure
      ? own.some((values, k) => !values || this.app.shown[k].measure(measure.name).missing > 0) : false;
    show(byId("missing"), missing);
  }

  showFilter() {
    const { app } = this;
    byId("filter").value = app.filter;
    for (const option of byId("filter").options) {
      option.disabled = !filterWorks(option.value, app.shown) || (option.value === "marked" && !app.marks);
    }
    byId("filter").title = filters.find((f) => f.name === app.filter).help ?? "";
  }

  showMarks() {
    const { app } = this;
    this.showMarksText();
    const text = marksText(app);
    announce(text ? `${text} marked` : "No cells marked");
    if (!app.marks && app.filter === "marked") app.chooseFilter("all");
    this.showFilter();
  }
}
