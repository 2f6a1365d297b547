// SPDX-License-Identifier: GPL-3.0-or-later
/** Files that the reader saves: the picture with its colours, and the marked cells. */
import { drawingTheme } from "../colour/theme.js";
import { css } from "../colour/palettes.js";
import { labelOf } from "../data/format.js";
import { ticks } from "./axis.js";
import { announce, byId, element, show } from "./dom.js";

export class Save {
  /** @param stage null where nothing can be drawn; then the button of the picture is not shown. */
  constructor(app, stage) {
    Object.assign(this, { app, stage });
    byId("save-picture").addEventListener("click", () => this.savePicture());
    byId("marks-save").addEventListener("click", () => this.saveMarks());
    app.on("marks", () => show(byId("marks-save"), Boolean(app.marks)));
  }

  async savePicture() {
    await this.stage.settled();
    const picture = drawPicture(this.app, this.stage);
    picture.toBlob((blob) => download(blob, `${this.name()}.png`), "image/png");
  }

  async saveMarks() {
    const text = await marksCsv(this.app);
    download(new Blob([text], { type: "text/csv" }), `${this.name()}-cells.csv`);
  }

  /** The name of the first mesh without its suffix and characters that names of files lack. */
  name() {
    return this.app.shown[0].name.replace(/\.[^.]*$/, "").replace(/[^\w.-]+/g, "_") || "mesh";
  }
}

function download(blob, name) {
  const href = URL.createObjectURL(blob);
  element("a", { href, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(href), 60000);
  announce(`${name} is saved`);
}

/**
 * The marked cells, a line each: index in the file from 0, position, and the measures of cells. Of marked
 * triangles the cells at their corners.
 */
export async function marksCsv(app) {
  const lines = [];
  for (const [view, mesh] of app.shown.entries()) {
    const marked = await app.marksOn(view, "cells");
    const measures = mesh.measures.filter((m) => m.on === "cells");
    const columns = await Promise.all(measures.map((m) => mesh.values(m.name)));
    const place = mesh.plane ? ["x", "y"] : ["longitude", "latitude"];
    const several = app.shown.length > 1;
    lines.push([...(several ? ["mesh"] : []), "cell", ...place, ...measures.map(labelOf)].map(quoted).join(","));
    for (let i = 0; i < mesh.cells; i++) {
      if (!marked?.[i]) continue;
      const at = Object.values(mesh.placeOf(mesh.site(i))).map((v) => Number(v.toPrecision(8)));
      const values = columns.map((column) => (Number.isFinite(column[i]) ? Number(column[i].toPrecision(5)) : ""));
      lines.push([...(several ? [quoted(mesh.name)] : []), mesh.fileIndex(i), ...at, ...values].join(","));
    }
  }
  return `${lines.join("\n")}\n`;
}

const quoted = (text) => (/[",\n\r]/.test(text) ? `"${text.replace(/"/g, "\"\"")}"` : text);

/** Heights below the drawing, and the longest bar, in CSS pixels. */
const footTall = 62;
const barTall = 12;
const longestBar = 460;

/** A canvas with the drawing, its title and its colours. */
function drawPicture(app, stage) {
  const { ratio, canvas } = stage;
  stage.draw(stage.pace.wholeRule);
  const picture = element("canvas", { width: canvas.width, height: canvas.height + footTall * ratio });
  const context = picture.getContext("2d");
  const theme = drawingTheme();
  context.fillStyle = css(theme.background);
  context.fillRect(0, 0, picture.width, picture.height);
  context.drawImage(canvas, 0, 0);
  context.scale(ratio, ratio);
  context.translate(0, canvas.height / ratio);
  context.font = `12px ${getComputedStyle(document.body).fontFamily}`;
  context.fillStyle = css(theme.coast);
  const width = canvas.width / ratio;
  const title = [app.shown.map((mesh) => mesh.name).join(" and "), app.measure ? labelOf(app.measure) : ""];
  context.fillText(title.filter(Boolean).join(": "), 12, 14, width - 24);
  if (app.measure && !app.scale.empty) drawScale(context, app, width - 24, css(theme.coast));
  return picture;
}

function drawScale(context, { scale, measure, own }, width, ink) {
  context.translate(12, 22);
  if (measure.classes) {
    const seen = scale.classes.filter(({ value }) => own.some((values) => values?.includes(value)));
    let x = 0;
    for (const { label, colour } of seen) {
      context.fillStyle = css(colour);
      context.fillRect(x, 0, barTall, barTall);
      context.fillStyle = ink;
      context.fillText(label, x + barTall + 4, barTall - 2);
      x += barTall + 18 + context.measureText(label).width;
    }
    return;
  }
  const length = Math.min(longestBar, width);
  for (let x = 0; x < length; x++) {
    context.fillStyle = css(scale.rgb(Math.floor(((x + 0.5) / length) * scale.size)));
    context.fillRect(x, 0, 1.5, barTall);
  }
  context.fillStyle = ink;
  context.textAlign = "center";
  for (const { at, text } of ticks({ ...scale, position: (v) => scale.position(v) }, length)) {
    context.fillRect(at, barTall, 1, 4);
    const half = context.measureText(text).width / 2;
    context.fillText(text, Math.min(Math.max(at, half), length - half), barTall + 16);
  }
}
