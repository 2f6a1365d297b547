// SPDX-License-Identifier: GPL-3.0-or-later
/** The WebGL 2 context, programs and buffers. */

/** The context, or null. */
export function makeContext(canvas) {
  return canvas.getContext("webgl2", {
    alpha: true,
    antialias: false,
    depth: false,
    stencil: false,
    powerPreference: "high-performance",
  });
}

/** A program {program, uniforms: location by name}. Attributes have fixed locations in the source. */
export function makeProgram(gl, vertexSource, fragmentSource) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertexSource],
                                [gl.FRAGMENT_SHADER, fragmentSource]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = gl.getAttachedShaders(program).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error(`a shader does not compile: ${[gl.getProgramInfoLog(program), ...logs].join(" ")}`);
  }
  const uniforms = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0;
  for (let k = 0; k < count; k++) {
    const { name } = gl.getActiveUniform(program, k);
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

export function makeBuffer(gl, target, data, usage = gl.STATIC_DRAW) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(target, buffer);
  gl.bufferData(target, data, usage);
  return buffer;
}

/** Enables attribute `location` on the bound array buffer. */
export function attribute(gl, location, size, type, { stride = 0, offset = 0 } = {}) {
  gl.enableVertexAttribArray(location);
  gl.vertexAttribPointer(location, size, type, type === gl.UNSIGNED_BYTE, stride, offset);
}

/** The rotation of a camera's frame, by columns. */
export function rotation({ axes }) {
  return new Float32Array([0, 1, 2].flatMap((k) => axes.map((row) => row[k])));
}

/**
 * The offset of a patch in rotated coordinates. It is computed in double precision: the shaders add
 * it to small numbers, so that deep zooms do not tremble.
 */
export function offsetOf({ axes, centre }, p) {
  return axes.map((row, k) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2] - centre[k]);
}

/** Factors from units of the drawing to clip coordinates. */
export const clipScale = ({ scale, width, height }) => [(2 * scale) / width, (2 * scale) / height];

/** The provoking vertex: the first where the extension allows it, which costs some drivers less. */
export function chooseProvokingVertex(gl) {
  const extension = gl.getExtension("WEBGL_provoking_vertex");
  extension?.provokingVertexWEBGL(extension.FIRST_VERTEX_CONVENTION_WEBGL);
  return Boolean(extension);
}
