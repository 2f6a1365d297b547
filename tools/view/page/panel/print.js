// SPDX-License-Identifier: GPL-3.0-or-later
/** Printing: on white paper the light theme, whatever the page has. */
import { currentTheme, setTheme } from "../colour/theme.js";
import { element } from "./dom.js";

/** @param canvas the drawing's, or null. @param retheme redraws in the present theme, at once. */
export function preparePrinting(canvas, retheme) {
  let before; // the theme
  let picture = null;
  addEventListener("beforeprint", () => {
    if (picture) return;
    before = currentTheme();
    setTheme("light");
    retheme();
    picture = copyOf(canvas);
    canvas?.after(picture);
  });
  addEventListener("afterprint", () => {
    picture?.remove();
    picture = null;
    setTheme(before);
    retheme();
  });
}

/** A print shows the last frame that the screen had; the copy has the one just drawn. */
function copyOf(canvas) {
  const { width, height } = canvas ?? { width: 1, height: 1 };
  const copy = element("canvas", { class: "printed", width, height });
  if (canvas) copy.getContext("2d").drawImage(canvas, 0, 0);
  return copy;
}
