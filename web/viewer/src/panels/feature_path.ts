/** The place of a feature in its building: building, storey, flat, room. A feature may lie in a storey or flat as a member only. */

import type { Feature } from "../engine";
import { classText } from "../state/class_words";
import { ancestors, labelOf, type FeatureIndex } from "../state/feature_index";
import type { IconName } from "../ui/icons";

/** Kinds of features by class or IFC type; the first that fits. */
const kKinds: readonly (readonly [pattern: RegExp, icon: IconName])[] = [
  [/Stor(e)?y/, "storey"],
  [/BuildingUnit|Unit$/, "unit"],
  [/Room|Space$|Zone/, "room"],
  [/Window/, "window"],
  [/Door/, "door"],
  [/Roof/, "roof"],
  [/Stair|Ramp/, "stair"],
  [/Wall/, "wall"],
  [/Slab|Floor|Ceiling|Plate/, "slab"],
  [/Beam|Column|Member/, "beam"],
  [/Furni/, "furniture"],
  [/Installation|Flow|Distribution|Terminal/, "pipe"],
  [/Building|Bridge|Tunnel|Construction$/, "building"],
];
const kPlaces: readonly IconName[] = ["building", "storey", "unit", "room"];

const kKnown = new Map<string, IconName>();

/** The icon of a class and type; `part` where none fits. */
export function kindOf({ class: name, type = "" }: Pick<Feature, "class" | "type">): IconName {
  const key = `${name} ${type}`;
  let kind = kKnown.get(key);
  if (!kind) {
    const found = (text: string) => kKinds.find(([pattern]) => pattern.test(text))?.[1];
    // BuildingConstructiveElement says nothing about the kind; its type does.
    kind = (type && found(type)) || (/Element|GenericOccupied/.test(name) ? undefined : found(name)) || "part";
    kKnown.set(key, kind);
  }
  return kind;
}

export const isStorey = (feature: Feature): boolean => kindOf(feature) === "storey";

const kGroups = new WeakMap<FeatureIndex, Map<number, number[]>>();

/** Groups by member. */
function groupsByMember(index: FeatureIndex): Map<number, number[]> {
  let groups = kGroups.get(index);
  if (!groups) {
    groups = new Map();
    for (const [group, members] of index.members) for (const member of members) groups.set(member, [...(groups.get(member) ?? []), group]);
    kGroups.set(index, groups);
  }
  return groups;
}

/** The features around a feature, outermost first: its ancestors, and the storeys and flats that have it as a member. */
export function pathTo(index: FeatureIndex, i: number): number[] {
  const above = ancestors(index, i).reverse();
  const groups = groupsByMember(index);
  const rank = (at: number) => kPlaces.indexOf(kindOf(index.features[at]!));
  for (const at of [...above, i])
    for (const group of groups.get(at) ?? []) {
      if (above.includes(group) || group === i || rank(group) < 0) continue;
      const next = above.findIndex((other) => rank(other) > rank(group));
      above.splice(next < 0 ? above.length : next, 0, group);
    }
  return above;
}

/** The storey of a feature, or the feature itself if it is one; -1: none. */
export function storeyOf(index: FeatureIndex, i: number): number {
  if (isStorey(index.features[i]!)) return i;
  return pathTo(index, i).find((at) => isStorey(index.features[at]!)) ?? -1;
}

/** A name for people: without one of its own, the class and the nearest named feature above. */
export function nameOf(index: FeatureIndex, feature: { id: string; name: string; class: string }): string {
  const i = index.byId.get(feature.id);
  if (feature.name || i === undefined) return labelOf(feature);
  const { type = "" } = index.features[i]!;
  const named = ancestors(index, i).find((at) => index.features[at]!.name);
  return named === undefined ? labelOf(feature) : `${classText(type || feature.class)} · ${index.features[named]!.name}`;
}
