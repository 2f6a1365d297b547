// SPDX-License-Identifier: GPL-3.0-or-later
/** Dots over marked shapes that are too small to be seen, and on picked cells that have no shape. */
import { attribute, clipScale, makeBuffer, offsetOf, rotation } from "./context.js";

/** More marked shapes than this form areas that are seen without dots. */
const most = 5000;

/** Shapes of more pixels need no dot. */
const largest = 7;

export class Dots {
  /** @param program of squares. */
  constructor(gl, program) {
    Object.assign(this, { gl, program, count: 0 });
  }

  /** Dots on the shapes of a set that a mask marks, in a colour; null: none. */
  set(set, mask, colour) {
    this.dispose();
    if (!mask) return;
    const places = [];
    const place = [0, 0, 0];
    for (let id = 0; id < mask.length && places.length <= 4 * most; id++) {
      if (mask[id] && set.shapes.shown(id)) places.push(...set.shapes.centre(id, place), 0);
    }
    if (places.length > 4 * most) return;
    this.upload(places, colour);
    this.size = set.patches.reduce((sum, p) => sum + p.size * p.count, 0) / set.order.length;
  }

  /** One dot, whatever the size of shapes; null: none. */
  setOne(place, colour) {
    this.dispose();
    if (place) this.upload([...place, 0], colour);
    this.size = 0;
  }

  upload(places, colour) {
    const { gl } = this;
    this.count = places.length / 4;
    const colours = new Uint8Array(4 * this.count);
    for (let k = 0; k < this.count; k++) colours.set([...colour, 255], 4 * k);
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    this.buffers = [makeBuffer(gl, gl.ARRAY_BUFFER, new Float32Array(places))];
    attribute(gl, 0, 4, gl.FLOAT);
    this.buffers.push(makeBuffer(gl, gl.ARRAY_BUFFER, colours));
    attribute(gl, 1, 4, gl.UNSIGNED_BYTE);
    gl.bindVertexArray(null);
  }

  draw(frame, ratio, width = 4) {
    if (!this.count || this.size * frame.scale > largest * ratio) return;
    const { gl, program: { program, uniforms } } = this;
    gl.useProgram(program);
    gl.uniformMatrix3fv(uniforms.u_rotation, false, rotation(frame));
    gl.uniform3fv(uniforms.u_offset, offsetOf(frame, [0, 0, 0]));
    gl.uniform2fv(uniforms.u_clip, clipScale(frame));
    gl.uniform1f(uniforms.u_pixels, 0);
    gl.uniform1f(uniforms.u_least, width * ratio);
    gl.uniform1f(uniforms.u_most, width * ratio);
    gl.uniform1f(uniforms.u_horizon, frame.sphere ? 0 : -1e30);
    gl.bindVertexArray(this.array);
    gl.drawArrays(gl.POINTS, 0, this.count);
    gl.bindVertexArray(null);
  }

  dispose() {
    if (!this.count) return;
    this.gl.deleteVertexArray(this.array);
    for (const buffer of this.buffers) this.gl.deleteBuffer(buffer);
    this.count = 0;
  }
}
