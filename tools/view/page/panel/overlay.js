// SPDX-License-Identifier: GPL-3.0-or-later
/** What stands over the picture: names of the meshes, notices, buttons, the pointer's place. */
import { count, placeText } from "../data/format.js";
import { byId, element } from "./dom.js";

export class Overlay {
  constructor(app, stage, navigation) {
    Object.assign(this, { app, stage });
    stage.onHover = (at) => this.showPlace(at);
    stage.onLayout = (windows) => this.label(windows);
    app.on("meshes", () => this.label(stage.windows()));
    stage.canvas.addEventListener("pointerleave", () => this.showPlace(null));
    byId("zoom-in").addEventListener("click", () => navigation.zoom(0, 1.6));
    byId("zoom-out").addEventListener("click", () => navigation.zoom(0, 1 / 1.6));
    byId("zoom-reset").addEventListener("click", () => navigation.reset());
  }

  /** A label in the upper left corner of each view. */
  label(windows) {
    const several = windows.length > 1;
    byId("view-labels").replaceChildren(...this.app.shown.map((mesh, k) => {
      const { notice } = mesh.header;
      const label = element("div", { class: "view-label" },
        several ? element("strong", {}, mesh.name) : null,
        several ? element("span", {}, cellsText(mesh)) : null,
        notice ? noticeOf(notice) : null);
      label.style.left = `${windows[k].x}px`;
      label.style.top = `${windows[k].y}px`;
      label.style.maxWidth = `${windows[k].width - 24}px`;
      return label;
    }));
  }

  showPlace(at) {
    byId("place").textContent = at ? this.textAt(at) : "";
  }

  textAt({ x, y }) {
    const hit = this.stage.viewAt(x, y);
    if (!hit.view) return "";
    const place = hit.view.camera.unproject(hit.x, hit.y, hit.window.width, hit.window.height);
    return place ? placeText(hit.view.mesh.placeOf(place)) : "";
  }
}

/** The first sentence, and the others behind it. */
function noticeOf(notice) {
  const [first, ...others] = notice.trim().split(/(?<=[.]) /);
  if (!others.length) return element("span", { class: "notice" }, first);
  return element("details", { class: "notice" }, element("summary", {}, first), others.join(" "));
}

/** The number of cells, and of how many in the file they are a part; of a plan those of its grid. */
export function cellsText(mesh) {
  const { cells, total, planned } = mesh.header;
  if (planned) return `${count(planned)} cells`;
  return total > cells ? `${count(cells)} of ${count(total)} cells` : `${count(cells)} cells`;
}
