/** The visible features in few words: `6,566 rooms`. */

import { labelOf, type FeatureIndex } from "../state/feature_index";
import { ownTerms } from "../state/queries";
import { featuresOf, type Answers } from "../state/visibility";
import { number, t, type TextKey } from "../texts";

const kMostCharacters = 48;
const kNouns: readonly [pattern: RegExp, noun: TextKey][] = [
  [/Room|Space$|Zone/, "shownOf_rooms"],
  [/Unit$/, "shownOf_flats"],
  [/Window/, "shownOf_windows"],
  [/Door/, "shownOf_doors"],
  [/Wall/, "shownOf_walls"],
];

/** @param queries  that select them */
export function shownText(index: FeatureIndex, queries: readonly string[], answers: Answers): string {
  const [only] = queries.length === 1 ? (ownTerms(queries[0]!) ?? []) : [];
  const isOne = only && only.kind !== "all" && only.kind !== "class" && ownTerms(queries[0]!)!.length === 1;
  const feature = isOne ? index.features[index.byId.get(only.value) ?? -1] : undefined;
  if (feature) return labelOf(feature);
  const isKnown = queries.every((query) => ownTerms(query) || answers(query));
  if (!isKnown) return shortened(queries.join(", "));
  const members = featuresOf(index, queries, answers).filter((i) => index.features[i]!.count > 0);
  const name = members.length ? index.features[members[0]!]!.class : "";
  const isAlike = members.every((i) => index.features[i]!.class === name);
  const noun = (isAlike && kNouns.find(([pattern]) => pattern.test(name))?.[1]) || "shownOf_parts";
  return t(noun, { n: number(members.length, 0) });
}

function shortened(text: string): string {
  return text.length > kMostCharacters ? `${text.slice(0, kMostCharacters - 1)}…` : text;
}
