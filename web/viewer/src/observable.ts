/** Observable state with signals: an effect, or the rendering of a part, runs again when a value that it read changes. */

import { batch, computed, effect, signal, untracked, type Signal } from "@preact/signals-core";

export { batch, computed, effect, signal, untracked };

/** An object whose fields are all observable, so that none can be forgotten. A getter depends on the fields that it reads. */
export abstract class Observable {
  constructor() {
    const fields = new Map<PropertyKey, Signal<unknown>>();
    return new Proxy(this, {
      get(target, key, self) {
        const field = fields.get(key);
        return field ? field.value : Reflect.get(target, key, self);
      },
      set(_, key, value) {
        const field = fields.get(key);
        if (field) field.value = value;
        else fields.set(key, signal(value));
        return true;
      },
    });
  }
}

/** The members of an object that is replaced as a whole, each observable separately. Each object must have the members of the first. */
export function membersOf<T extends object>(whole: () => T): Readonly<T> {
  const members = {} as T;
  for (const key of Object.keys(untracked(whole)) as (keyof T)[]) {
    const member = computed(() => whole()[key]);
    Object.defineProperty(members, key, { enumerable: true, get: () => member.value });
  }
  return members;
}

/** Resolves once a condition on observable values holds. */
export function until(holds: () => boolean): Promise<void> {
  return new Promise((resolve) => {
    effect(function () {
      if (!holds()) return;
      this.dispose();
      resolve();
    });
  });
}
