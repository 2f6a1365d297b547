// SPDX-License-Identifier: GPL-3.0-or-later
/** The worst ten of the chosen measure, as buttons that go to them. */
import { worstTitle } from "../app/worst.js";
import { count, withUnit } from "../data/format.js";
import { byId, element, show } from "./dom.js";

export class WorstList {
  constructor(app, selection) {
    Object.assign(this, { app, selection });
    app.on("colours", () => this.render());
    app.on("pick", () => this.showCurrent());
  }

  render() {
    const { app, selection } = this;
    const { measure } = app;
    // the ten greatest of some classes mean nothing
    const listed = measure && !(measure.classes && measure.worst === "none");
    const lists = listed ? app.shown.map((_, k) => selection.worst(k)) : [];
    show(byId("worst-section"), lists.some((ids) => ids.length));
    this.items = [];
    if (!listed) return;
    byId("worst-title").textContent = worstTitle(measure);
    byId("worst").replaceChildren(...lists.flatMap((ids, k) => this.list(ids, k)));
    this.showCurrent();
  }

  list(ids, k) {
    const { app } = this;
    const items = ids.map((id) => element("li", {}, this.button(id, k)));
    const list = element("ol", { class: "worst", "aria-label": app.shown[k].name }, ...items);
    return app.shown.length > 1 ? [element("h3", {}, app.shown[k].name), list] : [list];
  }

  button(id, k) {
    const { app, selection } = this;
    const { measure } = app;
    const cells = measure.on === "cells";
    const index = cells ? app.shown[k].fileIndex(id) : id;
    const value = withUnit(app.own[k][id], measure.unit);
    const button = element("button", {
      type: "button",
      "aria-label": `${cells ? "cell" : "triangle"} ${index}, ${value}`,
      click: () => selection.goToWorst(k, id),
    }, element("span", {}, count(index)), element("span", { class: "number" }, value));
    this.items.push({ button, id, k, cells });
    return button;
  }

  showCurrent() {
    const { picked } = this.app;
    for (const { button, id, k, cells } of this.items ?? []) {
      const current = cells ? picked?.cells[k] === id : k === 0 && picked?.triangle === id;
      if (current) button.setAttribute("aria-current", "true");
      else button.removeAttribute("aria-current");
    }
  }
}
