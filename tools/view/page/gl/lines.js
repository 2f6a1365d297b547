// SPDX-License-Identifier: GPL-3.0-or-later
/** Lines of a width in pixels: coastlines and outlines. */
import { attribute, clipScale, makeProgram, offsetOf, rotation } from "./context.js";
import { linesFragment, linesVertex } from "./shaders.js";

export const linesProgram = (gl) => makeProgram(gl, linesVertex, linesFragment);

/**
 * Segments near a centre. Each has four vertices, with both its ends: instances would be fewer numbers,
 * but software rendering draws them one by one.
 */
export class Lines {
  constructor(gl, program) {
    Object.assign(this, { gl, program, count: 0, centre: [0, 0, 0] });
    this.buffer = gl.createBuffer();
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    attribute(gl, 0, 3, gl.FLOAT, { stride: 24 });
    attribute(gl, 1, 3, gl.FLOAT, { stride: 24, offset: 12 });
    this.indices = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices);
    gl.bindVertexArray(null);
  }

  /** @param polylines arrays of places. */
  set(polylines, centre = [0, 0, 0]) {
    const ends = [];
    const relative = (p) => p.map((c, k) => c - centre[k]);
    for (const line of polylines) {
      for (let k = 1; k < line.length; k++) ends.push([...relative(line[k - 1]), ...relative(line[k])]);
    }
    this.centre = centre;
    this.count = ends.length;
    const corners = [0, 1, 2, 2, 1, 3];
    const indices = Uint32Array.from({ length: 6 * this.count }, (_, k) =>
      4 * Math.floor(k / 6) + corners[k % 6]);
    const { gl } = this;
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from(ends.flatMap((e) => [...e, ...e, ...e, ...e])),
      gl.STATIC_DRAW);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
  }

  /** @param width in device pixels. @param colour [r, g, b] to 255. */
  draw(frame, width, colour, alpha = 1) {
    if (!this.count) return;
    const { gl, program: { program, uniforms } } = this;
    gl.useProgram(program);
    gl.uniformMatrix3fv(uniforms.u_rotation, false, rotation(frame));
    gl.uniform3fv(uniforms.u_offset, offsetOf(frame, this.centre));
    gl.uniform2fv(uniforms.u_clip, clipScale(frame));
    gl.uniform2f(uniforms.u_size, frame.width, frame.height);
    gl.uniform1f(uniforms.u_width, width);
    gl.uniform1f(uniforms.u_horizon, frame.sphere ? 0 : -1e30);
    gl.uniform4f(uniforms.u_colour, ...colour.map((c) => c / 255), alpha);
    gl.enable(gl.BLEND);
    gl.bindVertexArray(this.array);
    gl.drawElements(gl.TRIANGLES, 6 * this.count, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
    gl.disable(gl.BLEND);
  }

  dispose() {
    const { gl } = this;
    gl.deleteVertexArray(this.array);
    for (const buffer of [this.buffer, this.indices]) gl.deleteBuffer(buffer);
  }
}
