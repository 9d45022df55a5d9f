/** A comparison of two states, as the library reports it. */

export const kChanges = ["removed", "added", "reassigned", "merged", "split", "changed", "moved", "same"] as const;
export type Change = (typeof kChanges)[number];

/** A row of `svt diff --json`, see docs/user/json.md. Null: unknown. */
export interface Row {
  change: Change;
  old: string[];
  new: string[];
  class: string;
  name: string;
  storey: string | null;
  /** False: a storey or group, which has only names and attributes. */
  geometry: boolean;
  vector: [number, number, number] | null;
  /** m3. */
  added: number | null;
  removed: number | null;
  /** Metres. */
  distance: number | null;
  exact: boolean;
  /** m3 by which `added` and `removed` may be off. */
  bound: number | null;
  properties: Record<string, [string, string]>;
  attributes: Record<string, [unknown, unknown]>;
}

/** Sums in m3 of the objects whose volumes are known; null: unknown. */
export interface Sums {
  objects: number;
  added: number | null;
  removed: number | null;
  bound: number | null;
  withoutVolume: number;
}

export interface Summary {
  different: boolean;
  changes: Record<Change, number>;
  otherProperties: number;
  classes: (Sums & { class: string })[];
  complete: boolean;
}

/** The report of the module, beside the rows (web/wasm/reports/compare.cpp). */
export interface Report {
  /** Empty: no alignment was requested. */
  aligned: "" | "moved" | "aligned" | "notFound";
  /** Metres by which the new state was moved. */
  shift: [number, number, number];
  hasMeshes: boolean;
  overlaps: boolean;
  isReferenceSystemUnknown: boolean;
  isOnOneLattice: boolean;
  isComplete: boolean;
  /** Without rooms and buildings, which contain the others. */
  components: Sums;
  /** sRGB, `#rrggbb`, of an object with the change in the volume of the difference. */
  colors: Record<Change, string>;
  /** Warnings and errors in the models. */
  findings: string[];
}

/** Options of `svt diff`. */
export interface Wish {
  match: "both" | "space" | "id";
  properties: "all" | "names" | "none";
  /** Metres. */
  tolerance: number;
  align: boolean;
}
export const kWish: Wish = { match: "both", properties: "all", tolerance: 0.01, align: false };

export interface Compared {
  report: Report;
  rows: Row[];
  summary: Summary;
  /** The rows that differ, with the largest change first, as positions in `rows`. */
  order: number[];
  /** The file of `svt diff -o F.json`. */
  file: Blob;
  /** The file of `svt diff -o F.svt`; null: there is none, for the reason. */
  volume: Blob | null;
  reason: string;
}
