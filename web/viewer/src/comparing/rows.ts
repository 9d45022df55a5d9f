/** Rows of a comparison as the page lists them, and the parts of the picture that belong to each. */

import type { FeatureIndex } from "../state/feature_index";
import { ofSubtree } from "../state/queries";
import { withStyle, type ViewState } from "../state/view_state";
import type { Change, Compared, Row } from "./compared";

/** Rows that differ, of these kinds and with all words, with the largest change first. @param kinds  empty: all */
export function rowsWith({ rows, order }: Pick<Compared, "rows" | "order">, kinds: ReadonlySet<Change>, search: string): Row[] {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  return order
    .map((n) => rows[n]!)
    .filter((row) => {
      if (kinds.size && !kinds.has(row.change)) return false;
      if (!words.length) return true;
      const text = [row.name, row.class, row.storey ?? "", ...row.old, ...row.new, ...otherProperties(row)].join("\n").toLowerCase();
      return words.every((word) => text.includes(word));
    });
}

/** Kinds of the rows that differ, with their number; rows that differ only by properties have `same`. */
export function kindsOf({ rows, order }: Pick<Compared, "rows" | "order">): Map<Change, number> {
  const kinds = new Map<Change, number>();
  for (const n of order) kinds.set(rows[n]!.change, (kinds.get(rows[n]!.change) ?? 0) + 1);
  return kinds;
}

/** Names of the properties that differ. New ids are not a difference. */
export function otherProperties({ properties, attributes }: Row): string[] {
  return [...Object.keys(properties).filter((name) => name !== "id"), ...Object.keys(attributes)];
}

/** The name of a row; without one, its new ids or the removed ones. */
export function nameOfRow({ name, old, new: is }: Row): string {
  return name || (is.length ? is : old).join(", ");
}

/** Whether the volumes of a row could be measured. False: they are unknown, which is not 0. */
export function hasVolumes({ added, removed }: Row): boolean {
  return added !== null || removed !== null;
}

/** Ids of an object's parts in the volume of the difference: its space in both states, the added and the removed space. */
export function partsOf({ change, old, new: is }: Row, index: FeatureIndex): string[] {
  const ids = new Set([...is.flatMap((id) => [id, `${id}/added`]), ...old.flatMap((id) => [id, `${id}/removed`])]);
  return [...ids].filter((id) => {
    const i = index.byId.get(id);
    // Objects of another kind may have the same id.
    return i !== undefined && (index.features[i]!.parent === change || !index.byId.has(change));
  });
}

/** The space of one state only. */
const kOnly = { was: ["removed", "/removed"], is: ["added", "/added"] } as const;

/** A query of the features that only one state has; null: there are none. */
export function onlyIn(state: "was" | "is", index: FeatureIndex): string | null {
  const [group, suffix] = kOnly[state];
  const terms = [];
  if (index.byId.has(group)) terms.push(ofSubtree(group));
  if (index.features.some(({ id }) => id.endsWith(suffix))) terms.push(`id~"${suffix}$"`);
  return terms.length ? terms.join(" or ") : null;
}

type Styles = ViewState["styles"];

/** Shows the old state (0), both (0.5), the new state (1), or a transition. */
export function withShare(styles: Styles, share: number, index: FeatureIndex): Styles {
  const opacities = { was: Math.min(1, 2 * (1 - share)), is: Math.min(1, 2 * share) };
  let all = styles;
  for (const state of ["was", "is"] as const) {
    const select = onlyIn(state, index);
    const opacity = opacities[state];
    if (select !== null) all = withStyle(all, select, { opacity: opacity < 1 ? opacity : undefined } as Partial<Styles[number]>);
  }
  return all;
}

/** The share that withShare() has set, so that undo, bookmarks and links move the slider, too. */
export function shareOf(styles: Styles, index: FeatureIndex): number {
  const opacity = (state: "was" | "is") => {
    const select = onlyIn(state, index);
    return styles.find((style) => style.select === select)?.opacity ?? 1;
  };
  const was = opacity("was"),
    is = opacity("is");
  return was < 1 ? 1 - was / 2 : is / 2;
}

/** File name of the difference of two files. */
export function fileOf(old: string, is: string): string {
  const stem = (name: string) =>
    name
      .replace(/^.*\//, "")
      .replace(/(\.[A-Za-z]\w{0,9})+$/, "")
      .replace(/[^\p{L}\p{N}_-]+/gu, "_");
  return `${stem(old)}_${stem(is)}.svt`;
}
