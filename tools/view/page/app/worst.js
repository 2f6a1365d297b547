// SPDX-License-Identifier: GPL-3.0-or-later
/** The shapes with the worst values of a measure. */

/** How bad a value is; greater is worse. NaN has no place. */
function badness(measure) {
  const reference = measure.reference ?? 1;
  switch (measure.worst) {
    case "low":
      return (v) => -v;
    case "both":
      if (measure.name === "degree") return (v) => Math.abs(v - (measure.reference ?? 6));
      return (v) => Math.abs(Math.log(v / reference));
    default:
      return (v) => v;
  }
}

/** Words for the list. */
export function worstTitle(measure) {
  const { label, worst, on } = measure;
  if (worst === "low") return `Worst ten ${on}: least ${label}`;
  if (worst === "high") return `Worst ten ${on}: greatest ${label}`;
  if (worst === "both") return `Worst ten ${on}: ${label} farthest from ${measure.reference ?? 1}`;
  return `Ten ${on} of greatest ${label}`;
}

/** Up to `wanted` ids, worst first; of equal ones the lower id first. */
export function worstOf(measure, values, wanted = 10) {
  const bad = badness(measure);
  const found = [];
  for (let id = 0; id < values.length; id++) {
    if (!Number.isFinite(values[id])) continue;
    const b = bad(values[id]);
    if (found.length === wanted && !(b > found[wanted - 1].b)) continue;
    let at = found.length;
    while (at > 0 && found[at - 1].b < b) at--;
    found.splice(at, 0, { id, b });
    if (found.length > wanted) found.pop();
  }
  return found.map(({ id }) => id);
}
