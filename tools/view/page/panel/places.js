// SPDX-License-Identifier: GPL-3.0-or-later
/** Places in words, as people paste them: degrees with or without minutes and seconds, letters, names. */

/** Names of the two coordinates, and of their directions, as the letters that stand for them. */
const names = [[/\blat(?:itude)?\b[:=]?/gi, " φ "], [/\b(?:lon|long|lng|longitude)\b[:=]?/gi, " λ "],
               [/\bnorth\b/gi, "N"], [/\bsouth\b/gi, "S"], [/\beast\b/gi, "E"], [/\bwest\b/gi, "W"],
               [/\bdeg(?:rees?)?\b/gi, "°"]];

/** Signs that stand for others. */
const signs = [[/\u2212/g, "-"], [/[º˚]/g, "°"], [/''/g, "\""], [/[′’‘´`]/g, "'"], [/[″”“]/g, "\""],
               [/(\d)[\u202f\u2009](?=\d)/g, "$1"]];

const piece = /([-+]?(?:\d+\.?\d*|\.\d+))\s*([°'":]?)|([NSEW])|([φλ])|([,;()])|\s+|(.)/giy;

const axisOf = { N: "lat", S: "lat", E: "lon", W: "lon", φ: "lat", λ: "lon" };

/** A coordinate on its way: its numbers with their marks, its letter, its axis. */
const empty = () => ({ numbers: [], side: "", axis: "" });

/**
 * Degrees of a text with two coordinates: {lon, lat, order}; order: how two numbers without letters were
 * read, "lat, lon" or, where only that is possible, "lon, lat". Throws an error with a message in words.
 */
export function placeOf(text) {
  const pair = coordinatesOf(text);
  if (pair.length !== 2) throw new Error("Enter two coordinates or one cell index.");
  const values = pair.map(valueOf);
  const [first, second] = pair.map(({ axis }) => axis);
  if (first && first === second) {
    throw new Error(`Both coordinates are ${first === "lat" ? "latitudes" : "longitudes"}.`);
  }
  const lettered = first || second;
  const swapped = lettered ? first === "lon" || second === "lat"
    : Math.abs(values[0]) > 90 && Math.abs(values[1]) <= 90;
  const [lat, lon] = swapped ? values.reverse() : values;
  if (Math.abs(lat) > 90) throw new Error("Latitudes are from −90 to 90.");
  if (Math.abs(lon) > 360) throw new Error("Longitudes are from −180 to 360.");
  return { lon, lat, order: lettered ? "" : swapped ? "lon, lat" : "lat, lon" };
}

/** The coordinates of a text. Letters end or begin one; without letters each number that no mark joins is one. */
function coordinatesOf(text) {
  const plain = [...names, ...signs].reduce((t, [from, to]) => t.replace(from, to), text);
  const lettered = /[NSEWφλ]/i.test(plain);
  const found = [];
  let now = empty();
  const end = () => {
    if (now.numbers.length || now.side || now.axis) found.push(now);
    now = empty();
  };
  for (const [, digits, mark, side, axis, comma, other] of plain.matchAll(piece)) {
    if (other) throw new Error(`“${other}” is not of a coordinate.`);
    if (digits) {
      if (now.numbers.length && !lettered && !joins(now.numbers[now.numbers.length - 1], mark)) end();
      now.numbers.push({ digits, mark });
    } else if (side) {
      const after = now.numbers.length > 0 && !now.side;
      if (!after) end();
      now.side = side.toUpperCase();
      if (after) end();
    } else if (axis) {
      end();
      now.axis = axisOf[axis];
    } else if (comma && now.numbers.length) {
      end();
    }
  }
  end();
  return found.map((c) => ({ ...c, axis: axisWith(c) }));
}

/** Whether a number continues the one before it: minutes after degrees, seconds after minutes. */
const joins = (before, mark) => before.mark === ":" || mark === "'" || mark === "\"";

function axisWith({ side, axis }) {
  const own = axisOf[side] ?? axis;
  if (axis && own !== axis) throw new Error(`A ${axis === "lat" ? "latitude" : "longitude"} has no ${side}.`);
  return own;
}

/** Degrees of a coordinate. */
function valueOf({ numbers, side, axis }) {
  const values = numbers.map(({ digits }) => Number(digits));
  const minus = /^-/.test(numbers[0]?.digits ?? "");
  const rest = numbers.slice(1);
  const joined = axis || rest.every(({ mark }, k) => joins(numbers[k], mark));
  if (!values.length || values.length > 3 || !joined) throw new Error("Enter two coordinates or one cell index.");
  if (minus && side) throw new Error(`A coordinate has a minus sign and ${side}; leave one out.`);
  if (rest.some(({ digits }) => /^[-+]/.test(digits)) || values.slice(1).some((v) => v >= 60)) {
    throw new Error("Minutes and seconds are from 0 to less than 60.");
  }
  const size = values.reduce((sum, value, k) => sum + Math.abs(value) / 60 ** k, 0);
  return minus || side === "S" || side === "W" ? -size : size;
}
