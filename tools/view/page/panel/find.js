// SPDX-License-Identifier: GPL-3.0-or-later
/** The field that finds a cell by its index or by a place. */
import { unitVector } from "../data/vector.js";
import { count, placeText } from "../data/format.js";
import { hasShape } from "../scene/nearest.js";
import { shapesOf } from "../scene/shapes.js";
import { byId } from "./dom.js";
import { placeOf } from "./places.js";

/** ms that an answer stays. */
const answerTime = 9000;

export class Find {
  constructor(app, selection) {
    Object.assign(this, { app, selection });
    byId("find-form").addEventListener("submit", (event) => {
      event.preventDefault();
      app.track(this.find(byId("find").value));
    });
    for (const end of ["input", "blur"]) byId("find").addEventListener(end, () => this.answer(""));
    const { plane } = app.shown[0];
    byId("find-label").textContent = plane ? "x, y or cell" : "lat, lon or cell";
    byId("find").placeholder = plane ? "" : "40.7, −74.0";
    byId("find").title = plane ? "" : "Letters decide, as in 74.0W 40.7N; without them latitude comes first.";
  }

  async find(text) {
    try {
      const cell = /^\s*(?:cell)?\s*(\d[\d\u202f]*)\s*$/i.exec(text);
      if (cell) this.goToCell(Number(cell[1].replace(/\u202f/g, "")));
      else await this.goToPlace(text);
    } catch (error) {
      this.answer(error.message);
    }
  }

  goToCell(index) {
    const mesh = this.app.shown[0];
    const cell = mesh.cellOf(index);
    if (cell < 0) {
      throw new Error(mesh.part && index < mesh.header.total
        ? `The page does not hold cell ${count(index)}; calotte info --cell ${index} prints it.`
        : `Cells are numbered from 0 to ${count(mesh.header.total - 1)}.`);
    }
    this.answer("");
    this.selection.goTo(0, cell);
  }

  async goToPlace(text) {
    const mesh = this.app.shown[0];
    const found = mesh.plane ? null : placeOf(text);
    const cell = this.selection.near(0, found ? unitVector(found.lon, found.lat) : mesh.fromFile(pointOf(text)));
    if (cell < 0) throw new Error("The page shows no cell.");
    await this.selection.goTo(0, cell);
    const { order } = found ?? {};
    this.answer([
      order === "lat, lon" ? `Latitude first: ${placeText(found)}.` : "",
      order === "lon, lat" ? `Longitude first, as a latitude is at most 90: ${placeText(found)}.` : "",
      (await this.isWhole(cell)) ? "" : lackNote(found),
    ].filter(Boolean).join(" "));
  }

  /** Whether the page has a cell's neighbours, so that it is the one that holds a place near it. */
  async isWhole(cell) {
    const mesh = this.app.shown[0];
    if (!mesh.part) return true;
    const shapes = shapesOf(mesh, "cells");
    await shapes.prepare();
    return hasShape(shapes, cell);
  }

  answer(text) {
    byId("find-answer").textContent = text;
    clearTimeout(this.timer);
    if (text) this.timer = setTimeout(() => this.answer(""), answerTime);
  }
}

/** @param place where the page lacks cells, {lon, lat}, or null in a plane. */
function lackNote(place) {
  const nearest = "The page lacks the cells there; this is the nearest that it holds.";
  return place ? `${nearest} calotte view --view ${place.lon},${place.lat} has them.` : nearest;
}

/** x and y of a plane. */
function pointOf(text) {
  const numbers = text.replace(/\u202f/g, "").replace(/\u2212/g, "-").split(/[\s,;]+/).filter(Boolean).map(Number);
  if (numbers.length !== 2 || !numbers.every(Number.isFinite)) throw new Error("Enter x and y or one cell index.");
  return numbers;
}
