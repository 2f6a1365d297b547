// SPDX-License-Identifier: GPL-3.0-or-later
/** The disc under the shapes, and a smooth edge over them. */
import { makeProgram, offsetOf } from "./context.js";
import { discFragment, discVertex, ringFragment, ringVertex } from "./shaders.js";

const pieces = 360;

export class Globe {
  constructor(gl) {
    this.gl = gl;
    this.disc = makeProgram(gl, discVertex, discFragment);
    this.ring = makeProgram(gl, ringVertex, ringFragment);
    this.array = gl.createVertexArray();
  }

  /** The sphere where no shape covers it. */
  drawDisc(frame, theme) {
    const { gl } = this;
    const { uniforms } = this.begin(this.disc, frame, theme.globe, 1);
    gl.uniform1f(uniforms.u_radius, frame.scale);
    this.drawStrip();
  }

  /** Covers what stands over the edge with the background, and draws the edge's line. */
  drawRim(frame, theme, ratio) {
    // the edge is far outside a window that is zoomed in
    if (frame.scale > 2 * Math.hypot(frame.width, frame.height)) return;
    const edge = frame.scale;
    this.drawRing(frame, [edge - 2 * ratio, edge + 40 * ratio], theme.background, [edge - ratio / 2, 1]);
    this.drawRing(frame, [edge - ratio, edge + ratio], theme.rim, [edge + ratio / 2, -1], 0.5);
  }

  drawRing(frame, radii, colour, fade, alpha = 1) {
    const { gl } = this;
    const { uniforms } = this.begin(this.ring, frame, colour, alpha);
    gl.uniform2f(uniforms.u_radii, ...radii);
    gl.uniform2f(uniforms.u_fade, ...fade);
    gl.enable(gl.BLEND);
    this.drawStrip();
    gl.disable(gl.BLEND);
  }

  begin(program, frame, colour, alpha) {
    const { gl } = this;
    const { uniforms } = program;
    const [x, y] = offsetOf(frame, [0, 0, 0]);
    gl.useProgram(program.program);
    gl.uniform2f(uniforms.u_size, frame.width, frame.height);
    gl.uniform2f(uniforms.u_middle, x * frame.scale, y * frame.scale);
    gl.uniform1f(uniforms.u_pieces, pieces);
    gl.uniform4f(uniforms.u_colour, ...colour.map((c) => c / 255), alpha);
    return program;
  }

  drawStrip() {
    const { gl } = this;
    gl.bindVertexArray(this.array);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 2 * pieces + 2);
    gl.bindVertexArray(null);
  }
}
