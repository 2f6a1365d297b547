// SPDX-License-Identifier: GPL-3.0-or-later
/** Draws a set of shapes: its patches as squares or as fans, by their size on the screen. */
import { buildFans } from "../scene/fans.js";
import { inWindow } from "../scene/patches.js";
import {
  attribute, chooseProvokingVertex, clipScale, makeBuffer, makeProgram, offsetOf, rotation,
} from "./context.js";
import { fansFragment, fansVertex, plainFragment, pointsFragment, pointsVertex } from "./shaders.js";

/** A patch whose shapes are smaller than this many pixels needs no lines. */
const lineless = 5;

/** Fans of at most this many shapes are kept; those not used for longest go first. */
const keptShapes = 500000;

/** Squares overlap by this factor, so that no gaps are left between irregular places. */
const overlap = 1.35;

/** The same where patches are thinned: a prefix is less even than the whole. */
const thinnedOverlap = 1.75;

/** Squares are no wider than this many pixels; where they stand for cells without shapes, and so stay small. */
const widest = 64;
const widestDot = 8;

/** The longest vertex list of a fan patch: colours are read up to it behind the last slot. */
const colourPadding = 65536 * 4;

/** The programs of a context, which all layers share. */
export function shapePrograms(gl) {
  return {
    centreFirst: chooseProvokingVertex(gl),
    points: makeProgram(gl, pointsVertex, pointsFragment),
    fans: makeProgram(gl, fansVertex, fansFragment),
    plain: makeProgram(gl, fansVertex, plainFragment),
  };
}

