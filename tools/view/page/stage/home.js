// SPDX-License-Identifier: GPL-3.0-or-later
/** Where a camera begins. */
import { degrees, dot, normalise, radian, unitVector } from "../data/vector.js";

/** Sites that are looked at for the home of a mesh. */
const sampleSize = 20000;

/** Meshes whose sites have a shorter mean vector surround the sphere evenly. */
const shortMean = 0.1;

const everywhere = { lon: 0, lat: 20, zoom: 1 };

/**
 * The longitude, latitude and zoom at which a mesh of the sphere is seen well: over the place that its
 * header names; or over the middle of its sites, so over the finest part of a mesh of the whole sphere.
 * Close to a small area.
 */
export function homeOf(mesh) {
  const { home } = mesh.header;
  const stride = Math.max(1, Math.floor(mesh.cells / sampleSize));
  const mean = [0, 0, 0];
  const sites = [];
  for (let i = 0; i < mesh.cells; i += stride) {
    sites.push(mesh.site(i));
    for (let k = 0; k < 3; k++) mean[k] += sites[sites.length - 1][k];
  }
  if (!home && Math.hypot(...mean) < shortMean * sites.length) return everywhere;
  const middle = home ? unitVector(home.lon, home.lat) : normalise(mean);
  const least = sites.reduce((cosine, site) => Math.min(cosine, dot(site, middle)), 1);
  const angle = Math.min(Math.PI / 2, Math.acos(least) + 0.2 * radian);
  return { ...degrees(middle), zoom: 0.95 / Math.sin(angle) > 1.1 ? 0.95 / Math.sin(angle) : 1 };
}
