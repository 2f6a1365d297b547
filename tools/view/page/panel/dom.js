// SPDX-License-Identifier: GPL-3.0-or-later
/** Elements of the page. Text is only ever set as text. */

const svgSpace = "http://www.w3.org/2000/svg";

/** An element with attributes (functions are listeners) and children (text or elements). */
export function element(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

export function svg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(svgSpace, tag), attributes, children);
}

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") node.addEventListener(name, value);
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value != null) node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child != null));
  return node;
}

export const byId = (id) => document.getElementById(id);

/** Shows or hides a section. */
export function show(node, visible) {
  node.hidden = !visible;
}

/** Tells screen readers. */
export function announce(text) {
  byId("announcements").textContent = text;
}
