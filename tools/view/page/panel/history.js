// SPDX-License-Identifier: GPL-3.0-or-later
/** The history of a run: its series by iteration, and a slider over its saved states. */
import { announce, byId, show, svg } from "./dom.js";
import { axisBelow, axisLeft, plainRange, ticks } from "./axis.js";
import { count } from "../data/format.js";

const width = 308;
const left = 46;
const inner = width - left - 14;
const top = 18;
const tall = 74;

export class History {
  constructor(app) {
    this.app = app;
    const { history } = app.header;
    show(byId("history-section"), Boolean(history));
    if (!history) return;
    this.history = history;
    this.slider = byId("state");
    show(byId("states"), history.states.length > 0);
    this.slider.max = history.states.length;
    this.slider.addEventListener("input", () => this.choose(Number(this.slider.value)));
    app.on("meshes", () => this.showState());
    this.render();
  }

  render() {
    const { series, states } = this.history;
    const xs = [...series.flatMap((s) => s.x), ...states.map((s) => s.iteration)];
    this.x = plainRange(xs.reduce((a, b) => Math.min(a, b), 0), xs.reduce((a, b) => Math.max(a, b), 1), false);
    byId("series").replaceChildren(...series.map((s, k) => this.chart(s, k === series.length - 1)));
    this.showState();
  }

  chart(series, last) {
    const points = series.x.map((x, k) => [x, series.y[k]])
      .filter(([, y]) => Number.isFinite(y) && (!series.logarithmic || y > 0));
    const height = top + tall + (last ? 34 : 20);
    const caption = svg("text", { class: "title", x: left, y: 11 }, series.label);
    if (!points.length) {
      return svg("svg", { viewBox: `0 0 ${width} 20`, class: "chart" }, caption);
    }
    const ys = points.map(([, y]) => y);
    const y = this.yRange(Math.min(...ys), Math.max(...ys), series.logarithmic);
    const path = points.map(([px, py], k) =>
      `${k ? "L" : "M"}${left + this.x.position(px) * inner},${top + tall * (1 - y.position(py))}`);
    return svg("svg", {
      viewBox: `0 0 ${width} ${height}`, class: "chart", role: "img",
      "aria-label": `${series.label} by iteration, from ${ys[0]} to ${ys[ys.length - 1]}`,
    }, caption,
      svg("rect", { class: "frame", x: left, y: top, width: inner, height: tall }),
      svg("path", { class: "series", d: path.join("") }),
      svg("line", { class: "cursor", y1: top, y2: top + tall }),
      ...axisBelow(ticks(this.x, inner), left, top + tall, inner),
      ...axisLeft(ticks(y, tall, 18), left, top + tall),
      last ? svg("text", { class: "title", x: left + inner / 2, y: height - 4, "text-anchor": "middle" },
        "iteration") : "");
  }

  yRange(low, high, logarithmic) {
    if (high > low) return plainRange(low, high, logarithmic);
    const margin = Math.abs(low) * 0.05 || 1;
    return plainRange(low - margin, high + margin, false);
  }

  async choose(k) {
    await this.app.showState(k);
    announce(this.stateText());
  }

  stateText() {
    const state = this.history.states[this.app.state];
    return state ? `iteration ${count(state.iteration)}` : "result";
  }

  showState() {
    const state = this.history.states[this.app.state];
    this.slider.value = this.app.state;
    this.slider.setAttribute("aria-valuetext", this.stateText());
    byId("state-text").textContent = this.stateText();
    const at = left + this.x.position(state?.iteration ?? this.x.high) * inner;
    for (const line of document.querySelectorAll("#series .cursor")) {
      line.setAttribute("x1", at);
      line.setAttribute("x2", at);
    }
  }
}
