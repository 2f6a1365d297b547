// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * The view in the page's address, after #: where one looks, what is shown, marked and picked. What an
 * address lacks, or has wrongly, is as when the page opens.
 */
import { filters, filterWorks } from "./filters.js";
import { markRanges } from "./marking.js";
import { palettes } from "../colour/palettes.js";

/** ms after the last change at which the address is written; browsers allow some ten changes a second at most. */
const delay = 400;

export class Link {
  /** @param stage null where nothing can be drawn. */
  constructor(app, stage, selection) {
    Object.assign(this, { app, stage, selection });
  }

  /** Follows what the address says, then the app. To be called when all is there. */
  async begin() {
    this.first = this.state();
    this.palettes = { ...this.app.palettes };
    if (location.hash.length > 1) await this.restore().catch(() => {}); // a bad address is none
    this.app.on("colours marks filter pick meshes coast rest", () => this.changed());
    addEventListener("hashchange", () => this.app.track(this.restore()));
  }

  changed() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.write(), delay);
  }

  write() {
    const text = this.text();
    if (text === location.hash.slice(1)) return;
    try {
      history.replaceState(null, "", `#${text}`);
    } catch {
      // some browsers refuse it to pages from the disk, or when asked too often
    }
  }

  /** What is shown, each a text. */
  state() {
    const { app } = this;
    const scale = app.measure && !app.measure.classes ? app.scale : null;
    return {
      state: String(app.state),
      measure: app.measure?.name ?? "",
      shapes: app.shapes,
      show: app.filter,
      palette: scale ? app.palettes[app.paletteKind] : "",
      log: scale ? String(Number(scale.logarithmic)) : "",
      fit: String(Number(app.fit)),
      coast: String(Number(app.coast)),
      cell: app.picked && app.picked.cells[0] >= 0 ? String(app.shown[0].fileIndex(app.picked.cells[0])) : "",
    };
  }

  text() {
    const params = new URLSearchParams();
    const own = this.app.measure?.name !== this.first.measure;
    for (const [name, value] of Object.entries(this.state())) {
      // palette and scale are those of a measure
      const known = this.first[name] === value && !(own && (name === "palette" || name === "log"));
      if (!known && value) params.set(name, value);
    }
    for (const { name, low, high } of this.app.marks?.ranges ?? []) params.append("mark", `${name},${low},${high}`);
    if (this.stage) params.set("at", this.placeText());
    return params.toString().replace(/%2C/g, ",").replace(/%3A/g, ":");
  }

  placeText() {
    const [{ mesh, camera }] = this.stage.views;
    return [...Object.values(mesh.placeOf(camera.place())), camera.zoom].map((v) => Number(v.toPrecision(9))).join(",");
  }

  async restore() {
    const { app } = this;
    const params = new URLSearchParams(location.hash.slice(1));
    const value = (name) => params.get(name) ?? this.first[name];
    const isOne = (list, name) => list.some((item) => item.name === name);
    if (/^\d{1,9}$/.test(value("state"))) await app.showState(Number(value("state")));
    app.palettes = { ...this.palettes };
    const measure = isOne(app.measures, value("measure")) ? value("measure") : this.first.measure;
    if (measure) await app.chooseMeasure(measure);
    const shapes = value("shapes");
    if (app.measure?.on !== "triangles" && /^(cells|triangles)$/.test(shapes)) await app.chooseShapes(shapes);
    this.restorePlace((params.get("at") ?? "").split(",").map(Number)); // the scale may be that of what is in sight
    const log = params.get("log");
    await app.chooseScale({
      palette: isOne(palettes, params.get("palette")) ? params.get("palette") : undefined,
      logarithmic: /^[01]$/.test(log) ? log === "1" : undefined,
      fit: value("fit") === "1",
    });
    app.chooseCoast(value("coast") !== "0");
    await this.restoreMarks(params.getAll("mark").map(rangeOf));
    const filter = value("show");
    const works = isOne(filters, filter) && filterWorks(filter, app.shown) && (filter !== "marked" || app.marks);
    await app.chooseFilter(works ? filter : "all");
    this.restoreCell(params.get("cell"));
  }

  async restoreMarks(ranges) {
    const measures = ranges.map((range) => this.app.measures.find((m) => m.name === range?.name));
    const fit = measures.length > 0 && measures.every((m) => m && m.on === measures[0].on);
    if (fit) await markRanges(this.app, ranges);
    else await this.app.mark(null);
  }

  restoreCell(text) {
    const cell = /^\d{1,10}$/.test(text ?? "") ? this.app.shown[0].cellOf(Number(text)) : -1;
    if (cell >= 0) this.selection.pickCell(0, cell);
    else this.selection.clear();
  }

  restorePlace([a, b, zoom]) {
    if (!this.stage || ![a, b, zoom].every(Number.isFinite) || !(zoom > 0)) return;
    this.stage.lookAt(a, b, zoom);
  }
}

/** The range of a mark, or null. Names of measures may have commas. */
function rangeOf(text) {
  const [, name, ...ends] = /^(.*),([^,]*),([^,]*)$/s.exec(text) ?? [];
  const [low, high] = ends.map((end) => (end.trim() ? Number(end) : NaN));
  return name && low <= high ? { name, low, high } : null;
}
