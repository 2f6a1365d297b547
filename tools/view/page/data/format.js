// SPDX-License-Identifier: GPL-3.0-or-later
/** Numbers as text. */
import { format } from "d3-format";

const significant = format(".4~r");
const exponent = format(".3~e");
const grouped = format(",");

/** A narrow space between groups of three digits; a real minus sign. */
const typeset = (text) => text.replace(/,/g, "\u202f").replace(/-/g, "\u2212");

/** Four significant digits. */
export function number(value) {
  if (value == null || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "\u2212∞";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e7)) return typeset(exponent(value)).replace("e+", "e");
  return typeset(size >= 1e4 ? grouped(Math.round(value)) : significant(value));
}

export const count = (value) => typeset(grouped(value));

/** A unit as it is printed: degrees as a sign, powers raised. */
export function unitText(unit) {
  const known = { degrees: "°", degree: "°", steradians: "sr" }[unit];
  return known ?? unit.replace(/\^2/g, "²").replace(/\^3/g, "³").replace(/\^-1/g, "⁻¹");
}

export function withUnit(value, unit) {
  const text = number(value);
  if (!unit || text === "–") return text;
  return unitText(unit) === "°" ? `${text}°` : `${text}\u00a0${unitText(unit)}`;
}

/** A coordinate in degrees with its direction, such as 12.34° W. */
export function longitude(value) {
  return `${Math.abs(value).toFixed(2)}° ${value < 0 ? "W" : "E"}`;
}

export function latitude(value) {
  return `${Math.abs(value).toFixed(2)}° ${value < 0 ? "S" : "N"}`;
}

/** A place {lon, lat} or {x, y} in words. */
export function placeText(place) {
  return "lon" in place
    ? `${longitude(place.lon)}, ${latitude(place.lat)}`
    : `${number(place.x)}, ${number(place.y)}`;
}

/** A label with its unit, for headings. */
export const labelOf = (measure) =>
  measure.unit ? `${measure.label} (${unitText(measure.unit)})` : measure.label;
