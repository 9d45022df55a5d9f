/** The features of a volume as a tree, ordered so that all descendants directly follow their ancestor. */

import type { Feature } from "../engine";

export interface FeatureIndex {
  /** In tree order: the subtree of i is [i, end[i]). */
  features: Feature[];
  end: Int32Array;
  parent: Int32Array;
  depth: Int32Array;
  /** Number of features with voxels in the subtree, including itself. */
  solids: Int32Array;
  byId: Map<string, number>;
  /** Members of storeys, flats and other groups that are not below them in the tree. */
  members: ReadonlyMap<number, readonly number[]>;
  /** Number of such groups among the features [0, i). */
  groupsBefore: Int32Array;
  /** Classes by name, with the features of each. */
  classes: Map<string, number[]>;
  /** Position of the feature that owns a scalar; see ownerOf(). */
  firstScalars: Int32Array;
  ownersByScalar: Int32Array;
}

export function indexFeatures(given: Feature[]): FeatureIndex {
  const position = new Map(given.map((feature, i) => [feature.id, i]));
  const children: number[][] = given.map(() => []);
  const roots: number[] = [];
  given.forEach((feature, i) => {
    const parent = position.get(feature.parent);
    // Children must follow their parent; others become roots, so that no cycle can arise.
    if (parent !== undefined && parent < i) children[parent]!.push(i);
    else roots.push(i);
  });
  const order: number[] = [];
  const stack = roots.slice().reverse();
  while (stack.length) {
    const i = stack.pop()!;
    order.push(i);
    const below = children[i]!;
    for (let c = below.length - 1; c >= 0; --c) stack.push(below[c]!);
  }
  return indexOrdered(
    order.map((i) => given[i]!),
    membersOf(given, order),
  );
}

/** Members by the position of their group in the order. */
function membersOf(given: Feature[], order: number[]): Map<number, number[]> {
  const members = new Map<number, number[]>();
  if (!given.some((feature) => feature.groups)) return members;
  const place = new Int32Array(given.length);
  order.forEach((i, at) => (place[i] = at));
  order.forEach((i, at) => {
    for (const group of given[i]!.groups ?? []) {
      if (group < 0 || group >= given.length) continue;
      const known = members.get(place[group]!);
      if (known) known.push(at);
      else members.set(place[group]!, [at]);
    }
  });
  return members;
}

function indexOrdered(features: Feature[], members: ReadonlyMap<number, readonly number[]>): FeatureIndex {
  const n = features.length;
  const byId = new Map(features.map((feature, i) => [feature.id, i]));
  const end = new Int32Array(n),
    parent = new Int32Array(n),
    depth = new Int32Array(n),
    solids = new Int32Array(n);
  const classes = new Map<string, number[]>();
  features.forEach((feature, i) => {
    const above = byId.get(feature.parent);
    parent[i] = above !== undefined && above < i ? above : -1;
    depth[i] = parent[i]! < 0 ? 0 : depth[parent[i]!]! + 1;
    const members = classes.get(feature.class);
    if (members) members.push(i);
    else classes.set(feature.class, [i]);
  });
  for (let i = n - 1; i >= 0; --i) {
    end[i] = Math.max(end[i]!, i + 1);
    solids[i]! += features[i]!.count > 0 ? 1 : 0;
    const above = parent[i]!;
    if (above < 0) continue;
    end[above] = Math.max(end[above]!, end[i]!);
    solids[above]! += solids[i]!;
  }
  const groupsBefore = new Int32Array(n + 1);
  for (let i = 0; i < n; ++i) groupsBefore[i + 1] = groupsBefore[i]! + (members.has(i) ? 1 : 0);
  const owners = features.map((_, i) => i).filter((i) => features[i]!.count > 0);
  owners.sort((a, b) => features[a]!.first - features[b]!.first);
  return {
    features,
    end,
    parent,
    depth,
    solids,
    byId,
    members,
    groupsBefore,
    classes,
    firstScalars: Int32Array.from(owners, (i) => features[i]!.first),
    ownersByScalar: Int32Array.from(owners),
  };
}

/** Whether a feature stands for its members or for all below it, as a flat, a storey or a building does. */
export function isGroupOfParts(index: FeatureIndex, i: number): boolean {
  return index.members.has(i) || (index.features[i]!.count === 0 && index.end[i]! > i + 1);
}

/** Whether a feature below i, or i itself, is a group with members elsewhere in the tree. */
export function hasGroups(index: FeatureIndex, i: number): boolean {
  return index.groupsBefore[index.end[i]!]! > index.groupsBefore[i]!;
}

/**
 * The features with all below them and all members of groups among them, as the query `under` selects them; each once.
 * Cost: O(features of the result), and one byte per feature of the model.
 */
export function withMembers(index: FeatureIndex, starts: Iterable<number>): number[] {
  const isFound = new Uint8Array(index.features.length);
  const found: number[] = [];
  const open = [...starts];
  while (open.length) {
    const start = open.pop()!;
    for (let at = start; at < index.end[start]!;) {
      // The search has found this feature before, with all below it.
      if (isFound[at]) {
        at = index.end[at]!;
        continue;
      }
      isFound[at] = 1;
      found.push(at);
      for (const member of index.members.get(at) ?? []) open.push(member);
      ++at;
    }
  }
  return found.sort((a, b) => a - b);
}

/** The feature of a scalar; -1: background, or none. */
export function ownerOf(index: FeatureIndex, scalar: number): number {
  let low = 0,
    high = index.firstScalars.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (index.firstScalars[middle]! <= scalar) low = middle + 1;
    else high = middle;
  }
  if (low === 0) return -1;
  const owner = index.ownersByScalar[low - 1]!;
  const feature = index.features[owner]!;
  return scalar < feature.first + feature.count ? owner : -1;
}

/** Display name. */
export function labelOf(feature: { name: string; id: string }): string {
  return feature.name || feature.id;
}

export function ancestors(index: FeatureIndex, i: number): number[] {
  const above: number[] = [];
  for (let at = index.parent[i]!; at >= 0; at = index.parent[at]!) above.push(at);
  return above;
}
