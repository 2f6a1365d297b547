// SPDX-License-Identifier: GPL-3.0-or-later
/** Counts of values in the bars of a histogram. */

export const bars = 40;

/**
 * The bars along a scale: [{low, high, from, to, beyond}], values from low to high, drawn from `from`
 * to `to` (0 to 1). Where values lie beyond an end of the scale, a bar of its own counts them; else
 * the outermost bars have no bound, so that rounding loses no value.
 */
export function barsOf(scale) {
  if (scale.empty) return [];
  if (scale.constant) return [{ low: -Infinity, high: Infinity, from: 0.45, to: 0.55 }];
  const list = [];
  for (let k = 0; k < bars; k++) {
    list.push({
      low: k ? scale.valueAt(k / bars) : -Infinity,
      high: k + 1 < bars ? scale.valueAt((k + 1) / bars) : Infinity,
      from: k / bars,
      to: (k + 1) / bars,
    });
  }
  if (scale.below) list.unshift(beyond({ low: -Infinity, high: scale.low, from: -0.05, to: -0.01 }));
  if (scale.above) list.push(beyond({ low: scale.high, high: Infinity, from: 1.01, to: 1.05 }));
  if (scale.below) list[1].low = scale.low;
  if (scale.above) list[list.length - 2].high = scale.high;
  return list;
}

const beyond = (bar) => ({ ...bar, beyond: true });

/** The number of values in each bar. */
export function countBars(values, scale, list) {
  const counts = new Array(list.length).fill(0);
  if (scale.constant || !list.length) {
    if (list.length) counts[0] = values.reduce((sum, v) => sum + Number.isFinite(v), 0);
    return counts;
  }
  const first = scale.below ? 1 : 0;
  for (let i = 0; i < values.length; i++) {
    const v = values[i];
    if (!Number.isFinite(v)) continue;
    if (scale.below && v < scale.low) counts[0]++;
    else if (scale.above && v > scale.high) counts[list.length - 1]++;
    else counts[first + Math.max(0, Math.min(bars - 1, Math.floor(scale.position(v) * bars)))]++;
  }
  return counts;
}
