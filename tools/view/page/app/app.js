// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * What is shown and chosen. The panel and the stage listen to its events:
 *   "colours": measure, shapes, scale or meshes changed; "marks"; "filter"; "pick"; "meshes"; "coast";
 *   "rest": the picture has stopped moving.
 */
import { Mesh } from "../data/mesh.js";
import { marksOnCells, marksOnTriangles, valuesOnTriangles } from "../data/convert.js";
import { topologyOf } from "../scene/shapes.js";
import { ClassScale, RangeScale } from "../colour/scale.js";
import { Emitter } from "./emitter.js";
import { filterMask } from "./filters.js";

export class App extends Emitter {
  constructor(header) {
    super();
    this.header = header;
    this.meshes = header.meshes.map((mesh) => new Mesh(mesh));
    this.shown = header.views.map((k) => this.meshes[k]);
    this.measures = measuresOf(this.meshes);
    this.measure = this.measures.find((m) => m.on === "cells") ?? this.measures[0] ?? null;
    this.shapes = this.measure?.on ?? "cells";
    this.filter = "all";
    this.logarithmic = null;
    this.fit = false; // the scale to what is in sight
    this.valuesInSight = null; // by a measure, an array a view; set by what draws
    this.coast = true;
    this.palettes = { sequential: "viridis", diverging: "diverging" };
    this.marks = null;
    this.picked = null;
    this.state = header.history?.states.length ?? 0;
    this.changes = 0;
    this.pending = new Set();
    this.on("rest", () => {
      if (this.fit && this.measure && !this.measure.classes) this.refresh();
    });
  }

  /** Remembers a change until it is done. */
  track(change) {
    this.pending.add(change);
    const done = () => this.pending.delete(change);
    change.then(done, done);
    return change;
  }

  /** Resolves when no change is under way. */
  async idle() {
    while (this.pending.size) await Promise.allSettled(this.pending);
  }

  /** Decodes the points of the shown meshes. */
  async loadMeshes() {
    const [first, ...others] = this.shown;
    await first.load(this.frame);
    this.frame ??= first.plane ? first.frame : undefined;
    await Promise.all(others.map((mesh) => mesh.load(mesh.plane ? this.frame : undefined)));
  }

  get hasTriangles() {
    return this.shown.every((mesh) => mesh.header.triangles);
  }

  /** Which of the two palettes, the sequential or the diverging, the measure has by default. */
  get paletteKind() {
    return this.measure?.worst === "both" ? "diverging" : "sequential";
  }

  refresh() {
    return this.track(this.recompute());
  }

  /** Values and scale of the choice; a later choice overtakes an earlier one that still decodes. */
  async recompute() {
    const change = ++this.changes;
    const { measure, shapes } = this;
    const own = await Promise.all(this.shown.map((mesh) => measure && mesh.values(measure.name)));
    const values = await Promise.all(
      own.map((v, k) => valuesOnShapes(this.shown[k], measure, v, shapes)));
    const scaled = measure ? await this.scaleValues(measure) : [];
    if (change !== this.changes) return;
    this.own = own;
    this.values = values;
    this.scale = this.makeScale(measure, scaled, own.filter(Boolean));
    await this.refreshMasks();
    this.emit("colours");
  }

  /** The values that set the ends: those in sight; or of the page's first meshes, so that states can be compared. */
  async scaleValues(measure) {
    const seen = this.fit && this.valuesInSight ? await this.valuesInSight(measure) : [];
    if (seen.some((values) => values.length)) return seen;
    const all = [...this.header.views.map((k) => this.meshes[k]), ...this.shown];
    const arrays = await Promise.all(all.map((mesh) => mesh.values(measure.name)));
    const views = arrays.slice(0, this.header.views.length).filter(Boolean);
    return views.length ? views : arrays.filter(Boolean);
  }

  /** @param arrays the values that set the ends. @param shown the values that are shown. */
  makeScale(measure, arrays, shown) {
    if (measure?.classes) return new ClassScale(measure);
    const options = {
      logarithmic: this.logarithmic ?? measure?.logarithmic ?? false,
      palette: this.palettes[this.paletteKind],
      reference: measure?.worst === "both" ? measure.reference ?? 1 : null,
    };
    const scale = new RangeScale(arrays, options);
    const useful = scale.constant || scale.empty ? new RangeScale(shown, options) : scale;
    useful.show(shown);
    return useful;
  }

  async chooseMeasure(name) {
    const measure = this.measures.find((m) => m.name === name);
    if (!measure) throw new Error(`no measure is called ${name}`);
    this.measure = measure;
    this.logarithmic = null;
    if (measure.on === "triangles") this.shapes = "triangles";
    await this.refresh();
  }

