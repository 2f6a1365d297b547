// SPDX-License-Identifier: GPL-3.0-or-later
/** One mesh in its window of the stage: its sets of shapes, their colours, marks and outlines. */
import { ShapeSet } from "../scene/patches.js";
import { shapesOf } from "../scene/shapes.js";
import { outline } from "../scene/fans.js";
import { paint } from "../colour/paint.js";
import { ShapesLayer } from "../gl/shapes_layer.js";
import { Dots } from "../gl/dots.js";
import { Lines } from "../gl/lines.js";

/** Meshes of at most this many shapes are decoded wholly before their first picture. */
const decodedFirst = 200000;

export class View {
  /** @param tools {gl, programs, lines}: the programs of squares and fans, and of lines. */
  constructor(tools, mesh, camera) {
    Object.assign(this, { tools, mesh, camera, sets: {}, layers: {} });
    this.dots = new Dots(tools.gl, tools.programs.points);
    this.outline = new Lines(tools.gl, tools.lines);
    this.triangleOutline = new Lines(tools.gl, tools.lines);
    this.pin = new Dots(tools.gl, tools.programs.points);
    this.picked = -1;
  }

  /** The set of a kind, "cells" or "triangles"; triangles are decoded first. */
  async setOf(kind) {
    if (!this.sets[kind]) {
      const shapes = shapesOf(this.mesh, kind);
      if (kind === "triangles" || shapes.count <= decodedFirst) await shapes.prepare();
      this.sets[kind] ??= new ShapeSet(shapes);
    }
    return this.sets[kind];
  }

  /** Makes what drawing shapes of a kind needs. */
  async prepareLayer(kind) {
    const set = await this.setOf(kind);
    this.layers[kind] ??= new ShapesLayer(this.tools.gl, this.tools.programs, set);
  }

  /** Shows shapes of a kind, whose layer is there, in the colours of a scale. */
  show(kind, { values, scale, tables, masks, theme }) {
    this.kind = kind;
    const { set } = this.layers[kind];
    this.layers[kind].setColours(paint(set.order, values, scale, tables, masks));
    this.dots.set(set, masks.filter ?? masks.marks, theme.accent);
  }

  /** Outlines a cell, and a triangle; -1: none. */
  async pick(cell, triangle, theme) {
    this.picked = cell;
    this.accent = theme.accent;
    await this.drawOutline(this.outline, "cells", cell);
    await this.drawOutline(this.triangleOutline, "triangles", triangle);
  }

  async drawOutline(lines, kind, id) {
    if (kind === "cells") this.pin.setOne(null);
    if (id < 0) {
      lines.set([]);
      return;
    }
    const { shapes } = await this.setOf(kind);
    await shapes.prepare();
    if (this.disposed) return;
    const ring = outline(shapes, id);
    const centre = shapes.centre(id, [0, 0, 0]);
    lines.set(ring.length ? [[...ring, ring[0]]] : [], centre);
    if (kind === "cells" && !ring.length) this.pin.setOne(centre, this.accent);
  }

  /** @param rule see ShapesLayer.draw. Returns whether shapes are still to be built. */
  draw({ frame, rule, theme, ratio, globe, coast }) {
    if (frame.sphere) globe.drawDisc(frame, theme);
    const layer = this.layers[this.kind];
    const missing = layer ? layer.draw(frame, rule, theme, ratio) : false;
    this.hasSquaresOnly = layer?.squaresOnly ?? true;
    if (missing) this.prepare(layer.set.shapes);
    if (coast && frame.sphere) {
      coast.draw(frame, 3 * ratio, theme.background, 0.45);
      coast.draw(frame, 1.2 * ratio, theme.coast);
    }
    this.dots.draw(frame, ratio);
    if (frame.sphere) globe.drawRim(frame, theme, ratio);
    this.pin.draw(frame, ratio, 11);
    for (const lines of [this.triangleOutline, this.outline]) {
      lines.draw(frame, 4.5 * ratio, theme.background);
      lines.draw(frame, 2.5 * ratio, theme.accent);
    }
    return missing && layer.set.shapes.ready;
  }

  /** Decodes what fans need, and calls back when it is there. */
  prepare(shapes) {
    if (shapes.ready || this.preparing === shapes) return;
    this.preparing = shapes;
    shapes.prepare().then(() => this.tools.redraw());
  }

  /** Whether shapes are drawn as squares until they are decoded. */
  isWaiting() {
    return Boolean(this.preparing && !this.preparing.ready);
  }

  preparation() {
    return this.preparing?.prepare();
  }

  /** Width in device pixels of a cell under a frame; for zooming to it. */
  sizeOf(kind, id) {
    return this.sets[kind]?.sizeOf(id) ?? 0;
  }

  dispose() {
    for (const layer of Object.values(this.layers)) layer.dispose();
    for (const part of [this.dots, this.pin, this.outline, this.triangleOutline]) part.dispose();
    this.disposed = true;
  }
}
