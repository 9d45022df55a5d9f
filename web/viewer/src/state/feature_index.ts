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
  return indexOrdered(order.map((i) => given[i]!));
}

function indexOrdered(features: Feature[]): FeatureIndex {
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
  const owners = features.map((_, i) => i).filter((i) => features[i]!.count > 0);
  owners.sort((a, b) => features[a]!.first - features[b]!.first);
  return {
    features,
    end,
    parent,
    depth,
    solids,
    byId,
    classes,
    firstScalars: Int32Array.from(owners, (i) => features[i]!.first),
    ownersByScalar: Int32Array.from(owners),
  };
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
