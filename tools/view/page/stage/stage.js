// SPDX-License-Identifier: GPL-3.0-or-later
/** The canvas: its views, and when they are drawn. */
import { colourTables } from "../colour/paint.js";
import { drawingTheme } from "../colour/theme.js";
import { unitVector } from "../data/vector.js";
import { Globe } from "../gl/globe.js";
import { Lines, linesProgram } from "../gl/lines.js";
import { makeContext } from "../gl/context.js";
import { shapePrograms } from "../gl/shapes_layer.js";
import { SmoothTarget } from "../gl/smooth_target.js";
import { coastlines } from "../scene/coastlines.js";
import { PlaneCamera, SphereCamera } from "./camera.js";
import { homeOf } from "./home.js";
import { Pace } from "./pace.js";
import { View } from "./view.js";

/** Windows of more device pixels a CSS pixel show no more than this. */
const greatestRatio = 2;

/** Milliseconds without a movement until the app hears that the view rests. */
const restAfter = 250;

export class Stage {
  /** @returns a stage, or null if there is no WebGL 2. */
  static make(canvas, app) {
    const gl = makeContext(canvas);
    return gl ? new Stage(canvas, gl, app) : null;
  }

  constructor(canvas, gl, app) {
    Object.assign(this, { canvas, gl, app });
    this.tools = { gl, programs: shapePrograms(gl), lines: linesProgram(gl), redraw: () => this.redraw() };
    this.globe = new Globe(gl);
    this.smooth = new SmoothTarget(gl);
    this.pace = new Pace();
    this.views = [];
    this.theme = drawingTheme();
    this.drawn = new Promise((resolve) => (this.firstDrawn = resolve));
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** Makes the views of the app's meshes, which are loaded, and listens to the app. */
  begin() {
    const { app } = this;
    this.cameras = {};
    this.makeViews();
    this.resize();
    const { coastlines: coast } = app.header;
    if (coast) coastlines(coast).then((lines) => this.setCoast(lines));
    app.on("meshes", () => this.makeViews());
    app.on("colours", () => app.track(this.refresh()));
    app.on("marks filter", () => this.recolour());
    app.on("coast", () => this.redraw());
    app.valuesInSight = (measure) => this.valuesInSight(measure);
    app.on("pick", () => app.track(this.pick()));
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
  }

  setCoast(lines) {
    this.coast = new Lines(this.gl, this.tools.lines);
    this.coast.set(lines);
    this.redraw();
  }

  makeViews() {
    this.app.shown.forEach((mesh, k) => {
      if (this.views[k]?.mesh === mesh) return;
      this.views[k]?.dispose();
      this.views[k] = new View(this.tools, mesh, this.cameraFor(mesh));
    });
  }

  /** Spheres turn together, and planes move together. */
  cameraFor(mesh) {
    const kind = mesh.plane ? "plane" : "sphere";
    this.cameras[kind] ??= mesh.plane ? new PlaneCamera(mesh.frame.half) : new SphereCamera(homeOf(mesh));
    return this.cameras[kind];
  }

  async refresh() {
    const { shapes } = this.app;
    await Promise.all(this.views.map((view) => view.prepareLayer(shapes)));
    for (const view of this.views) {
      const { camera } = view;
      camera.greatestZoom = Math.max(camera.greatestZoom, 1 / view.layers[shapes].set.least);
    }
    this.recolour();
  }

  /** Nothing while the shapes are not there: a refresh is under way then. */
  recolour() {
    const { app, theme } = this;
    if (!app.scale || !this.views.every((view) => view.layers[app.shapes])) return;
    const scale = app.measure ? app.scale : { size: 0, indexOf: () => 0 };
    const tables = colourTables(scale, app.measure ? theme : { ...theme, missing: theme.plain });
    this.views.forEach((view, k) => {
      view.show(app.shapes, { values: app.values[k], scale, tables, masks: app.masks[k], theme });
    });
    this.redraw();
  }

  /** Draws at once: a print follows. */
  retheme() {
    this.theme = drawingTheme();
    this.recolour();
    this.draw(this.pace.restRule);
  }

  async pick() {
    const { picked } = this.app;
    await Promise.all(this.views.map((view, k) =>
      view.pick(picked?.cells[k] ?? -1, k === 0 ? picked?.triangle ?? -1 : -1, this.theme)));
    this.redraw();
  }

  /** Fits the drawing buffer to the canvas. */
  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.ratio = Math.min(greatestRatio, devicePixelRatio || 1);
    this.size = [Math.max(1, clientWidth), Math.max(1, clientHeight)];
    [this.canvas.width, this.canvas.height] = this.size.map((s) => Math.round(s * this.ratio));
    this.onLayout?.(this.windows());
    this.draw(this.pace.restRule);
  }

