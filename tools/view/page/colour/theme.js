// SPDX-License-Identifier: GPL-3.0-or-later
/** The light and the dark theme: CSS variables, which the drawing reads too. */
import { hex } from "./palettes.js";

const names = ["background", "globe", "missing", "plain", "edge", "coast", "accent", "rim"];

/** Colours of the present theme for the drawing. */
export function drawingTheme() {
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => hex(style.getPropertyValue(`--draw-${name}`).trim().replace("#", ""));
  return Object.fromEntries(names.map((name) => [name, colour(name)]));
}

const prefersDark = matchMedia("(prefers-color-scheme: dark)");

const preferredTheme = () => (prefersDark.matches ? "dark" : "light");
setTheme(preferredTheme());

/** "light" or "dark". */
export function currentTheme() {
  return document.documentElement.dataset.theme;
}

export function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
}

/** Follows the system's preference, and calls back when it changes. */
export function onPreferredTheme(changed) {
  prefersDark.addEventListener("change", () => {
    setTheme(preferredTheme());
    changed();
  });
}
