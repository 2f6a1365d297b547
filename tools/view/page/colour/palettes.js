// SPDX-License-Identifier: GPL-3.0-or-later
/** Colour maps, and the colours of classes. Colours are [r, g, b] from 0 to 255. */

/** Colours at equal steps, six hexadecimal digits each; between them colours are interpolated. */
let stops = {};

/** @param header of the page: it has the command's colour maps. */
export function readPalettes(header) {
  stops = header.palettes;
}

export const palettes = [
  { name: "viridis", label: "Viridis" },
  { name: "cividis", label: "Cividis" },
  { name: "magma", label: "Magma" },
  { name: "diverging", label: "Blue–red" },
];

export function hex(text) {
  return [0, 2, 4].map((k) => parseInt(text.slice(k, k + 2), 16));
}

/** The colour of a map at `t`, from 0 to 1. */
export function paletteColour(name, t) {
  const text = stops[name];
  const last = text.length / 6 - 1;
  const place = Math.min(1, Math.max(0, t)) * last;
  const k = Math.min(last - 1, Math.floor(place));
  const from = hex(text.slice(6 * k));
  const to = hex(text.slice(6 * k + 6));
  return mix(from, to, place - k);
}

export function mix(from, to, t) {
  return from.map((f, k) => f + (to[k] - f) * t);
}

export const css = (colour) => `rgb(${colour.map(Math.round).join(" ")})`;

/** Okabe and Ito, 2008, and three more. */
const otherColours = ["0072b2", "e69f00", "009e73", "cc79a7", "56b4e9", "d55e00", "f0e442",
                      "7a5195", "8c8c8c", "a05a2c"];

/** The colour of a class of a measure: its own, or that of its position among the classes. */
export function classColour(own, position) {
  return hex(own ?? otherColours[position % otherColours.length]);
}
