/**
 * Hidden features: stored as short queries, so that links stay short and apply to other volumes of the
 * model, and converted to a flag per feature for the tree.
 */

import { hasGroups, withMembers, type FeatureIndex } from "./feature_index";
import { joined, ofClass, ofId, ofSubtree, ownTerms, parseOwn, type OwnQuery } from "./queries";

/** The features that the library selects for a query of the user; undefined: not yet known. */
export type Answers = (query: string) => readonly number[] | undefined;
const noAnswers: Answers = () => undefined;

/** The features that a query selects, with the members of groups. */
function membersOf(index: FeatureIndex, term: OwnQuery): readonly number[] {
  if (term.kind === "all") return index.features.map((_, i) => i);
  if (term.kind === "class") return index.classes.get(term.value) ?? [];
  const i = index.byId.get(term.value);
  if (i === undefined) return [];
  return term.kind === "id" ? [i] : withMembers(index, [i]);
}

/** The features of the queries; those of an unknown query are left out. */
export function featuresOf(index: FeatureIndex, queries: readonly string[], answers: Answers = noAnswers): number[] {
  const flags = hiddenFlags(index, queries, answers);
  return index.features.flatMap((_, i) => (flags[i] ? [i] : []));
}

/** 1 for each feature hidden by the queries. Queries that the page cannot answer yet are ignored. */
export function hiddenFlags(index: FeatureIndex, queries: readonly string[], answers: Answers = noAnswers): Uint8Array {
  const flags = new Uint8Array(index.features.length);
  for (const query of queries) {
    const terms = ownTerms(query);
    const above: number[] = [];
    for (const term of terms ?? []) {
      const i = term.kind === "under" ? index.byId.get(term.value) : undefined;
      if (i !== undefined) above.push(i);
      else if (term.kind !== "under") for (const member of membersOf(index, term)) flags[member] = 1;
    }
    if (above.length) for (const i of withMembers(index, above)) flags[i] = 1;
    if (!terms) for (const i of answers(query) ?? []) flags[i] = 1;
  }
  return flags;
}

/**
 * A short list of queries that hides exactly the flagged features with voxels. A query of the user stays while all features
 * that it selects are flagged, or while these features are unknown.
 * @param offered  queries that the flagged features may come from
 */
export function hideQueries(
  index: FeatureIndex,
  flags: Uint8Array,
  before: readonly string[] = [],
  answers: Answers = noAnswers,
  offered: readonly string[] = [],
): string[] {
  const isFlagged = (members: readonly number[]) => members.every((i) => flags[i] || index.features[i]!.count === 0);
  const kept = new Map<string, readonly number[]>();
  for (const query of [...before, ...offered]) {
    const members = ownTerms(query) ? groupOf(index, query) : answers(query);
    if (members === null) continue;
    if (members ? isFlagged(members) : before.includes(query)) kept.set(query, members ?? []);
  }
  const foreign = [...kept.keys()];
  const solid = (i: number) => index.features[i]!.count > 0;
  if (index.features.every((_, i) => flags[i] || !solid(i))) return [...foreign.filter((query) => !kept.get(query)!.length), "all"];
  const covered = new Uint8Array(flags.length);
  for (const members of kept.values()) for (const i of members) covered[i] = 1;
  const byTree = treeQueries(index, flags, covered);
  const classes: string[] = [];
  const inClasses = covered.slice();
  for (const [name, members] of index.classes) {
    const solids = members.filter(solid);
    if (solids.length < 2 || !solids.every((i) => flags[i]) || !/^[\w.-]+$/.test(name)) continue;
    if (solids.every((i) => covered[i])) continue;
    classes.push(ofClass(name));
    for (const i of members) inClasses[i] = 1;
  }
  const rest = treeQueries(index, flags, inClasses);
  return [...foreign, ...(classes.length + rest.length < byTree.length ? [...classes, ...joined(rest)] : joined(byTree))];
}

/** The members of a group for the query `under` of it: they are anywhere in the tree, so that no other query is as short. */
function groupOf(index: FeatureIndex, query: string): readonly number[] | null {
  const term = parseOwn(query);
  const i = term?.kind === "under" ? index.byId.get(term.value) : undefined;
  return i !== undefined && hasGroups(index, i) ? withMembers(index, [i]) : null;
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
    else if (visible[i] === 0 && open[i]! > 1 && hidesOnlyFlagged(index, flags, i)) {
      queries.push(ofSubtree(feature.id));
      i = index.end[i]!;
    } else {
      if (flags[i] && !covered[i] && feature.count > 0) queries.push(ofId(feature.id));
      ++i;
    }
  }
  return queries;
}

/** Whether the members of groups in a subtree are all flagged, too. */
function hidesOnlyFlagged(index: FeatureIndex, flags: Uint8Array, i: number): boolean {
  return !hasGroups(index, i) || withMembers(index, [i]).every((member) => flags[member] || index.features[member]!.count === 0);
}

/** Flags with a subtree or class shown or hidden. */
export function switched(flags: Uint8Array, members: Iterable<number>, hidden: boolean): Uint8Array {
  const after = flags.slice();
  for (const i of members) after[i] = hidden ? 1 : 0;
  return after;
}

/** A feature with all below it, and the members of groups among them. */
export function subtree(index: FeatureIndex, i: number): number[] {
  return withMembers(index, [i]);
}

/** The features with these ids. @param isExact  without those below them */
export function withMembersOf(index: FeatureIndex, ids: readonly string[], isExact: boolean): readonly number[] {
  const found = ids.flatMap((id) => index.byId.get(id) ?? []);
  return isExact ? found : withMembers(index, found);
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

  hiddenOf(members: readonly number[]): number {
    return sum(this.hidden, members);
  }

  /** Number of features with voxels in a subtree, with the members of groups. */
  solidsOf(i: number): number {
    return hasGroups(this.index, i) ? sum(this.solids, subtree(this.index, i)) : this.index.solids[i]!;
  }

  ofSubtree(i: number): Seen {
    if (hasGroups(this.index, i)) return this.ofMembers(subtree(this.index, i));
    const end = this.index.end[i]!;
    return seenOf(this.solids[end]! - this.solids[i]!, this.hidden[end]! - this.hidden[i]!);
  }

  ofMembers(members: readonly number[]): Seen {
    return seenOf(sum(this.solids, members), sum(this.hidden, members));
  }
}

/** Sum over members, of prefix sums. */
function sum(of: Int32Array, members: readonly number[]): number {
  return members.reduce((all, i) => all + of[i + 1]! - of[i]!, 0);
}

function seenOf(solids: number, hidden: number): Seen {
  return hidden === 0 ? "all" : hidden === solids ? "none" : "some";
}
