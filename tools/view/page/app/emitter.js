// SPDX-License-Identifier: GPL-3.0-or-later
/** Calls listeners by the name of an event. */
export class Emitter {
  constructor() {
    this.listeners = new Map();
  }

  on(names, listener) {
    for (const name of names.split(" ")) {
      if (!this.listeners.has(name)) this.listeners.set(name, []);
      this.listeners.get(name).push(listener);
    }
  }

  emit(name, detail) {
    for (const listener of this.listeners.get(name) ?? []) listener(detail);
  }
}
