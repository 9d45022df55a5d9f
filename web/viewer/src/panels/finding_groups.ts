/** Findings of the library by code, with the features that they name. */

import type { FeatureIndex } from "../state/feature_index";

export interface Finding {
  text: string;
  /** The feature that the finding names; null: none, or not in this model. */
  id: string | null;
}

export interface FindingGroup {
  severity: string;
  /** `E110 DanglingReference`; empty: a text without a code. */
  code: string;
  findings: Finding[];
}

const kHead = /^(note|warning|error) (E\d{3} \w+): /;

/** The first id of the model in a text: quoted, or a word of its own. */
export function featureIn(index: FeatureIndex, text: string): string | null {
  for (const [, quoted] of text.matchAll(/'([^']+)'/g)) if (index.byId.has(quoted!)) return quoted!;
  for (const [word] of text.matchAll(/[^\s'"(),;:]+/g)) {
    const id = word.replace(/\.$/, "");
    if (id.length > 3 && index.byId.has(id)) return id;
  }
  return null;
}

/** The groups in the order of their first findings, which is worst first. */
export function findingGroups(texts: readonly string[], index: FeatureIndex): FindingGroup[] {
  const groups = new Map<string, FindingGroup>();
  for (const text of texts) {
    const head = kHead.exec(text);
    const severity = head?.[1] ?? "",
      code = head?.[2] ?? "";
    const key = head ? `${severity} ${code}` : text;
    const group = groups.get(key) ?? { severity, code, findings: [] };
    const rest = head ? text.slice(head[0].length) : text;
    group.findings.push({ text: rest, id: featureIn(index, rest) });
    groups.set(key, group);
  }
  return [...groups.values()];
}
