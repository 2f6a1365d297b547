// SPDX-License-Identifier: GPL-3.0-or-later
/** Scales: from the values of a measure to colours. Both kinds have
 *    size; indexOf(value), from 0 to size - 1, or size where there is no value; rgb(index). */
import { classColour, paletteColour } from "./palettes.js";

const steps = 1024;

/** Places on a scale closer than this are equal. */
const rounding = 1e-9;

/** A scale of at most this many sampled values is computed for its quantiles. */
const sampleSize = 50000;

/** Of a measure with few discrete values. */
export class ClassScale {
  constructor(measure) {
    this.classes = measure.classes.map(({ value, label, colour }, k) =>
      ({ value, label, colour: classColour(colour, k) }));
    this.size = this.classes.length;
    this.places = new Map(this.classes.map(({ value }, k) => [value, k]));
  }

  indexOf(value) {
    return this.places.get(value) ?? this.size;
  }

  rgb(index) {
    return this.classes[index].colour;
  }
}

/**
 * Of a measure with a continuous range.
 *   low, high: values at the ends; below, above: whether values lie beyond them;
 *   empty: no finite value; constant: one value; logarithmic.
 */
export class RangeScale {
  /**
   * @param arrays the values, one array a mesh; @param options {logarithmic, palette,
   * reference: the value in the middle of a diverging palette}.
   */
  constructor(arrays, { logarithmic, palette, reference }) {
    const range = rangeOf(arrays);
    this.size = steps;
    this.palette = palette;
    this.range = range;
    this.empty = range.least > range.greatest;
    this.canBeLogarithmic = range.greatest > 0 && Number.isFinite(range.leastPositive);
    this.logarithmic = logarithmic && this.canBeLogarithmic;
    this.transform = this.logarithmic ? Math.log : (v) => v;
    this.inverse = this.logarithmic ? Math.exp : (v) => v;
    this.setEnds(arrays);
    if (palette === "diverging" && reference != null) this.centre(reference);
    this.constant = !(this.high > this.low);
    [this.from, this.to] = [this.transform(this.low), this.transform(this.high)];
  }

  setEnds(arrays) {
    const { least, greatest, leastPositive } = this.range;
    const values = [this.logarithmic ? leastPositive : least, greatest];
    const ends = values.map(this.transform);
    const clamped = this.empty ? [NaN, NaN] : clampOutliers(sampleOf(arrays, this.transform), ends);
    // ends that are not clamped stay exact
    [this.low, this.high] =
      clamped.map((end, k) => (end === ends[k] ? values[k] : this.inverse(end)));
  }

  /** The values that are shown, which may be others than those that set the ends. */
  show(arrays) {
    this.range = rangeOf(arrays);
    const { least, greatest } = this.range;
    this.below = least <= greatest && this.position(least) < -rounding;
    this.above = least <= greatest && this.position(greatest) > 1 + rounding;
  }

  /** Makes the ends equally far from the reference, so that it has the middle colour. */
  centre(reference) {
    if (this.empty || (this.logarithmic && reference <= 0)) return;
    const middle = this.transform(reference);
    const reach = Math.max(Math.abs(this.transform(this.low) - middle),
                           Math.abs(this.transform(this.high) - middle));
    this.low = this.inverse(middle - reach);
    this.high = this.inverse(middle + reach);
  }

  /** The place of a value on the scale, from 0 to 1 within its ends. */
  position(value) {
    if (this.constant) return 0.5;
    if (this.logarithmic && value <= 0) return -1;
    return (this.transform(value) - this.from) / (this.to - this.from);
  }

  valueAt(position) {
    return this.inverse(this.from + position * (this.to - this.from));
  }

  indexOf(value) {
    if (!Number.isFinite(value)) return steps;
    const place = Math.floor(this.position(value) * steps);
    return place < 0 ? 0 : place < steps ? place : steps - 1;
  }

  rgb(index) {
    return paletteColour(this.palette, index / (steps - 1));
  }
}

function rangeOf(arrays) {
  const range = { least: Infinity, greatest: -Infinity, leastPositive: Infinity, missing: 0 };
  for (const values of arrays) {
    for (let i = 0; i < values.length; i++) {
      const v = values[i];
      if (!Number.isFinite(v)) {
        range.missing++;
        continue;
      }
      if (v < range.least) range.least = v;
      if (v > range.greatest) range.greatest = v;
      if (v > 0 && v < range.leastPositive) range.leastPositive = v;
    }
  }
  return range;
}

/** Sorted, transformed values: all, or at equal steps. */
function sampleOf(arrays, transform) {
  const total = arrays.reduce((sum, values) => sum + values.length, 0);
  const stride = Math.max(1, Math.floor(total / sampleSize));
  const sample = [];
  for (const values of arrays) {
    for (let i = 0; i < values.length; i += stride) {
      const v = transform(values[i]);
      if (Number.isFinite(v)) sample.push(v);
    }
  }
  return Float64Array.from(sample).sort();
}

/**
 * The ends of a scale. Where the outermost hundredth of the values would take more than a fifth of
 * the scale, the end is put at that hundredth. Two rounds: a far outlier at one end hides the other.
 */
function clampOutliers(sample, [least, greatest]) {
  const at = (fraction) => sample[Math.round(fraction * (sample.length - 1))];
  let [low, high] = [least, greatest];
  for (let round = 0; round < 2 && sample.length > 100; round++) {
    const fifth = (high - low) / 5;
    if (at(0.01) - low > fifth) low = at(0.01);
    if (high - at(0.99) > fifth) high = at(0.99);
  }
  return [low, high];
}
