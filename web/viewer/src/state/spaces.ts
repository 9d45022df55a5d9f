/**
 * Rooms and other spaces: pictures leave them out where there is anything else to see. So the page hides them at first,
 * and asks for those that the user shows.
 */

import type { ScenePass, SceneStyle } from "../engine";
import type { FeatureIndex } from "./feature_index";
import { joined, ofClass, ofId, ownTerms } from "./queries";

/** Classes of spaces with voxels; none if the model consists of spaces. */
function spaceClasses(index: FeatureIndex): string[] {
  const solids = index.features.filter(({ count }) => count > 0);
  if (solids.every((feature) => feature.isSpace || feature.class === "ClosureSurface")) return [];
  return [...new Set(solids.flatMap((feature) => (feature.isSpace ? [feature.class] : [])))];
}

/** Queries that hide the spaces of a model that was just opened. */
export function hiddenSpaces(index: FeatureIndex): string[] {
  return spaceClasses(index).map(ofClass);
}

const kSpaces = new WeakMap<FeatureIndex, readonly number[]>();

/** Spaces with voxels; none if the model consists of spaces. */
export function spacesOf(index: FeatureIndex): readonly number[] {
  let spaces = kSpaces.get(index);
  if (!spaces) {
    spaces = spaceClasses(index).flatMap((name) => index.classes.get(name)!.filter((i) => index.features[i]!.count > 0));
    kSpaces.set(index, spaces);
  }
  return spaces;
}

/** Whether a query names only classes of spaces, or spaces one by one. */
function isOfSpaces(index: FeatureIndex, classes: readonly string[], query: string): boolean {
  const terms = ownTerms(query);
  return (
    terms !== null &&
    terms.every(
      (term) =>
        (term.kind === "class" && classes.includes(term.value)) ||
        (term.kind === "id" && classes.includes(index.features[index.byId.get(term.value) ?? -1]?.class ?? "")),
    )
  );
}

/** The queries that hide more than spaces, which the library leaves out by itself. A hidden flat would hide its walls, too. */
export function withoutSpaces(queries: readonly string[], index: FeatureIndex): string[] {
  const classes = spaceClasses(index);
  return queries.filter((query) => !isOfSpaces(index, classes, query));
}

/**
 * The pass without queries that hide spaces, and with styles that ask for the spaces that are not hidden. Hidden spaces are
 * invisible where the pass shows only some features.
 * @param isAsked  other styles, or names, may ask for hidden spaces, which stay invisible
 */
export function withSpaces(pass: ScenePass, index: FeatureIndex, hidden: Uint8Array, isAsked = false): ScenePass {
  const { hide: given = [], ...others } = pass;
  const hide = withoutSpaces(given, index);
  const after: ScenePass = hide.length ? { ...others, hide } : others;
  if (pass.shell) return after;
  const asked = (pass.styles ?? []).map((style) => style.select);
  const first: SceneStyle[] = [],
    last: SceneStyle[] = [];
  for (const name of spaceClasses(index)) {
    const solids = index.classes.get(name)!.filter((i) => index.features[i]!.count > 0);
    const seen = solids.filter((i) => !hidden[i]);
    const queriesOf = (some: number[]) =>
      some.length === solids.length ? [ofClass(name)] : joined(some.map((i) => ofId(index.features[i]!.id)));
    const { opacity } = index.features[solids[0]!]!;
    if (!pass.show && seen.length && !asked.includes(ofClass(name))) first.push(...queriesOf(seen).map((select) => ({ select, opacity })));
    if ((isAsked || pass.show) && seen.length < solids.length)
      last.push(...queriesOf(solids.filter((i) => hidden[i])).map((select) => ({ select, opacity: 0 })));
  }
  const styles = [...first, ...(pass.styles ?? []), ...last];
  return styles.length ? { ...after, styles } : after;
}
