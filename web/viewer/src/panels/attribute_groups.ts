/** Attributes in groups: own attributes, materials, classification, quantities, and each property set of an IFC file. */

import type { FeatureProperties } from "../engine";
import { volumeOf } from "./comparison";

export type GroupKind = "general" | "material" | "classification" | "quantities" | "set";

export interface AttributeRow {
  /** The complete name of the attribute, as in queries. */
  name: string;
  /** The name without its set. */
  label: string;
  value: string;
}

export interface AttributeGroup {
  kind: GroupKind;
  /** Name of the set; empty: a group of another kind, or quantities of several sets. */
  set: string;
  rows: AttributeRow[];
}

const kKinds: readonly GroupKind[] = ["general", "material", "classification", "quantities", "set"];
const kQuantities = /^Qto_|Quantit/i;

/** An attribute of a property set is named by its set, a dot and its own name. */
function partsOf(name: string): { set: string; label: string } {
  const dot = name.indexOf(".");
  return dot > 0 && dot < name.length - 1 ? { set: name.slice(0, dot), label: name.slice(dot + 1) } : { set: "", label: name };
}

function kindOf(set: string, label: string): GroupKind {
  if (set) return kQuantities.test(set) ? "quantities" : "set";
  if (/^material/i.test(label)) return "material";
  return /^classification/i.test(label) ? "classification" : "general";
}

/** The groups in the order of `kKinds`; sets and attributes in the order of the model. */
export function groupsOf(attributes: Readonly<Record<string, string>>): AttributeGroup[] {
  const groups = new Map<string, AttributeGroup>();
  for (const [name, value] of Object.entries(attributes)) {
    const { set, label } = partsOf(name);
    const kind = kindOf(set, label);
    const key = kind === "set" ? `set ${set}` : kind;
    const group = groups.get(key) ?? { kind, set, rows: [] };
    // Quantities of several sets keep the complete names.
    if (group.set !== set) {
      for (const row of group.rows) row.label = row.name;
      group.set = "";
    }
    group.rows.push({ name, label: group.set === set ? label : name, value });
    groups.set(key, group);
  }
  return [...groups.values()].sort((a, b) => kKinds.indexOf(a.kind) - kKinds.indexOf(b.kind));
}

/** The rows whose name or value contains all words; groups without such rows are left out. */
export function filtered(groups: readonly AttributeGroup[], search: string): AttributeGroup[] {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  if (!words.length) return [...groups];
  return groups.flatMap((group) => {
    const rows = group.rows.filter(({ name, value }) => {
      const text = `${name} ${value}`.toLowerCase();
      return words.every((word) => text.includes(word));
    });
    return rows.length ? [{ ...group, rows }] : [];
  });
}

export interface Measured {
  value: number;
  unit: string;
}

/** With its parts: quantities of a door include its frame. */
function surfaceOf({ totalSurface, surface }: FeatureProperties): Measured | null {
  const value = totalSurface || surface;
  return value > 0 ? { value, unit: "m²" } : null;
}

/**
 * The measured value that means the same as a quantity of the model; null: nothing comparable is measured. Gross quantities,
 * which ignore openings, are not measured.
 */
export function measuredFor(label: string, p: FeatureProperties): Measured | null {
  const name = label.slice(label.lastIndexOf(".") + 1);
  if (/^(Net)?Volume$/i.test(name)) {
    const value = volumeOf(p);
    return value === null ? null : { value, unit: "m³" };
  }
  if (/^(TotalSurfaceArea|OuterSurfaceArea|SurfaceArea)$/i.test(name)) return surfaceOf(p);
  if (/^(Overall)?Height$/i.test(name)) {
    const value = p.box.high[2] - p.box.low[2];
    return Number.isFinite(value) && value > 0 ? { value, unit: "m" } : null;
  }
  return null;
}
