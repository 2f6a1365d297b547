// SPDX-License-Identifier: GPL-3.0-or-later
/** The colour of each drawn shape. */
import { mix } from "./palettes.js";

/** How far shapes outside a filter, and shapes that are not marked, go towards the background. */
const faintness = { full: 0, dim: 0.62, faint: 0.86 };

/** Colours of a scale as 32-bit words (alpha, blue, green, red), {full, dim, faint}. */
export function colourTables(scale, theme) {
  const tables = {};
  for (const [name, share] of Object.entries(faintness)) {
    const table = new Uint32Array(scale.size + 1);
    for (let k = 0; k <= scale.size; k++) {
      const colour = k < scale.size ? scale.rgb(k) : theme.missing;
      table[k] = word(mix(colour, theme.background, share));
    }
    tables[name] = table;
  }
  return tables;
}

function word([red, green, blue]) {
  return (0xff000000 | (Math.round(blue) << 16) | (Math.round(green) << 8) | Math.round(red)) >>> 0;
}

/**
 * The colours of the shapes of `order`, one word a slot.
 * @param values by shape, or null: all have the colour of no value.
 * @param masks {filter, marks}: by shape, 1 where it passes or is marked; null: all.
 */
export function paint(order, values, scale, tables, masks) {
  const { full, dim, faint } = tables;
  const { filter, marks } = masks;
  const colours = new Uint32Array(order.length);
  for (let slot = 0; slot < order.length; slot++) {
    const id = order[slot];
    const index = values ? scale.indexOf(values[id]) : scale.size;
    const table = filter && !filter[id] ? faint : marks && !marks[id] ? dim : full;
    colours[slot] = table[index];
  }
  return colours;
}
