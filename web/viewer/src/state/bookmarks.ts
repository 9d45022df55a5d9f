/** Saved views, in the browser's local storage; each model has its own list. */

import { restored } from "./link";
import type { ViewState } from "./view_state";

export interface Bookmark {
  name: string;
  state: ViewState;
}

const keyOf = (model: string) => `svt-bookmarks:${model}`;

export function loadBookmarks(model: string, store: Storage = localStorage): Bookmark[] {
  try {
    const value: unknown = JSON.parse(store.getItem(keyOf(model)) ?? "[]");
    if (!Array.isArray(value)) return [];
    return value
      .filter((item): item is { name: string; state: unknown } => typeof item?.name === "string")
      .map(({ name, state }) => ({ name, state: restored(state) }));
  } catch {
    return [];
  }
}

/** False if the browser stores nothing. */
export function saveBookmarks(model: string, bookmarks: Bookmark[], store: Storage = localStorage): boolean {
  try {
    store.setItem(keyOf(model), JSON.stringify(bookmarks));
    return true;
  } catch {
    return false;
  }
}
