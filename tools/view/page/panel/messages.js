// SPDX-License-Identifier: GPL-3.0-or-later
/** Messages of errors, in the place of the picture. */
import { byId, element } from "./dom.js";

/** All messages shown, for tests. */
export const messages = [];

export function showMessage(text) {
  if (messages.includes(text)) return;
  messages.push(text);
  const box = byId("messages");
  box.hidden = false;
  box.append(element("p", {}, text));
}
