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
