// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * A function that runs `work` (asynchronous) once at a time. Calls during a run make one more run after it.
 */
export function oneAtATime(work) {
  let busy = false;
  let again = false;
  return async () => {
    if (busy) {
      again = true;
      return;
    }
    busy = true;
    do {
      again = false;
      await work();
    } while (again);
    busy = false;
  };
}
