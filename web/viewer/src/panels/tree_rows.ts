/** Expanded or matching rows of the tree: indices into the feature index, in tree order. */

import { classWords } from "../state/class_words";
import { language } from "../texts";
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
  const shown: number[] = [];
  for (let i = 0; i < index.features.length; i = open.has(i) ? i + 1 : index.end[i]!) shown.push(i);
  return { shown, matches: null, isOpen: (i) => open.has(i) };
}

const kKnown = new Map<string, string>();

/** Class, type, and words for both; most features share them. */
function wordsOf({ class: name, type = "" }: { class: string; type?: string }): string {
  const key = `${language()} ${name} ${type}`;
  let words = kKnown.get(key);
  if (words === undefined) kKnown.set(key, (words = `${name} ${type} ${classWords(name, type)}`));
  return words;
}

/** Features whose name, class, type (also as words of a language) or id contains all the words, with their ancestors. */
function found(index: FeatureIndex, words: string[], also: ReadonlySet<number>): Rows {
  const kept = new Set<number>();
  let matches = 0;
  index.features.forEach((feature, i) => {
    const text = `${labelOf(feature)} ${wordsOf(feature)} ${feature.id}`.toLowerCase();
    if (!also.has(i) && !words.every((word) => text.includes(word))) return;
    ++matches;
    kept.add(i);
    for (const above of ancestors(index, i)) kept.add(above);
  });
  return { shown: [...kept].sort((a, b) => a - b), matches, isOpen: () => true };
}
