// SPDX-License-Identifier: GPL-3.0-or-later
/** Which shapes a filter lets through. */
import { marksOnCells, marksOnTriangles } from "../data/convert.js";
import { topologyOf } from "../scene/shapes.js";

const rightAngle = 90;

export const filters = [
  { name: "all", label: "All" },
  { name: "obtuse", label: "Obtuse triangles", help: "an angle of more than 90°" },
  { name: "pairs", label: "5–7 pairs", help: "cells of degree 5 beside cells of degree 7" },
  { name: "marked", label: "Marked" },
];

/** Whether a filter can be applied to all of these meshes. */
export function filterWorks(name, meshes) {
  if (name === "obtuse") return meshes.every((m) => m.measure("angle") || m.measure("triangle_angle"));
  if (name === "pairs") return meshes.every((m) => m.measure("degree") && !m.part); // a part lacks neighbours
  return true;
}

/** By shape 1 where the filter lets it through; null: all. @param marks by shape, or null. */
export async function filterMask(mesh, filter, shapes, marks) {
  if (filter === "obtuse") return obtuse(mesh, shapes);
  if (filter === "pairs") return mesh.once(`pairs of ${shapes}`, () => pairs(mesh, shapes));
  return filter === "marked" ? marks : null;
}

/** By the angles of these shapes; where the mesh has only those of the other kind, by what they touch. */
async function obtuse(mesh, shapes) {
  const names = { triangles: "triangle_angle", cells: "angle" };
  const on = mesh.measure(names[shapes]) ? shapes : shapes === "cells" ? "triangles" : "cells";
  const values = await mesh.values(names[on]);
  if (!values) return null;
  const mask = Uint8Array.from(values, (angle) => (angle > rightAngle ? 1 : 0));
  if (on === shapes) return mask;
  const corners = await mesh.connectivity();
  if (!corners) return null;
  return shapes === "triangles" ? marksOnTriangles(mask, corners) : marksOnCells(mask, corners, mesh.cells);
}

async function pairs(mesh, shapes) {
  const [degrees, topology] = [await mesh.values("degree"), await topologyOf(mesh)];
  if (!degrees || !topology) return null;
  const mask = new Uint8Array(mesh.cells);
  for (let i = 0; i < mesh.cells; i++) {
    if (degrees[i] !== 5 && degrees[i] !== 7) continue;
    const other = 12 - degrees[i];
    if (topology.neighbours(i).some((j) => degrees[j] === other)) mask[i] = 1;
  }
  if (shapes === "cells") return mask;
  const corners = await mesh.connectivity();
  return corners && marksOnTriangles(mask, corners);
}
