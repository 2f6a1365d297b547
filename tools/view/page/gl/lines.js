// SPDX-License-Identifier: GPL-3.0-or-later
/** Lines of a width in pixels: coastlines and outlines. */
import { attribute, clipScale, makeProgram, offsetOf, rotation } from "./context.js";
import { linesFragment, linesVertex } from "./shaders.js";

export const linesProgram = (gl) => makeProgram(gl, linesVertex, linesFragment);

/** Segments {from, to} near a centre. */
export class Lines {
  constructor(gl, program) {
    Object.assign(this, { gl, program, count: 0, centre: [0, 0, 0] });
    this.buffer = gl.createBuffer();
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    attribute(gl, 0, 3, gl.FLOAT, { stride: 24, each: 1 });
    attribute(gl, 1, 3, gl.FLOAT, { stride: 24, offset: 12, each: 1 });
    gl.bindVertexArray(null);
  }

  /** @param polylines arrays of places. */
  set(polylines, centre = [0, 0, 0]) {
    const numbers = [];
    const push = (p) => numbers.push(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]);
    for (const line of polylines) {
      for (let k = 1; k < line.length; k++) {
        push(line[k - 1]);
        push(line[k]);
      }
    }
    this.centre = centre;
    this.count = numbers.length / 6;
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
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
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.count);
    gl.bindVertexArray(null);
    gl.disable(gl.BLEND);
  }
}