  /** Cells have no colours by a measure on triangles; then the first measure on cells is chosen. */
  async chooseShapes(shapes) {
    if (shapes === "triangles" && !this.hasTriangles) return;
    this.shapes = shapes;
    if (shapes === "cells" && this.measure?.on === "triangles") {
      this.measure = this.measures.find((m) => m.on === "cells") ?? null;
      this.logarithmic = null;
    }
    await this.refresh();
  }

  async chooseScale({ logarithmic, palette, fit }) {
    this.fit = fit ?? this.fit;
    if (logarithmic !== undefined) this.logarithmic = logarithmic;
    if (palette) this.palettes[this.paletteKind] = palette;
    await this.refresh();
  }

  chooseCoast(shown) {
    this.coast = shown;
    this.emit("coast");
  }

  async chooseFilter(filter) {
    this.filter = filter;
    await this.refreshMasks();
    this.emit("filter");
  }

  /** @param marks null, or {on, sets: one Uint8Array a view, text, ...what made them}. */
  async mark(marks) {
    this.marks = marks;
    await this.refreshMasks();
    this.emit("marks");
  }

  /** Masks by shape, one a view; null where nothing is masked. */
  async refreshMasks() {
    const marks = await Promise.all(this.shown.map((_, view) => this.marksOn(view, this.shapes)));
    const filters = await Promise.all(
      this.shown.map((mesh, view) => filterMask(mesh, this.filter, this.shapes, marks[view])));
    this.masks = this.shown.map((_, view) => ({ marks: marks[view], filter: filters[view] }));
  }

  /** The marks of a view on shapes of a kind. */
  async marksOn(view, shapes) {
    if (!this.marks) return null;
    const set = this.marks.sets[view];
    if (this.marks.on === shapes) return set;
    const mesh = this.shown[view];
    const corners = await mesh.connectivity();
    if (!corners) return null;
    return shapes === "triangles"
      ? marksOnTriangles(set, corners)
      : marksOnCells(set, corners, mesh.cells);
  }

  /** Picks a cell of each view, -1 for none; null clears. @param triangle outlined too, in view 0. */
  pick(cells, triangle = null) {
    this.picked = cells && cells.some((cell) => cell >= 0) ? { cells, triangle } : null;
    this.emit("pick");
  }

  /** All about a cell, as the test API returns it. */
  async describe(view, cell) {
    const mesh = this.shown[view];
    const topology = await topologyOf(mesh);
    const values = {};
    for (const measure of mesh.measures) {
      if (measure.on === "cells") values[measure.name] = (await mesh.values(measure.name))[cell];
    }
    const found = topology ? topology.neighbours(cell) : [];
    const neighbours = mesh.part && found.length !== values.degree ? [] : found; // the page lacks some
    return {
      cell: mesh.fileIndex(cell),
      ...mesh.placeOf(mesh.site(cell)),
      neighbours: neighbours.map((j) => mesh.fileIndex(j)),
      values,
    };
  }

  /** Shows saved state k in the first view; the number of states stands for the result. */
  async showState(k) {
    const states = this.header.history?.states ?? [];
    this.state = Math.max(0, Math.min(states.length, k));
    const mesh = this.meshes[states[this.state]?.mesh ?? this.header.views[0]];
    if (mesh === this.shown[0]) return;
    const wanted = this.state;
    await mesh.load(this.frame);
    if (this.state !== wanted) return; // another state was chosen meanwhile
    this.shown = [mesh, ...this.shown.slice(1)];
    this.marks = null;
    if (this.picked && this.picked.cells[0] >= mesh.cells) this.picked = null;
    this.emit("meshes");
    await this.refresh();
    this.emit("marks");
    this.emit("pick");
  }
}

/** The measures of all meshes, each name once; with classes if it has them in every mesh. */
function measuresOf(meshes) {
  const found = new Map();
  for (const mesh of meshes) {
    for (const measure of mesh.measures) if (!found.has(measure.name)) found.set(measure.name, measure);
  }
  return [...found.values()].map((m) => (m.classes ? { ...m, classes: allClasses(meshes, m.name) } : m));
}

/** The classes of a measure in all meshes, by value; null if one has too many values for classes. */
function allClasses(meshes, name) {
  if (meshes.some((mesh) => mesh.measure(name)?.classes === null)) return null;
  const classes = new Map();
  for (const mesh of meshes) {
    for (const c of mesh.measure(name)?.classes ?? []) classes.set(c.value, c);
  }
  return [...classes.values()].sort((a, b) => a.value - b.value);
}

async function valuesOnShapes(mesh, measure, values, shapes) {
  if (!values || measure.on === shapes) return values;
  const corners = await mesh.connectivity();
  return corners ? valuesOnTriangles(values, corners, measure.classes) : null;
}
