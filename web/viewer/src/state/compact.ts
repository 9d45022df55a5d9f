/**
 * Sets of many features in links: a query of the selection stays a query, and ids become ranges of the tree. The ranges hold
 * for the same model, and the page expands them when it has opened it.
 */

import type { FeatureIndex } from "./feature_index";
import { joined, ofId, ofSubtree, ownTerms } from "./queries";
import type { ViewState } from "./view_state";

/** Shorter texts stay as they are. */
const kShort = 400;
const kRows = /^#(id|under) ([\da-z,+]+)$/;
const kBase = 36;

/** Ascending positions as gaps and lengths: `3+5` skips three features and takes five, `3` takes one. */
export function rangesOf(positions: Iterable<number>): string {
  const sorted = [...new Set(positions)].sort((a, b) => a - b);
  const parts: string[] = [];
  let end = 0;
  for (let n = 0; n < sorted.length;) {
    const start = sorted[n]!;
    let count = 1;
    while (sorted[n + count] === start + count) ++count;
    parts.push(`${(start - end).toString(kBase)}${count > 1 ? `+${count.toString(kBase)}` : ""}`);
    end = start + count;
    n += count;
  }
  return parts.join(",");
}

/** Positions below `count`; invalid parts are left out. */
export function positionsOf(ranges: string, count: number): number[] {
  const positions: number[] = [];
  let end = 0;
  for (const part of ranges.split(",")) {
    const [gap = NaN, length = 1] = part.split("+").map((text) => parseInt(text, kBase));
    if (!(gap >= 0 && length >= 1)) continue;
    const start = end + gap;
    end = start + length;
    for (let at = start; at < Math.min(end, count); ++at) positions.push(at);
    if (end >= count) break;
  }
  return positions;
}

const sizeOf = (texts: readonly string[]) => texts.reduce((sum, text) => sum + text.length + 3, 0);

function shortQueries(queries: string[], index: FeatureIndex): string[] {
  if (sizeOf(queries) < kShort) return queries;
  const rows = { id: [] as number[], under: [] as number[] };
  const others = queries.filter((query) => {
    const terms = ownTerms(query);
    if (!terms) return true;
    const places = terms.map((term) => ("value" in term && term.kind !== "class" ? index.byId.get(term.value) : undefined));
    if (places.some((at) => at === undefined)) return true;
    terms.forEach(({ kind }, n) => rows[kind as "id" | "under"].push(places[n]!));
    return false;
  });
  const short = (["id", "under"] as const).flatMap((kind) => (rows[kind].length ? [`#${kind} ${rangesOf(rows[kind])}`] : []));
  return [...others, ...short];
}

function longQueries(queries: string[], index: FeatureIndex): string[] {
  return queries.flatMap((query) => {
    const [, kind, ranges] = kRows.exec(query) ?? [];
    if (!kind) return [query];
    const of = kind === "id" ? ofId : ofSubtree;
    return joined(positionsOf(ranges!, index.features.length).map((at) => of(index.features[at]!.id)));
  });
}

export function compacted(state: ViewState, index: FeatureIndex): ViewState {
  const places = state.selection.map((id) => index.byId.get(id));
  const isLong = sizeOf(state.selection) >= kShort && places.every((at) => at !== undefined);
  const selection = state.selectedBy ? [] : isLong ? [`#id ${rangesOf(places as number[])}`] : state.selection;
  return { ...state, selection, hide: shortQueries(state.hide, index), show: shortQueries(state.show, index) };
}

export function expanded(state: ViewState, index: FeatureIndex): ViewState {
  const selection = state.selection.flatMap((id) => {
    const ranges = index.byId.has(id) ? undefined : kRows.exec(id)?.[2];
    return ranges === undefined ? [id] : positionsOf(ranges, index.features.length).map((at) => index.features[at]!.id);
  });
  return { ...state, selection, hide: longQueries(state.hide, index), show: longQueries(state.show, index) };
}
