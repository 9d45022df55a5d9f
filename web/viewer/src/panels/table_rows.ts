/** Columns and rows of the table of objects: values, filter, order, and CSV. */

import type { AttributeValues, Feature } from "../engine";
import type { FeatureIndex } from "../state/feature_index";
import { isStorey } from "./feature_path";

export type Cell = number | string | null;

export interface Column {
  /** Name of an attribute, or `name`, `type`, `storey`, `id` for the page's own columns. */
  key: string;
  isAttribute: boolean;
  title: string;
  /** The unit of its numbers; empty: none. */
  unit: string;
  /** By position in the index. */
  cells: readonly Cell[];
}

export interface Order {
  column: number;
  isDescending: boolean;
}

/** The storey of each feature, from its ancestors or the groups that have it as a member; -1: none. Cost: O(features). */
export function storeysOf(index: FeatureIndex): Int32Array {
  const { features, parent, end } = index;
  const storeys = new Int32Array(features.length).fill(-1);
  for (let i = 0; i < features.length; ++i) storeys[i] = isStorey(features[i]!) ? i : parent[i]! >= 0 ? storeys[parent[i]!]! : -1;
  for (const [group, members] of index.members) {
    if (!isStorey(features[group]!)) continue;
    for (const member of members) for (let i = member; i < end[member]!; ++i) if (storeys[i]! < 0) storeys[i] = group;
  }
  return storeys;
}

/** The values of an attribute by position in the index. They arrive in the order in which the library lists the features. */
export function cellsOf({ values }: AttributeValues, listed: readonly Feature[], index: FeatureIndex): Cell[] {
  const cells: Cell[] = new Array<Cell>(index.features.length).fill(null);
  listed.forEach(({ id }, n) => {
    const i = index.byId.get(id);
    if (i !== undefined) cells[i] = values[n] ?? null;
  });
  return cells;
}

/** The features of a class, or of all classes, with all words in any of the columns. */
export function rowsWith(index: FeatureIndex, columns: readonly Column[], className: string, search: string): number[] {
  const among = className ? (index.classes.get(className) ?? []) : index.features.map((_, i) => i);
  return withWords(among, columns, search);
}

/** The rows with all words in any of the columns. */
export function withWords(rows: readonly number[], columns: readonly Column[], search: string): number[] {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  if (!words.length) return rows.slice();
  return rows.filter((i) => {
    const text = columns
      .map(({ cells }) => cells[i] ?? "")
      .join("\n")
      .toLowerCase();
    return words.every((word) => text.includes(word));
  });
}

/** Numbers first, then texts, then rows without a value, in both directions. Rows that are equal keep their order. */
export function sorted(rows: readonly number[], { cells }: Column, isDescending: boolean, language: string): number[] {
  const { compare } = new Intl.Collator(language, { numeric: true });
  const kind = (cell: Cell) => (cell === null || cell === "" ? 2 : typeof cell === "number" ? 0 : 1);
  return [...rows].sort((a, b) => {
    const x = cells[a] ?? null,
      y = cells[b] ?? null;
    const byKind = kind(x) - kind(y);
    if (byKind !== 0) return byKind;
    const order = typeof x === "number" && typeof y === "number" ? x - y : compare(String(x ?? ""), String(y ?? ""));
    return isDescending ? -order : order;
  });
}

/** RFC 4180, with the unit in the header: `Height [m]`. */
export function csvOf(columns: readonly Column[], rows: readonly number[]): string {
  const field = (cell: Cell) => {
    const text = cell === null ? "" : String(cell);
    return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  const header = columns.map(({ key, unit }) => field(unit ? `${key} [${unit}]` : key));
  const lines = rows.map((i) => columns.map(({ cells }) => field(cells[i] ?? null)).join(","));
  return [header.join(","), ...lines, ""].join("\r\n");
}
