// SPDX-License-Identifier: GPL-3.0-or-later
/** A multisampled target for pictures at rest; while moving the canvas is drawn on directly. */
export class SmoothTarget {
  constructor(gl) {
    this.gl = gl;
    this.samples = Math.min(4, gl.getParameter(gl.MAX_SAMPLES) ?? 0);
    this.framebuffer = gl.createFramebuffer();
    this.colours = gl.createRenderbuffer();
    [this.width, this.height] = [0, 0];
  }

  /** Draws by `draw` with several samples a pixel. */
  drawWith(draw) {
    const { gl } = this;
    if (this.samples < 2) {
      draw();
      return;
    }
    this.resize(gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    draw();
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.framebuffer);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    const box = [0, 0, this.width, this.height];
    gl.blitFramebuffer(...box, ...box, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  resize(width, height) {
    if (this.width === width && this.height === height) return;
    const { gl } = this;
    [this.width, this.height] = [width, height];
    gl.bindRenderbuffer(gl.RENDERBUFFER, this.colours);
    gl.renderbufferStorageMultisample(gl.RENDERBUFFER, this.samples, gl.RGBA8, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, this.colours);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }
}
