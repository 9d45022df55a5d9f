/** Builds queries (docs/user/query-language.md) from ids, names and classes. */

/** A quoted value with any content. */
export function quoted(value: string): string {
  return `"${value.replace(/[\\"]/g, (c) => `\\${c}`)}"`;
}

export const ofId = (id: string): string => `id=${quoted(id)}`;
export const ofClass = (className: string): string => `class=${className}`;
export const ofSubtree = (id: string): string => `under ${quoted(id)}`;

/** Queries written by the functions above; null for any other query. */
export type OwnQuery = { kind: "id" | "class" | "under"; value: string } | { kind: "all" };

export function parseOwn(query: string): OwnQuery | null {
  if (query === "all") return { kind: "all" };
  const bare = /^class=([\w.:-]+)$/.exec(query);
  if (bare) return { kind: "class", value: bare[1]! };
  const match = /^(id=|under )"((?:[^"\\]|\\.)*)"$/.exec(query);
  if (!match) return null;
  const value = match[2]!.replace(/\\(.)/g, "$1");
  return { kind: match[1] === "id=" ? "id" : "under", value };
}

/** More terms than these are joined, because the library evaluates many terms of one query together. */
const kSeparate = 16;
/** Characters of a joined query. The library takes 65536 bytes, and a character has up to 3. */
const kMostCharacters = 20_000;
const kTerm = /(?:id=|under )"(?:[^"\\]|\\.)*"/y;

/** The same selection in few queries. */
export function joined(terms: readonly string[]): string[] {
  if (terms.length <= kSeparate) return [...terms];
  const queries: string[] = [];
  let length = Infinity;
  for (const term of terms) {
    if (length + term.length > kMostCharacters) {
      queries.push(term);
      length = term.length;
    } else {
      queries[queries.length - 1] += ` or ${term}`;
      length += term.length + 4;
    }
  }
  return queries;
}

/** The terms of a query that joined() has made, or the one term of a query written here; null for any other query. */
export function ownTerms(query: string): OwnQuery[] | null {
  const single = parseOwn(query);
  if (single) return [single];
  const terms: OwnQuery[] = [];
  for (let at = 0; ;) {
    kTerm.lastIndex = at;
    const term = kTerm.exec(query)?.[0];
    if (!term) return null;
    terms.push(parseOwn(term)!);
    at += term.length;
    if (at === query.length) return terms;
    if (!query.startsWith(" or ", at)) return null;
    at += 4;
  }
}
