// SPDX-License-Identifier: GPL-3.0-or-later
/** Colour maps, and the colours of classes. Colours are [r, g, b] from 0 to 255. */

/** 25 colours at equal steps, six hexadecimal digits each; between them colours are interpolated. */
const stops = {
  // van der Walt and Smith, 2015 (CC0)
  viridis:
    "440154471063481f70472d7b4439834046883b528b365d8d31688e2c728e287c8e24868e21918c1f9a8a20a486" +
    "28ae8035b77948c16e5ec96275d05490d743addc30c8e020e5e419fde725",
  // Nunez, Anderton and Renslow, 2018
  cividis:
    "00224e002a5f0031701a386f2a3f6d38476c434e6c4d556c575d6d61656f6a6c717374757d7c78868379918b78" +
    "9b9476a59c74b0a571bcae6cc6b667d2c060dec958e9d34ef6dd3ffee838",
  // van der Walt and Smith, 2015 (CC0)
  magma:
    "000004050416100b2d1d11472c115f3f0f7251127c601880721f81832681932b80a5317eb73779c73d73d8456c" +
    "e75263f1605df8745cfc8961fd9b6bfeb078fec488fed799fdebacfcfdbf",
  // blue, pale grey, red; interpolated in OKLab
  diverging:
    "0b2a5b11366b18437b1e508c265d9d2d6bae447dbb6091c57ba5d096b9dab1cde3d0dee8efeeecf1d8cdf1c2ae" +
    "eaab96e2937eda7b66d0634ec34c3bae403699343285282d711c285e0f23",
};

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

/** A regular mesh has degree 6; fewer is blue, more is red. */
const degreeColours = { 4: "2166ac", 5: "74add1", 6: "e6e8ea", 7: "e8785a", 8: "c0304b" };

/** The region, its relaxation zone, its specified zone; as in the command's pictures. */
const regionColours =
  ["9fcfb5", "fdd9a0", "fcb96a", "f6953f", "e06f1f", "b94a0c", "8b93a1", "565d6b"];

/** Okabe and Ito, 2008, and three more. */
const otherColours = ["0072b2", "e69f00", "009e73", "cc79a7", "56b4e9", "d55e00", "f0e442",
                      "7a5195", "8c8c8c", "a05a2c"];

/** The colour of a class of a measure. @param position of the class among the classes. */
export function classColour(measureName, value, position) {
  if (measureName === "degree") {
    return hex(degreeColours[value] ?? (value < 4 ? "0b2a5b" : "7a0c2e"));
  }
  if (measureName === "region" && regionColours[value]) return hex(regionColours[value]);
  return hex(otherColours[position % otherColours.length]);
}
