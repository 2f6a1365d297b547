// SPDX-License-Identifier: GPL-3.0-or-later
/** How finely a frame is drawn: coarser while moving, by the time that frames take. */

/** ms after the last movement at which the picture is refined. */
const restAfter = 220;

/** ms of a frame above which the next is coarser, and below which it is finer. */
const slow = 80;
const fast = 40;

const finest = 1;
const coarsest = 3;

export class Pace {
  constructor() {
    this.coarseness = finest;
    this.lastMove = -Infinity;
    this.lastFrame = 0;
  }

  get restRule() {
    return { pointsBelow: 2, pointSpacing: 1, budget: 60 };
  }

  /** Everything that is in the window, however long it takes. */
  get wholeRule() {
    return { ...this.restRule, budget: Infinity };
  }

  get movingRule() {
    const q = this.coarseness;
    return { pointsBelow: 3 * q, pointSpacing: 1.6 * q, budget: 8 };
  }

  moved() {
    this.lastMove = performance.now();
  }

  /** Whether the frame at this time is one of a movement; adapts to the time since the last one. */
  frame(now) {
    const moving = now - this.lastMove < restAfter;
    const interval = now - this.lastFrame;
    this.lastFrame = now;
    if (moving && interval < 1000) this.adapt(interval);
    return moving;
  }

  adapt(interval) {
    if (interval > slow) this.coarseness = Math.min(coarsest, this.coarseness * 1.15);
    else if (interval < fast) this.coarseness = Math.max(finest, this.coarseness / 1.05);
  }
}
