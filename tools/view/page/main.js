// SPDX-License-Identifier: GPL-3.0-or-later
/** Starts the page. */
import { App } from "./app/app.js";
import { Link } from "./app/link.js";
import { Selection } from "./app/selection.js";
import { makeTestApi } from "./app/test_api.js";
import { readPalettes } from "./colour/palettes.js";
import { currentTheme, onPreferredTheme, setTheme } from "./colour/theme.js";
import { canDecode } from "./data/blocks.js";
import { Classes } from "./panel/classes.js";
import { Controls } from "./panel/controls.js";
import { byId } from "./panel/dom.js";
import { Find } from "./panel/find.js";
import { Histogram } from "./panel/histogram.js";
import { History } from "./panel/history.js";
import { Law } from "./panel/law.js";
import { messages, showMessage } from "./panel/messages.js";
import { cellsText, Overlay } from "./panel/overlay.js";
import { Picked } from "./panel/picked.js";
import { preparePrinting } from "./panel/print.js";
import { Save } from "./panel/save.js";
import { renderTable } from "./panel/table.js";
import { WorstList } from "./panel/worst_list.js";
import { listenToPointers } from "./stage/gestures.js";
import { listenToKeys } from "./stage/keys.js";
import { Navigation } from "./stage/navigation.js";
import { Stage } from "./stage/stage.js";

const noDecoder =
  "This browser cannot show the mesh: it has no DecompressionStream. The table of numbers is complete.";
const noGraphics =
  "This browser cannot draw the mesh: it has no WebGL 2. The numbers and charts are complete.";

function start() {
  const header = JSON.parse(byId("header").textContent);
  readPalettes(header);
  const app = new App(header);
  const name = () => app.shown.map((mesh) => mesh.name).join(" and ");
  document.title = header.title;
  byId("title").textContent = header.title;
  byId("subtitle").textContent = app.shown.length === 1 ? cellsText(app.shown[0]) : "";
  byId("canvas").setAttribute("aria-label", name());
  renderTable(app.shown);
  app.on("meshes", () => renderTable(app.shown));
  if (!canDecode) {
    document.body.classList.add("table-only");
    showMessage(noDecoder);
    window.calotte = { ready: Promise.resolve(), errors: messages, firstPicture: null };
    return;
  }
  window.calotte = startDrawing(app);
}

/** Everything but the table. Returns the test API. */
function startDrawing(app) {
  const canvas = byId("canvas");
  const stage = makeStage(canvas, app);
  const navigation = stage ? new Navigation(stage) : null;
  const selection = new Selection(app, stage, navigation);
  for (const Part of [Histogram, Classes, Law, History]) new Part(app);
  new Controls(app, stage);
  for (const Part of [WorstList, Picked]) new Part(app, selection);
  new Find(app, selection);
  new Save(app, stage);
  const link = new Link(app, stage, selection);
  const ready = run(app, stage, link).catch((error) => {
    showMessage(`The page cannot be shown: ${error.message}.`);
    throw error;
  });
  ready.catch(() => {});
  if (stage) {
    new Overlay(app, stage, navigation);
    listenToPointers(canvas, stage, navigation, selection);
    listenToKeys(canvas, navigation, selection);
  }
  listenToTheme(app, stage);
  byId("keys-open").addEventListener("click", () => byId("keys").showModal());
  addEventListener("keydown", (event) => {
    if (event.key === "Escape" && event.target === document.body) selection.clear();
    if (event.key === "?" && !/^(INPUT|SELECT)$/.test(event.target.tagName) && !byId("keys").open) {
      byId("keys").showModal();
    }
  });
  const api = makeTestApi({ app, stage, selection, messages, ready });
  ready.then(() => (api.firstPicture = app.firstPicture), () => {});
  return api;
}

function makeStage(canvas, app) {
  const stage = Stage.make(canvas, app);
  if (!stage) {
    document.body.classList.add("no-graphics");
    showMessage(noGraphics);
    return null;
  }
  canvas.addEventListener("webglcontextlost", () =>
    showMessage("The graphics were lost. Reload the page to see the mesh again."));
  return stage;
}

/** Decodes and draws; ends after the first picture. */
async function run(app, stage, link) {
  await app.loadMeshes();
  if (stage) stage.begin();
  await app.refresh();
  await link.begin();
  if (stage) await stage.drawn;
  app.firstPicture = performance.now();
  document.body.classList.add("drawn");
}

function listenToTheme(app, stage) {
  const retheme = () => {
    byId("theme").setAttribute("aria-pressed", currentTheme() === "dark");
    stage?.retheme();
    app.emit("theme");
  };
  byId("theme").addEventListener("click", () => {
    setTheme(currentTheme() === "dark" ? "light" : "dark");
    retheme();
  });
  onPreferredTheme(retheme);
  preparePrinting(stage?.canvas ?? null, retheme);
  byId("theme").setAttribute("aria-pressed", currentTheme() === "dark");
}

start();
