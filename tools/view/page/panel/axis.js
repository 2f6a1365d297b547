// SPDX-License-Identifier: GPL-3.0-or-later
/** Ticks of axes, and axes as SVG. */
/*!
Parts of d3-scale, d3-format, d3-time, d3-time-format, d3-interpolate, d3-color, d3-collection and
d3-array, Copyright 2010-2021 Mike Bostock. License: BSD-3-Clause (d3-array: ISC).

Redistribution and use in source and binary forms, with or without modification, are permitted provided
that the following conditions are met:
* Redistributions of source code must retain the above copyright notice, this list of conditions and the
  following disclaimer.
* Redistributions in binary form must reproduce the above copyright notice, this list of conditions and
  the following disclaimer in the documentation and/or other materials provided with the distribution.
* Neither the name of the author nor the names of contributors may be used to endorse or promote products
  derived from this software without specific prior written permission.

THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS AND CONTRIBUTORS "AS IS" AND ANY EXPRESS OR IMPLIED
WARRANTIES, INCLUDING, BUT NOT LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A
PARTICULAR PURPOSE ARE DISCLAIMED. IN NO EVENT SHALL THE COPYRIGHT OWNER OR CONTRIBUTORS BE LIABLE FOR
ANY DIRECT, INDIRECT, INCIDENTAL, SPECIAL, EXEMPLARY, OR CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT
LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR SERVICES; LOSS OF USE, DATA, OR PROFITS; OR BUSINESS
INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY, WHETHER IN CONTRACT, STRICT LIABILITY, OR
TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE OF THIS SOFTWARE, EVEN IF
ADVISED OF THE POSSIBILITY OF SUCH DAMAGE.
*/
import { scaleLinear, scaleLog } from "d3-scale";
import { number } from "../data/format.js";
import { svg } from "./dom.js";

/** Width of a digit of the axes' text, pixels. */
const digitWidth = 6;

/** Below this ratio of the ends a logarithmic axis has the ticks of a linear one. */
const shortRatio = 6;

/** Round values from low to high, the most important first. */
function roundValues(low, high, logarithmic, wanted) {
  if (!logarithmic || high / low < shortRatio) return scaleLinear().domain([low, high]).ticks(wanted);
  const all = scaleLog().domain([low, high]).ticks(100);
  const mantissa = (v) => Math.round(v / 10 ** Math.floor(Math.log10(v) + 1e-9));
  const rank = (v) => [1, 5, 2].indexOf(mantissa(v));
  const decades = Math.max(1, Math.ceil(Math.log10(high / low) / wanted));
  const kept = all.filter((v) => rank(v) >= 0);
  const weight = (v) => (rank(v) > 0 ? rank(v) : Math.round(Math.log10(v)) % decades ? 0.5 : 0);
  return kept.sort((a, b) => weight(a) - weight(b));
}

/**
 * Ticks [{value, at, text}] whose texts do not overlap.
 * @param position from a value to 0 ... 1. @param length of the axis, pixels.
 * @param gap the room that a text takes; null: by its width.
 */
export function ticks({ low, high, logarithmic, position }, length, gap = null) {
  if (!(high > low)) return Number.isFinite(low) ? [{ value: low, at: length / 2, text: number(low) }] : [];
  const placed = [];
  for (const value of roundValues(low, high, logarithmic, Math.max(2, Math.round(length / 60)))) {
    const at = position(value) * length;
    const text = number(value);
    const half = gap ? gap / 2 : (text.length * digitWidth) / 2 + 3;
    if (at < -1e-6 || at > length + 1e-6) continue;
    if (placed.every((other) => Math.abs(other.at - at) >= half + other.half)) {
      placed.push({ value, at, text, half });
    }
  }
  return placed;
}

/** A horizontal axis at height y. Texts at the ends are kept inside. */
export function axisBelow(list, x, y, length) {
  return list.map(({ at, text }) => {
    const half = (text.length * digitWidth) / 2;
    const middle = Math.min(length - half + 10, Math.max(half - 10, at));
    return svg("g", { class: "tick" },
      svg("line", { x1: x + at, x2: x + at, y1: y, y2: y + 4 }),
      svg("text", { x: x + middle, y: y + 15, "text-anchor": "middle" }, text));
  });
}

/** A vertical axis left of x; positions run upwards from y. */
export function axisLeft(list, x, y) {
  return list.map(({ at, text }) => svg("g", { class: "tick" },
    svg("line", { x1: x - 4, x2: x, y1: y - at, y2: y - at }),
    svg("text", { x: x - 6, y: y - at + 3.5, "text-anchor": "end" }, text)));
}

/** The parts of ticks() of a plain range. */
export function plainRange(low, high, logarithmic) {
  const f = logarithmic ? Math.log : (v) => v;
  const span = f(high) - f(low);
  return { low, high, logarithmic, position: (v) => (span ? (f(v) - f(low)) / span : 0.5) };
}
