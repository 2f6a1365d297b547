// SPDX-License-Identifier: GPL-3.0-or-later
/** The shaders. Places are relative to a patch; u_offset is the patch in rotated coordinates. */

const head = "#version 300 es\nprecision highp float;\n";

const place = `
uniform mat3 u_rotation;
uniform vec3 u_offset;
uniform vec2 u_clip;
vec4 outside() { return vec4(2.0, 2.0, 2.0, 1.0); }
`;

/** Shapes as squares of their size. a_place.w is the size in units of the drawing. */
export const pointsVertex = `${head}${place}
layout(location = 0) in vec4 a_place;
layout(location = 1) in vec4 a_colour;
uniform float u_pixels;   // pixels per unit of the drawing, times the widening of a thinned patch
uniform float u_least;    // smallest and largest width in pixels
uniform float u_most;
uniform float u_horizon;  // places farther than this are hidden
flat out vec4 v_colour;
void main() {
  vec3 p = u_rotation * a_place.xyz + u_offset;
  gl_Position = p.z < u_horizon ? outside() : vec4(p.xy * u_clip, 0.0, 1.0);
  gl_PointSize = clamp(a_place.w * u_pixels, u_least, u_most);
  v_colour = a_colour;
}`;

export const pointsFragment = `${head}
flat in vec4 v_colour;
out vec4 colour;
void main() { colour = v_colour; }`;

/** Shapes as fans. a_place.w is 1 at the centre and 0 at the rim. */
export const fansVertex = `${head}${place}
layout(location = 0) in vec4 a_place;
layout(location = 1) in vec4 a_colour;
uniform float u_sphere;   // 1 on the sphere, 0 in a plane
flat out vec4 v_colour;
out float v_inside;
out float v_facing;       // how much a shape faces the viewer: 0 at the edge of the globe
void main() {
  vec3 p = u_rotation * a_place.xyz + u_offset;
  gl_Position = vec4(p.xy * u_clip, 0.0, 1.0);
  v_colour = a_colour;
  v_inside = a_place.w;
  v_facing = mix(1.0, p.z, u_sphere);
}`;

/** The rim's line is one pixel wide and fades in with the pixels from the centre to the rim, for all sides of a
    foreshortened shape alike. */
export const fansFragment = `${head}
flat in vec4 v_colour;
in float v_inside;
in float v_facing;
uniform vec4 u_edge;
uniform float u_ratio;  // device pixels per CSS pixel
out vec4 colour;
void main() {
  float slope = length(vec2(dFdx(v_inside), dFdy(v_inside)));
  float reach = 1.0 / max(slope, 1e-9) / u_ratio;
  float away = v_inside * reach;
  float line = (1.0 - smoothstep(0.1, 0.9, away)) * u_edge.a * smoothstep(3.0, 8.5, reach * v_facing);
  colour = vec4(mix(v_colour.rgb, u_edge.rgb, line), 1.0);
}`;

/** Without lines, for shapes too small to have them. */
export const plainFragment = `${head}
flat in vec4 v_colour;
out vec4 colour;
void main() { colour = v_colour; }`;

/** Segments as rectangles: vertices 4 k to 4 k + 3 are the corners of segment k. */
export const linesVertex = `${head}${place}
layout(location = 0) in vec3 a_from;
layout(location = 1) in vec3 a_to;
uniform vec2 u_size;      // of the window, pixels
uniform float u_width;    // of the line, pixels
uniform float u_horizon;
out float v_across;
void main() {
  vec3 p = u_rotation * a_from + u_offset;
  vec3 q = u_rotation * a_to + u_offset;
  vec2 a = p.xy * u_clip * u_size * 0.5;
  vec2 b = q.xy * u_clip * u_size * 0.5;
  float reach = 0.5 * u_width + 1.0;
  vec2 along = b - a;
  along = dot(along, along) > 1e-12 ? normalize(along) : vec2(1.0, 0.0);
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  bool end = (gl_VertexID & 2) != 0;
  vec2 c = (end ? b + along * 0.5 * u_width : a - along * 0.5 * u_width)
         + side * reach * vec2(-along.y, along.x);
  v_across = side * reach;
  gl_Position = p.z < u_horizon || q.z < u_horizon ? outside() : vec4(c / u_size * 2.0, 0.0, 1.0);
}`;

export const linesFragment = `${head}
in float v_across;
uniform vec4 u_colour;
uniform float u_width;
out vec4 colour;
void main() {
  float a = clamp(0.5 * u_width + 0.5 - abs(v_across), 0.0, 1.0) * u_colour.a;
  colour = vec4(u_colour.rgb * a, a);
}`;

/** A disc of u_radius pixels, as horizontal slabs. */
export const discVertex = `${head}
uniform vec2 u_size;
uniform vec2 u_middle;
uniform float u_radius;
uniform float u_pieces;
void main() {
  float angle = float(gl_VertexID / 2) / u_pieces * 3.141592653589793;
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  vec2 p = u_middle + u_radius * vec2(side * sin(angle), cos(angle));
  gl_Position = vec4(p / u_size * 2.0, 0.0, 1.0);
}`;

export const discFragment = `${head}
uniform vec4 u_colour;
out vec4 colour;
void main() { colour = u_colour; }`;

/** A ring around the globe's middle, from radius u_radii.x to u_radii.y in pixels. */
export const ringVertex = `${head}
uniform vec2 u_size;
uniform vec2 u_middle;  // the globe's, pixels from the window's
uniform vec2 u_radii;
uniform float u_pieces;
out float v_radius;
void main() {
  float angle = float(gl_VertexID / 2) / u_pieces * 6.283185307179586;
  v_radius = (gl_VertexID & 1) == 0 ? u_radii.x : u_radii.y;
  // chords of the outer circle would cut it
  float outer = (gl_VertexID & 1) == 0 ? v_radius : v_radius / cos(3.14159265 / u_pieces);
  gl_Position = vec4((u_middle + outer * vec2(cos(angle), sin(angle))) / u_size * 2.0, 0.0, 1.0);
}`;

/** Opaque inside u_fade.x, clear from there by one pixel; with u_fade.y < 0 the other way round. */
export const ringFragment = `${head}
in float v_radius;
uniform vec4 u_colour;
uniform vec2 u_fade;
out vec4 colour;
void main() {
  float a = clamp((v_radius - u_fade.x) * u_fade.y + 0.5, 0.0, 1.0) * u_colour.a;
  colour = vec4(u_colour.rgb * a, a);
}`;
