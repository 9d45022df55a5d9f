/** Bookmarks: saved views in the browser's local storage; each model has its own list. */

import type { Scene } from "../engine";
import { restored } from "./link";
import type { ViewState } from "./view_state";

export interface Bookmark {
  name: string;
  state: ViewState;
  /** A small picture as a data URL. */
  picture?: string;
  /** The day on which it was saved, ISO 8601. */
  date?: string;
  /** As in topics of BCF. */
  comment?: string;
  author?: string;
  status?: string;
}

/** The members of a bookmark that are plain text. */
const kTexts = ["comment", "author", "status"] as const;

const keyOf = (model: string) => `svt-bookmarks:${model}`;

export function loadBookmarks(model: string, store: Storage = localStorage): Bookmark[] {
  try {
    return bookmarksOf(JSON.parse(store.getItem(keyOf(model)) ?? "[]"));
  } catch {
    return [];
  }
}

/** The valid bookmarks of a list from outside. */
function bookmarksOf(value: unknown): Bookmark[] {
  if (!Array.isArray(value)) return [];
  return value
    .filter((item): item is { name: string } & Record<string, unknown> => typeof item?.name === "string")
    .map(({ name, state, picture, date, ...others }) => ({
      name,
      state: restored(state),
      ...(typeof picture === "string" && kPicture.test(picture) ? { picture } : {}),
      ...(typeof date === "string" && /^\d{4}-\d\d-\d\d$/.test(date) ? { date } : {}),
      ...Object.fromEntries(kTexts.flatMap((key) => (typeof others[key] === "string" && others[key] ? [[key, others[key]]] : []))),
    }));
}

const kPicture = /^data:image\/(jpeg|png|webp);base64,[A-Za-z0-9+/=]+$/;

/** Bookmarks as a file, for other browsers and people. */
export function bookmarkFile(model: string, views: Bookmark[]): string {
  return `${JSON.stringify({ format: "svt-views", version: 1, model, views }, null, 1)}\n`;
}

/** The bookmarks of such a file; null for other files. */
export function bookmarksOfFile(text: string): Bookmark[] | null {
  try {
    const file = JSON.parse(text) as { format?: unknown; views?: unknown };
    return file.format === "svt-views" ? bookmarksOf(file.views) : null;
  } catch {
    return null;
  }
}

/** The list with its n-th bookmark one place earlier. */
export function movedUp(views: Bookmark[], n: number): Bookmark[] {
  if (n < 1 || n >= views.length) return views;
  const moved = [...views];
  [moved[n - 1], moved[n]] = [moved[n]!, moved[n - 1]!];
  return moved;
}

/** False if the browser does not store data. */
export function saveBookmarks(model: string, bookmarks: Bookmark[], store: Storage = localStorage): boolean {
  try {
    store.setItem(keyOf(model), JSON.stringify(bookmarks));
    return true;
  } catch {
    return false;
  }
}

/** Points on one line, everything else in the usual layout. */
export const pretty = (scene: Scene) =>
  `${JSON.stringify(scene, null, 2).replace(/\[\s+([-\d.,\se]+?)\s+\]/g, (_, n: string) => `[${n.replace(/\s+/g, " ")}]`)}\n`;

/** States of a topic of BCF. */
export const kStatuses = ["Open", "In Progress", "Closed"] as const;

/** Pixels of the small picture of a bookmark. */
export const kSmallPicture: [number, number] = [112, 70];

/** A PNG as a data URL. */
export function dataUrl(png: Uint8Array): string {
  let text = "";
  for (const byte of png) text += String.fromCharCode(byte);
  return `data:image/png;base64,${btoa(text)}`;
}
