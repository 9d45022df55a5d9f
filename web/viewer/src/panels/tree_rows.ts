/** Expanded or matching rows of the tree: indices into the feature index, in tree order. */

import { classWords } from "../state/class_words";
import { isStorey } from "./feature_path";
import { ancestors, labelOf, type FeatureIndex } from "../state/feature_index";

export interface Rows {
  /** Indices of features, top to bottom. */
  shown: number[];
  /** Number of matches; null: no search. */
  matches: number | null;
  isOpen(i: number): boolean;
}

/** Expands the top levels until there are rows to see, up to the number that fits. */
export function firstOpen(index: FeatureIndex, atMost = 60): Set<number> {
  const open = new Set<number>();
  let rows = index.parent.reduce((n, parent) => n + (parent < 0 ? 1 : 0), 0);
  for (let i = 0; i < index.features.length; ++i) {
    if (index.parent[i]! >= 0 && !open.has(index.parent[i]!)) continue;
    const children = childCount(index, i);
    if (!children || (rows + children > atMost && index.parent[i]! >= 0)) continue;
    open.add(i);
    rows += children;
  }
  return open;
}

export function childCount(index: FeatureIndex, i: number): number {
  let n = 0;
  for (let at = i + 1; at < index.end[i]!; at = index.end[at]!) ++n;
  return n;
}

/** @param also  features that a search finds by their attributes, which are not in the index */
export function rowsOf(index: FeatureIndex, open: ReadonlySet<number>, search: string, also: ReadonlySet<number> = new Set()): Rows {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  if (words.length) return found(index, words, also);
  return { shown: inOrder(index, (i) => open.has(i)), matches: null, isOpen: (i) => open.has(i) };
}

/** Features of a level: storeys first, all others in the order of the model. */
function storeysFirst(index: FeatureIndex, from: number, to: number): number[] {
  const storeys: number[] = [],
    others: number[] = [];
  for (let i = from; i < to; i = index.end[i]!) (isStorey(index.features[i]!) ? storeys : others).push(i);
  return storeys.length ? [...storeys, ...others] : others;
}

/** Expanded features from top to bottom. @param isKept  features that are listed; absent: all */
function inOrder(index: FeatureIndex, isOpen: (i: number) => boolean, isKept: (i: number) => boolean = () => true): number[] {
  const shown: number[] = [];
  const waiting = storeysFirst(index, 0, index.features.length).reverse();
  while (waiting.length) {
    const i = waiting.pop()!;
    if (!isKept(i)) continue;
    shown.push(i);
    if (!isOpen(i) || index.end[i]! === i + 1) continue;
    const below = storeysFirst(index, i + 1, index.end[i]!);
    for (let n = below.length - 1; n >= 0; --n) waiting.push(below[n]!);
  }
  return shown;
}

/** Class, type, and words for both; most features share them. @param known  of the present search */
function wordsOf({ class: name, type = "" }: { class: string; type?: string }, known: Map<string, string>): string {
  const key = `${name} ${type}`;
  let words = known.get(key);
  if (words === undefined) known.set(key, (words = `${key} ${classWords(name, type)}`));
  return words;
}

/** Features whose name, class, type (also as words of a language) or id contains all the words, with their ancestors. */
function found(index: FeatureIndex, words: string[], also: ReadonlySet<number>): Rows {
  const kept = new Set<number>();
  const known = new Map<string, string>();
  let matches = 0;
  index.features.forEach((feature, i) => {
    const text = `${labelOf(feature)} ${wordsOf(feature, known)} ${feature.id}`.toLowerCase();
    if (!also.has(i) && !words.every((word) => text.includes(word))) return;
    ++matches;
    kept.add(i);
    for (const above of ancestors(index, i)) kept.add(above);
  });
  const isKept = (i: number) => kept.has(i);
  return { shown: inOrder(index, isKept, isKept), matches, isOpen: () => true };
}
