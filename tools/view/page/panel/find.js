// SPDX-License-Identifier: GPL-3.0-or-later
/** The field that finds a cell by its index or by a place. */
import { unitVector } from "../data/vector.js";
import { count } from "../data/format.js";
import { byId } from "./dom.js";

/** ms that an answer stays. */
const answerTime = 6000;

/** A direction or a degree sign after a number, as in 12.34° W. */
const direction = /^(.*?)°?([NSEW]?)$/i;

/** Numbers of a text, also as the page prints them; NaN where there is something else. Of two numbers with
 *  directions the one of north or south is the second. */
export function numbersOf(text) {
  const plain = text.replace(/\u202f/g, "").replace(/\u2212/g, "-").replace(/\s*°\s*|\s+(?=[NSEW]\b)/gi, "");
  const words = plain.split(/[\s,;]+/).filter(Boolean).map((word) => {
    const [, digits, side] = direction.exec(word);
    return { number: digits ? Number(digits) * (/[SW]/i.test(side) ? -1 : 1) : NaN, side };
  });
  const has = (word, sides) => word !== undefined && sides.test(word.side);
  const [first, second] = words;
  const swapped = has(first, /[NS]/i) || has(second, /[EW]/i);
  const contrary = words.length === 1 ? first.side !== ""
    : swapped ? has(first, /[EW]/i) || has(second, /[NS]/i) : false;
  const numbers = words.map((word) => (contrary ? NaN : word.number));
  return swapped ? numbers.reverse() : numbers;
}

export class Find {
  constructor(app, stage, selection) {
    Object.assign(this, { app, stage, selection });
    byId("find-form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.find(byId("find").value);
    });
    for (const end of ["input", "blur"]) byId("find").addEventListener(end, () => this.answer(""));
    const place = app.shown[0].plane ? "x, y" : "lon, lat";
    byId("find").placeholder = `${place} or cell`;
    byId("find").setAttribute("aria-label", `Find a cell by ${place} or by its index`);
  }

  find(text) {
    const numbers = numbersOf(text);
    if (!numbers.length || numbers.length > 2 || numbers.some((v) => !Number.isFinite(v))) {
      this.answer("Enter two numbers or one cell index.");
    } else if (numbers.length === 1) {
      this.goToCell(numbers[0]);
    } else {
      this.goToPlace(numbers);
    }
  }

  goToCell(index) {
    const mesh = this.app.shown[0];
    const cell = mesh.cellOf(index);
    if (cell >= 0) {
      this.answer("");
      this.selection.goTo(0, cell);
      return;
    }
    this.answer(mesh.number
      ? `The page does not hold cell ${count(index)}.`
      : `Cells are numbered from 0 to ${count(mesh.cells - 1)}.`);
  }

  goToPlace([a, b]) {
    const mesh = this.app.shown[0];
    if (!mesh.plane && Math.abs(b) > 90) {
      this.answer("Latitudes are from −90 to 90.");
      return;
    }
    const place = mesh.plane ? mesh.fromFile([a, b]) : unitVector(a, b);
    const cell = this.selection.near(0, place);
    this.answer(cell < 0 ? "The page shows no cell." : "");
    if (cell >= 0) this.selection.goTo(0, cell);
  }

  answer(text) {
    byId("find-answer").textContent = text;
    clearTimeout(this.timer);
    if (text) this.timer = setTimeout(() => this.answer(""), answerTime);
  }
}
