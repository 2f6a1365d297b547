// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * window.calotte: what tests of the page drive. Indices of cells are those of the file. Functions that
 * decode return promises.
 */
import { unitVector } from "../data/vector.js";
import { offsetOf } from "../gl/context.js";
import { marksCsv } from "../panel/save.js";
import { project } from "../stage/camera.js";
import { markRanges } from "./marking.js";
import { worstOf } from "./worst.js";

/** @param parts {app, stage, navigation, selection, messages, ready}. */
export function makeTestApi({ app, stage, selection, messages, ready }) {
  const cellOf = (cell, view) => {
    const found = app.shown[view].cellOf(cell);
    if (found < 0) throw new Error(`the page does not hold cell ${cell}`);
    return found;
  };
  return {
    ready,
    firstPicture: null,
    errors: messages,
    measure: (name) => app.chooseMeasure(name),
    shapes: (kind) => app.chooseShapes(kind),
    filter: (name) => app.chooseFilter(name),
    showState: (k) => app.showState(k),
    async pick(cell, view = 0) {
      selection.pickCell(view, cellOf(cell, view));
      return app.describe(view, cellOf(cell, view));
    },
    async picked() {
      if (!app.picked) return null;
      return app.describe(0, app.picked.cells[0]);
    },
    async brush(name, low, high) {
      return (await markRanges(app, [{ name, low, high }])).counts[0];
    },
    async worst(name, view = 0) {
      const mesh = app.shown[view];
      const measure = mesh.measure(name);
      const ids = worstOf(measure, await mesh.values(name));
      return measure.on === "cells" ? ids.map((id) => mesh.fileIndex(id)) : ids;
    },
    csv: () => marksCsv(app),
    clear: () => selection.clear(),
    idle: () => app.idle(),
    ...(stage ? drawingApi(app, stage, selection) : {}),
  };
}

function drawingApi(app, stage, selection) {
  const settled = async () => {
    await app.idle();
    await stage.settled();
  };
  const { gl } = stage;
  const finish = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  const timed = (draw) => {
    const begin = performance.now();
    draw();
    finish();
    return performance.now() - begin;
  };
  return {
    /** @param lon, lat degrees, or x and y of a plane. */
    turn: (lon, lat, zoom) => stage.lookAt(lon, lat, zoom),
    /** Picks what is at a longitude and latitude in sight, as a click does. */
    clickAt(lon, lat) {
      const { width, height } = stage.windows()[0];
      const { x, y } = project(stage.views[0].camera.frame(width, height), unitVector(lon, lat));
      return app.track(selection.pickAt(x + width / 2, y + height / 2));
    },
    frame: () => timed(() => stage.draw(stage.pace.wholeRule)),
    /** Mean ms of frames of a turning globe, after a few that adapt the fineness. */
    moving(frames) {
      const [view] = stage.views;
      const times = [];
      for (let k = 0; k < frames; k++) {
        view.camera.drag(7, 0, 1000, 1000);
        times.push(timed(() => stage.draw(stage.pace.movingRule, true)));
        stage.pace.adapt(times[k]);
      }
      return times.reduce((sum, t) => sum + t, 0) / frames;
    },
    /** Resolves when everything in the window is decoded, built and drawn. */
    settled,
    /** The colours of the pixels at places [lon, lat] on the near side of a globe. */
    async coloursAt(places, view = 0) {
      await settled();
      return coloursAt(stage, places, view);
    },
    async pixels(view = 0) {
      await settled();
      return digest(stage, view);
    },
  };
}

function coloursAt(stage, places, k) {
  stage.draw(stage.pace.wholeRule);
  const { gl } = stage;
  const [left, bottom, width, height] = stage.pixelBox(stage.windows()[k]);
  const frame = stage.views[k].camera.frame(width, height);
  return places.map(([lon, lat]) => {
    const [x, y] = offsetOf(frame, unitVector(lon, lat));
    const bytes = new Uint8Array(4);
    const at = [left + width / 2 + x * frame.scale, bottom + height / 2 + y * frame.scale].map(Math.floor);
    gl.readPixels(...at, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return [...bytes.subarray(0, 3)];
  });
}

/** A checksum of a view's pixels (FNV-1a) and the number of distinct colours. */
function digest(stage, k) {
  stage.draw(stage.pace.wholeRule);
  const { gl } = stage;
  const [x, y, width, height] = stage.pixelBox(stage.windows()[k]);
  const bytes = new Uint8Array(4 * width * height);
  gl.readPixels(x, y, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  const words = new Uint32Array(bytes.buffer);
  let checksum = 0x811c9dc5;
  for (const word of words) checksum = Math.imul(checksum ^ word, 0x01000193);
  return { checksum: checksum >>> 0, colours: new Set(words).size };
}
