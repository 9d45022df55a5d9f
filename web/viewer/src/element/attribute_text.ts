/** The texts of attributes: numbers, lists and planes. */

import type { Section } from "../state/view_state";

/** Exactly `count` numbers with commas between them; null for any other text. */
export function numbersOf(text: string, count: number): number[] | null {
  const parts = text.split(",").map((part) => part.trim());
  if (parts.length !== count || !parts.every((part) => /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(part))) return null;
  const numbers = parts.map(Number);
  return numbers.every(Number.isFinite) ? numbers : null;
}

/** The entries between semicolons, except those in quotes; without empty ones. */
export function listOf(text: string): string[] {
  const entries = text.match(/(?:"(?:[^"\\]|\\.)*"|[^;])+/g) ?? [];
  return entries.map((entry) => entry.trim()).filter((entry) => entry !== "");
}

/** Planes, each with a handle in the picture, and regions without. */
export interface Cuts {
  sections: Section[];
  regions: string[];
}

/** Planes with `or` between them, as `--section` takes each; any other text is one region, as `--cut` takes it. */
export function cutsOf(text: string): Cuts {
  const cuts: Cuts = { sections: [], regions: [] };
  if (!text) return cuts;
  for (const part of text.split(/\s+or\s+/)) {
    const plane = planeOf(part);
    if (plane) cuts.sections.push(plane);
    else if (kStorey.test(part)) cuts.regions.push(/\s/.test(part) ? `'${part}'` : part);
    else return { sections: [], regions: [text] };
  }
  return cuts;
}

/** The name of a storey may have blanks, which regions take only in quotes. */
const kStorey = /^storey=(?!.*\s(and|not)\s)[^"'()<>]+$/;

/** `z>1.2`, `z=1.2`, `y<3`, or A,B,C,D: the side of Ax + By + Cz + D > 0, in world axes. */
function planeOf(text: string): Section | null {
  const along = /^([xyz])\s*([<>=])(.*)$/.exec(text.trim());
  const at = along && numbersOf(along[3]!, 1)?.[0];
  if (along && at != null)
    return { axis: along[1] as "x" | "y" | "z", at, flip: along[2] === "<", turn: 0, tilt: along[1] === "z" ? 90 : 0 };
  const [a, b, c, d] = numbersOf(text, 4) ?? [];
  if (a === undefined || b === undefined || c === undefined || d === undefined) return null;
  const length = Math.hypot(a, b, c);
  if (!(length > 0)) return null;
  const degrees = (radians: number) => (radians * 180) / Math.PI;
  return {
    axis: "free",
    at: -d / length,
    flip: false,
    turn: degrees(Math.atan2(b, a)),
    tilt: degrees(Math.asin(Math.max(-1, Math.min(1, c / length)))),
  };
}
