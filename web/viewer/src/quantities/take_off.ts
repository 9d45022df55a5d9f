/** A take-off as the library measures it, and its columns as the page lists them. Null: unknown, or not defined. */

import type { Cell, Column } from "../panels/table_rows";
import { language, number } from "../texts";
import { columnText, trustText } from "./texts";

/** A table of the module (web/wasm/reports/quantities.cpp). */
export interface Table {
  /** Names as in the files of `svt quantities`. */
  columns: string[];
  rows: Cell[][];
}

/** The model of a take-off. */
export interface ModelReport {
  /** Metres between samples. */
  spacing: [number, number, number];
  /** The reason for a spacing that is not the usual one; empty: there is none. */
  reason: string;
  hasMeshes: boolean;
  /** Warnings and errors in the model. */
  findings: string[];
}

/** Sum of all objects; `unknown`: the number of objects without a figure, which its sum excludes. */
export interface Total {
  objects: number;
  bound: number | null;
  unknown?: Record<string, number>;
  exterior?: Record<string, number | null>;
  [figure: string]: number | null | undefined | Record<string, number | null>;
}

/** One row per object. */
export interface TakeOff extends Table {
  total: Total;
  notes: string[];
  assumptions: string[];
}

/** One row for each combination of the values of keys. */
export interface Sums extends Table {
  /** The objects of each row, as positions in the rows of the take-off. */
  members: number[][];
  unknown: Record<string, number>[];
}

/** Options of `svt quantities`. */
export interface Wish {
  /** A query; empty: all components. */
  where: string;
  /** A query; empty: no formwork. */
  formwork: string;
  exterior: boolean;
}
export const kWish: Wish = { where: "", formwork: "", exterior: false };

const kExterior = "exterior_";
const kLengths = new Set(["thickness", "length", "width", "height", "perimeter"]);
const kWhole = new Set(["objects", "openings"]);

export function unitOf(column: string): "" | "m" | "m²" | "m³" {
  if (/(Volume|ound)$/.test(column)) return "m³";
  if (column.endsWith("Area") || column.startsWith(kExterior)) return "m²";
  return kLengths.has(column) ? "m" : "";
}

/** Columns with titles in the language of the page. For objects, the name comes first and the id last. */
export function columnsOf({ columns, rows }: Table): Column[] {
  const all = columns.map((key, c): Column => {
    const cells = rows.map((row) => row[c] ?? null);
    return { key, isAttribute: false, title: columnText(key), unit: unitOf(key), cells };
  });
  if (columns[0] !== "id") return all;
  const rank = ({ key }: Column) => (key === "name" ? 0 : key === "id" ? 2 : 1);
  return all.sort((a, b) => rank(a) - rank(b));
}

/** The sum of a column; undefined: the column has no sum. */
export function totalOf(total: Total, column: string): number | null | undefined {
  if (column.startsWith(kExterior)) return total.exterior?.[column.slice(kExterior.length)];
  const value = total[column];
  if (value === null) return null;
  return typeof value === "number" ? value : undefined;
}

/** Decimals of figures. Smaller figures and bounds have two digits, so that only 0 is 0. */
const kDecimals = 3;
export function cellText(column: string, cell: Cell): string {
  if (cell === null) return "–";
  if (column === "trust") return trustText(String(cell));
  if (typeof cell === "string") return cell;
  if (kWhole.has(column)) return number(cell, 0);
  const isSmall = cell !== 0 && Math.abs(cell) < 10 ** -kDecimals;
  return isSmall || /ound$/.test(column) ? cell.toLocaleString(language(), { maximumSignificantDigits: 2 }) : number(cell, kDecimals);
}

/** Keys of sums: those of the library, and attributes that occur. */
export function keysOf(attributes: readonly string[]): string[] {
  const own = ["class", "name", "storey", "material", "color"];
  // A comma separates keys.
  return [...own, ...attributes.filter((name) => !own.includes(name.toLowerCase()) && !/[,"]/.test(name))];
}

/** A name of the file that a take-off is saved as. */
export function fileOf(model: string, what: "quantities" | "sums", ending: string): string {
  const stem = model
    .replace(/^.*\//, "")
    .replace(/(\.[A-Za-z]\w{0,9})+$/, "")
    .replace(/[^\p{L}\p{N}_-]+/gu, "_");
  return `${stem ? `${stem}_` : ""}${what}.${ending}`;
}