export class ShapesLayer {
  constructor(gl, programs, set) {
    Object.assign(this, { gl, programs, set });
    this.frames = 0;
    this.built = new Map();
    this.builtShapes = 0;
    this.places = makeBuffer(gl, gl.ARRAY_BUFFER, set.centres);
    this.colours = makeBuffer(gl, gl.ARRAY_BUFFER, 4 * set.order.length + colourPadding, gl.DYNAMIC_DRAW);
    this.points = gl.createVertexArray();
    gl.bindVertexArray(this.points);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    attribute(gl, 0, 4, gl.FLOAT);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.colours);
    attribute(gl, 1, 4, gl.UNSIGNED_BYTE);
    gl.bindVertexArray(null);
  }

  /** @param words one colour a slot. */
  setColours(words) {
    const { gl } = this;
    this.words = words;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.colours);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, words);
    for (const fans of this.built.values()) if (fans.slots) this.setOwnColours(fans);
  }

  setOwnColours(fans) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, fans.colours);
    gl.bufferData(gl.ARRAY_BUFFER, fans.slots.map((slot) => this.words[slot]), gl.DYNAMIC_DRAW);
  }

  /**
   * Draws what is in the window.
   * @param rule {pointsBelow: px of the largest shapes drawn as squares; pointSpacing: px between
   *   squares; budget: ms for building fans}.
   * Returns whether fans are still missing, for which squares stand in.
   */
  draw(frame, rule, theme, ratio) {
    this.frames++;
    const visible = this.set.patches.filter((patch) => inWindow(patch, frame));
    const size = (patch) => patch.size * frame.scale;
    const small = (patch) => size(patch) < rule.pointsBelow * ratio;
    const fans = visible.filter((patch) => !small(patch));
    this.squaresOnly = fans.length === 0;
    const end = performance.now() + rule.budget;
    const missing = fans.filter((patch) => !this.prepared(patch, end));
    const squares = this.set.shapes.dotted ? visible : [...visible.filter(small), ...missing];
    this.drawSquares(squares, frame, rule, ratio);
    const lined = (patch) => size(patch) >= lineless * ratio;
    this.drawFans(this.programs.plain, fans.filter((p) => !lined(p)), frame, theme, ratio);
    this.drawFans(this.programs.fans, fans.filter(lined), frame, theme, ratio);
    this.forgetOldFans();
    return missing.length > 0;
  }

  /** Whether a patch has its fans; builds them if there is time. */
  prepared(patch, end) {
    let fans = this.built.get(patch);
    if (!fans && this.set.shapes.ready && performance.now() < end) fans = this.build(patch);
    if (fans) fans.frame = this.frames;
    return Boolean(fans);
  }

  build(patch) {
    const { gl } = this;
    const { points, indices, slots } = buildFans(this.set, patch, this.programs.centreFirst);
    const fans = { slots, count: indices.length, shapes: patch.count };
    fans.type = indices instanceof Uint16Array ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT;
    fans.array = gl.createVertexArray();
    gl.bindVertexArray(fans.array);
    fans.places = makeBuffer(gl, gl.ARRAY_BUFFER, points);
    attribute(gl, 0, 4, gl.FLOAT);
    if (slots) {
      fans.colours = gl.createBuffer();
      this.setOwnColours(fans);
    } else {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.colours);
    }
    attribute(gl, 1, 4, gl.UNSIGNED_BYTE, { offset: slots ? 0 : 4 * patch.first });
    fans.indices = makeBuffer(gl, gl.ELEMENT_ARRAY_BUFFER, indices);
    gl.bindVertexArray(null);
    this.built.set(patch, fans);
    this.builtShapes += patch.count;
    return fans;
  }

  drawSquares(patches, frame, rule, ratio) {
    if (!patches.length) return;
    const { gl } = this;
    const { uniforms } = this.begin(this.programs.points, frame);
    gl.bindVertexArray(this.points);
    gl.uniform1f(uniforms.u_horizon, frame.sphere ? 0 : -1e30);
    gl.uniform1f(uniforms.u_least, 1);
    gl.uniform1f(uniforms.u_most, this.set.shapes.mesh.part ? widestDot * ratio : widest);
    for (const patch of patches) {
      const demanded = ((patch.size * frame.scale) / (rule.pointSpacing * ratio)) ** 2;
      const count = Math.max(1, Math.min(patch.count, Math.ceil(patch.count * demanded)));
      gl.uniform3fv(uniforms.u_offset, offsetOf(frame, patch.centre));
      const wider = count < patch.count ? thinnedOverlap : overlap;
      gl.uniform1f(uniforms.u_pixels, wider * frame.scale * Math.sqrt(patch.count / count));
      gl.drawArrays(gl.POINTS, patch.first, count);
    }
  }

  drawFans(program, patches, frame, theme, ratio) {
    if (!patches.length) return;
    const { gl } = this;
    const { uniforms } = this.begin(program, frame);
    if (uniforms.u_edge) gl.uniform4f(uniforms.u_edge, ...theme.edge.map((c) => c / 255), 0.5);
    if (uniforms.u_ratio) gl.uniform1f(uniforms.u_ratio, ratio);
    if (uniforms.u_sphere) gl.uniform1f(uniforms.u_sphere, frame.sphere ? 1 : 0);
    // the far side: fans are counter-clockwise from outside
    if (frame.sphere) gl.enable(gl.CULL_FACE);
    for (const patch of patches) {
      const fans = this.built.get(patch);
      if (!fans) continue;
      gl.uniform3fv(uniforms.u_offset, offsetOf(frame, patch.centre));
      gl.bindVertexArray(fans.array);
      gl.drawElements(gl.TRIANGLES, fans.count, fans.type, 0);
    }
    gl.disable(gl.CULL_FACE);
    gl.bindVertexArray(null);
  }

  begin(program, frame) {
    const { gl } = this;
    gl.useProgram(program.program);
    gl.uniformMatrix3fv(program.uniforms.u_rotation, false, rotation(frame));
    gl.uniform2fv(program.uniforms.u_clip, clipScale(frame));
    return program;
  }

  forgetOldFans() {
    if (this.builtShapes <= keptShapes) return;
    const oldest = [...this.built].sort(([, a], [, b]) => a.frame - b.frame);
    for (const [patch, fans] of oldest) {
      if (this.builtShapes <= keptShapes || fans.frame === this.frames) return;
      this.forget(patch, fans);
    }
  }

  forget(patch, fans) {
    const { gl } = this;
    gl.deleteVertexArray(fans.array);
    for (const buffer of [fans.places, fans.indices, fans.colours]) if (buffer) gl.deleteBuffer(buffer);
    this.built.delete(patch);
    this.builtShapes -= fans.shapes;
  }

  dispose() {
    for (const [patch, fans] of this.built) this.forget(patch, fans);
    this.gl.deleteVertexArray(this.points);
    this.gl.deleteBuffer(this.places);
    this.gl.deleteBuffer(this.colours);
  }
}
