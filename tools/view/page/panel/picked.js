// SPDX-License-Identifier: GPL-3.0-or-later
/** The picked cell: where it is, its measures, its neighbours. */
import { count, latitude, longitude, number, placeText, withUnit } from "../data/format.js";
import { announce, byId, element, show } from "./dom.js";

export class Picked {
  constructor(app, selection) {
    Object.assign(this, { app, selection });
    byId("picked-clear").addEventListener("click", () => selection.clear());
    app.on("pick", () => this.render());
  }

  async render() {
    const { picked, shown } = this.app;
    show(byId("picked-clear"), Boolean(picked));
    show(byId("picked-hint"), !picked);
    if (!picked) {
      byId("picked").replaceChildren();
      return;
    }
    const cells = await Promise.all(picked.cells.map((cell, k) =>
      (cell >= 0 ? this.app.describe(k, cell) : null)));
    if (picked !== this.app.picked) return;
    byId("picked").replaceChildren(this.table(cells), ...cells.flatMap((cell, k) =>
      (cell ? this.neighbours(cell, k) : [])));
    announce(cells.map((cell, k) => cell && spoken(cell, shown[k], this.app.measure)).filter(Boolean)
      .join(". "));
  }

  table(cells) {
    const { shown, measures } = this.app;
    const row = (label, texts) => element("tr", {},
      element("th", { scope: "row" }, label), ...texts.map((text) => element("td", {}, text)));
    const of = (text) => cells.map((cell) => (cell ? text(cell) : "–"));
    const names = shown.map((mesh) => element("th", { scope: "col" }, mesh.name));
    const places = "lon" in (cells.find(Boolean) ?? {})
      ? [row("longitude", of((cell) => longitude(cell.lon))), row("latitude", of((cell) => latitude(cell.lat)))]
      : [row("x", of((cell) => number(cell.x))), row("y", of((cell) => number(cell.y)))];
    return element("table", { class: "numbers picked" },
      element("caption", { class: "unseen" }, "The picked cell"),
      shown.length > 1 ? element("thead", {}, element("tr", {}, element("td"), ...names)) : null,
      element("tbody", {},
        row("cell", of((cell) => count(cell.cell))), ...places,
        ...measures.filter((m) => m.on === "cells").map((m) =>
          row(m.label, of((cell) => (m.name in cell.values ? valueText(m, cell) : "–"))))));
  }

  neighbours(cell, k) {
    const { shown } = this.app;
    if (!cell.neighbours.length) return [];
    const label = shown.length > 1 ? `Neighbours in ${shown[k].name}` : "Neighbours";
    const go = (index) => this.selection.goTo(k, shown[k].cellOf(index));
    return [element("p", { class: "small" }, label), element("p", { class: "chips" },
      ...cell.neighbours.map((index) => element("button",
        { type: "button", "aria-label": `neighbour cell ${index}`, click: () => go(index) },
        count(index))))];
  }
}

function valueText(measure, cell) {
  const value = cell.values[measure.name];
  const known = measure.classes?.find((c) => c.value === value);
  return known ? known.label : withUnit(value, measure.unit);
}

function spoken(cell, mesh, measure) {
  const value = measure && measure.name in cell.values
    ? `, ${measure.label} ${valueText(measure, cell)}` : "";
  return `Cell ${cell.cell} of ${mesh.name}, ${placeText(cell)}${value}`;
}