  /** The views' windows in CSS pixels of the canvas. */
  windows() {
    const [width, height] = this.size;
    const count = Math.max(1, this.views.length);
    const beside = width > height;
    const [w, h] = beside ? [width / count, height] : [width, height / count];
    return Array.from({ length: count }, (_, k) =>
      ({ x: beside ? k * w : 0, y: beside ? 0 : k * h, width: w, height: h }));
  }

  /** The view under a pixel of the canvas, and the pixel from the middle of its window. */
  viewAt(x, y) {
    const windows = this.windows();
    const found = windows.findIndex((w) => x >= w.x && x < w.x + w.width && y >= w.y && y < w.y + w.height);
    const k = Math.max(0, found);
    const w = windows[k];
    return { view: this.views[k], k, x: x - w.x - w.width / 2, y: y - w.y - w.height / 2, window: w };
  }

  /** To be called after a camera moved. */
  moved() {
    this.pace.moved();
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.app.emit("rest"), restAfter);
    this.redraw();
  }

  /** @param a, b longitude and latitude in degrees, or x and y of a plane. */
  lookAt(a, b, zoom) {
    for (const { mesh, camera } of this.views) {
      camera.lookAtPoint(mesh.plane ? mesh.fromFile([a, b]) : unitVector(a, b));
      if (zoom) camera.setZoom(zoom);
    }
    this.moved();
  }

  /** The values of a measure in the windows, an array a view. */
  valuesInSight(measure) {
    return Promise.all(this.views.map(async (view, k) => {
      const values = await view.mesh.values(measure.name);
      const set = await view.setOf(measure.on);
      const { width, height } = this.windows()[k];
      const ids = values ? set.idsIn(view.camera.frame(width, height)) : [];
      return Float64Array.from(ids, (id) => values[id]);
    }));
  }

  redraw() {
    if (this.requested || !this.size) return;
    this.requested = requestAnimationFrame((now) => {
      this.requested = 0;
      this.animate(now);
    });
  }

  animate(now) {
    const moving = this.pace.frame(now);
    const missing = this.draw(moving ? this.pace.movingRule : this.pace.restRule, moving);
    if (missing || moving) this.redraw();
  }

  /** Draws all views; returns whether shapes are still to be built. */
  draw(rule, moving = false) {
    if (!this.size || !this.views.length || this.gl.isContextLost()) return false;
    let missing = false;
    const all = () => {
      missing = this.drawViews(rule);
    };
    // squares gain nothing from several samples a pixel
    if (moving || this.views.every((view) => view.hasSquaresOnly)) all();
    else this.smooth.drawWith(all);
    if (this.views.every((view) => view.kind)) this.firstDrawn();
    return missing;
  }

  /** Resolves when everything in the windows is decoded, built and drawn. */
  async settled() {
    do {
      await Promise.all(this.views.map((view) => view.preparation()));
      await new Promise(requestAnimationFrame);
    } while (this.draw(this.pace.wholeRule) || this.views.some((view) => view.isWaiting()));
  }

  drawViews(rule) {
    const { gl, theme, ratio, globe } = this;
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...theme.background.map((c) => c / 255), 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.SCISSOR_TEST);
    const missing = this.windows().map((window, k) => {
      const box = this.pixelBox(window);
      gl.viewport(...box);
      gl.scissor(...box);
      const frame = this.views[k].camera.frame(box[2], box[3]);
      const coast = this.app.coast ? this.coast : null;
      return this.views[k].draw({ frame, rule, theme, ratio, globe, coast });
    });
    return missing.some(Boolean);
  }

  /** A window in pixels of the drawing buffer, from its lower left corner. */
  pixelBox({ x, y, width, height }) {
    const [left, right] = [x, x + width].map((s) => Math.round(s * this.ratio));
    const [top, bottom] = [y, y + height].map((s) => Math.round(s * this.ratio));
    return [left, this.canvas.height - bottom, Math.max(1, right - left), Math.max(1, bottom - top)];
  }
}
