// SPDX-License-Identifier: GPL-3.0-or-later
/** The table of numbers: least, mean and greatest of each measure. It needs no values. */
import { count, number, unitText } from "../data/format.js";
import { byId, element } from "./dom.js";

/** @param meshes the shown ones, headers or meshes: {name, measures}. */
export function renderTable(meshes) {
  const several = meshes.length > 1;
  const names = [...new Set(meshes.flatMap((mesh) => mesh.measures.map((m) => m.name)))];
  const head = ["measure", ...(several ? ["mesh"] : []), "least", "mean", "greatest", "missing"];
  const bodies = names.map((name) => element("tbody", {}, ...rows(name, meshes, several)));
  byId("table-hint").hidden = names.length > 0;
  byId("table").hidden = names.length === 0;
  byId("table").replaceChildren(element("table", { class: `numbers all${several ? " several" : ""}` },
    element("caption", { class: "unseen" }, "Least, mean and greatest value of each measure"),
    element("thead", {}, element("tr", {}, ...head.map((text) => element("th", { scope: "col" }, text)))),
    ...bodies));
}

function rows(name, meshes, several) {
  const found = meshes.map((mesh) => mesh.measures.find((m) => m.name === name));
  const known = found.find(Boolean);
  const label = element("th", { scope: "rowgroup", rowspan: meshes.length, title: known.help || null },
    known.label,
    known.unit ? "\u00a0" : null,
    known.unit ? element("span", { class: "unit" }, unitText(known.unit)) : null);
  return found.map((measure, k) => element("tr", {},
    k ? null : label,
    several ? element("th", { scope: "row", class: "mesh" }, meshes[k].name) : null,
    ...["least", "mean", "greatest"].map((key) => cell(measure?.[key] ?? null)),
    element("td", {}, measure ? count(measure.missing) : "–")));
}

const cell = (value) => element("td", {}, number(value));
