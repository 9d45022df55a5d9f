/**
 * Hidden features: stored as short queries, so that links stay short and apply to other volumes of the
 * model, and converted to a flag per feature for the tree.
 */

import type { FeatureIndex } from "./feature_index";
import { ofClass, ofId, ofSubtree, parseOwn } from "./queries";

/** 1 for each feature hidden by the queries. Queries not written by the page are ignored. */
export function hiddenFlags(index: FeatureIndex, queries: string[]): Uint8Array {
  const flags = new Uint8Array(index.features.length);
  for (const query of queries) {
    const own = parseOwn(query);
    if (!own) continue;
    if (own.kind === "all") return flags.fill(1);
    if (own.kind === "class") for (const i of index.classes.get(own.value) ?? []) flags[i] = 1;
    else {
      const i = index.byId.get(own.value);
      if (i !== undefined) flags.fill(1, i, own.kind === "id" ? i + 1 : index.end[i]!);
    }
  }
  return flags;
}

/** A minimal set of the page's own queries that hides all flagged features with voxels; other queries are kept. */
export function hideQueries(index: FeatureIndex, flags: Uint8Array, before: string[] = []): string[] {
  const foreign = before.filter((query) => parseOwn(query) === null);
  const solid = (i: number) => index.features[i]!.count > 0;
  if (index.features.every((_, i) => flags[i] || !solid(i))) return [...foreign, "all"];
  const byTree = treeQueries(index, flags, new Uint8Array(flags.length));
  const covered = new Uint8Array(flags.length);
  const classes: string[] = [];
  for (const [name, members] of index.classes) {
    const solids = members.filter(solid);
    if (solids.length < 2 || !solids.every((i) => flags[i]) || !/^[\w.-]+$/.test(name)) continue;
    classes.push(ofClass(name));
    for (const i of members) covered[i] = 1;
  }
  const byClass = [...classes, ...treeQueries(index, flags, covered)];
  return [...foreign, ...(byClass.length < byTree.length ? byClass : byTree)];
}

function treeQueries(index: FeatureIndex, flags: Uint8Array, covered: Uint8Array): string[] {
  // For each subtree: the features still to be covered, and whether anything in it stays visible.
  const n = flags.length;
  const open = new Int32Array(n),
    visible = new Int32Array(n);
  for (let i = n - 1; i >= 0; --i) {
    if (index.features[i]!.count > 0) {
      if (!flags[i]) visible[i]!++;
      else if (!covered[i]) open[i]!++;
    }
    const above = index.parent[i]!;
    if (above < 0) continue;
    open[above]! += open[i]!;
    visible[above]! += visible[i]!;
  }
  const queries: string[] = [];
  for (let i = 0; i < n;) {
    const feature = index.features[i]!;
    if (open[i] === 0) i = index.end[i]!;
    else if (visible[i] === 0 && open[i]! > 1) {
      queries.push(ofSubtree(feature.id));
      i = index.end[i]!;
    } else {
      if (flags[i] && !covered[i] && feature.count > 0) queries.push(ofId(feature.id));
      ++i;
    }
  }
  return queries;
}

/** Flags with a subtree or class shown or hidden. */
export function switched(flags: Uint8Array, members: Iterable<number>, hidden: boolean): Uint8Array {
  const after = flags.slice();
  for (const i of members) after[i] = hidden ? 1 : 0;
  return after;
}

export function* subtree(index: FeatureIndex, i: number): Iterable<number> {
  for (let at = i; at < index.end[i]!; ++at) yield at;
}

/** Visible portion of a subtree or class. */
export type Seen = "all" | "some" | "none";

/** Prefix sums over the features in tree order, so that queries of a subtree take constant time. */
export class SeenCounts {
  private readonly solids: Int32Array;
  private readonly hidden: Int32Array;

  constructor(
    private readonly index: FeatureIndex,
    flags: Uint8Array,
  ) {
    const n = index.features.length;
    this.solids = new Int32Array(n + 1);
    this.hidden = new Int32Array(n + 1);
    for (let i = 0; i < n; ++i) {
      const isSolid = index.features[i]!.count > 0;
      this.solids[i + 1] = this.solids[i]! + (isSolid ? 1 : 0);
      this.hidden[i + 1] = this.hidden[i]! + (isSolid && flags[i] ? 1 : 0);
    }
  }

  /** Number of hidden features with voxels. */
  get hiddenSolids(): number {
    return this.hidden[this.hidden.length - 1]!;
  }

  ofSubtree(i: number): Seen {
    const end = this.index.end[i]!;
    return seenOf(this.solids[end]! - this.solids[i]!, this.hidden[end]! - this.hidden[i]!);
  }

  ofMembers(members: number[]): Seen {
    const sum = (of: Int32Array) => members.reduce((all, i) => all + of[i + 1]! - of[i]!, 0);
    return seenOf(sum(this.solids), sum(this.hidden));
  }
}

function seenOf(solids: number, hidden: number): Seen {
  return hidden === 0 ? "all" : hidden === solids ? "none" : "some";
}
