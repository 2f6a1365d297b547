// SPDX-License-Identifier: GPL-3.0-or-later
/** Printing: on white paper the light theme, whatever the page has. */
import { currentTheme, setTheme } from "../colour/theme.js";
import { byId } from "./dom.js";

/** @param canvas the drawing's, or null. @param retheme redraws in the present theme, at once. */
export function preparePrinting(canvas, retheme) {
  let before = null;
  addEventListener("beforeprint", () => {
    before ??= currentTheme();
    setTheme("light");
    retheme();
    if (canvas) copyPicture(canvas, byId("printed"));
  });
  addEventListener("afterprint", () => {
    if (before) setTheme(before);
    before = null;
    retheme();
  });
}

/** A print shows the last frame that the screen had; the copy has the one just drawn. */
function copyPicture(from, to) {
  [to.width, to.height] = [from.width, from.height];
  to.getContext("2d").drawImage(from, 0, 0);
}
