// SPDX-License-Identifier: GPL-3.0-or-later
/** The keyboard on the canvas. */

/** Pixels that an arrow key moves the picture by, and the factor of + and -. */
const stride = 60;
const factor = 1.4;

export function listenToKeys(canvas, navigation, selection) {
  const actions = {
    ArrowLeft: () => navigation.drag(0, stride, 0),
    ArrowRight: () => navigation.drag(0, -stride, 0),
    ArrowUp: () => navigation.drag(0, 0, stride),
    ArrowDown: () => navigation.drag(0, 0, -stride),
    "+": () => navigation.zoom(0, factor),
    "=": () => navigation.zoom(0, factor),
    "-": () => navigation.zoom(0, 1 / factor),
    0: () => navigation.reset(),
    n: () => selection.step(1),
    p: () => selection.step(-1),
    Escape: () => selection.clear(),
  };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  });
}
