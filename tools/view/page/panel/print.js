// SPDX-License-Identifier: GPL-3.0-or-later
/** Printing: on white paper the light theme, whatever the page has. */
import { currentTheme, setTheme } from "../colour/theme.js";

export function preparePrinting(retheme) {
  let before = null;
  addEventListener("beforeprint", () => {
    before = currentTheme();
    setTheme("light");
    retheme();
  });
  addEventListener("afterprint", () => {
    if (before) setTheme(before);
    before = null;
    retheme();
  });
}
