/** The features that queries of the user select, as the library answered. The page knows those of its own queries itself. */

import { effect, Observable } from "../observable";
import { ownTerms } from "../state/queries";
import type { OpenVolume } from "./open_volume";

export class Answers extends Observable {
  /** Answers for the open model; replaced as a whole. */
  private known: ReadonlyMap<string, readonly number[]> = new Map();
  private readonly asked = new Set<string>();

  constructor(private readonly volume: OpenVolume) {
    super();
    effect(() => {
      if (this.volume.info) this.forget();
    });
  }

  /** The features of a query; undefined: not known yet. */
  readonly of = (query: string): readonly number[] | undefined => this.known.get(query);

  learn(query: string, ids: readonly string[]): void {
    const { byId } = this.volume.index;
    this.known = new Map(this.known).set(
      query,
      ids.flatMap((id) => byId.get(id) ?? []),
    );
  }

  /** Asks the library for the queries that are not known. Queries that it refuses stay unknown. */
  async find(queries: readonly string[]): Promise<void> {
    const { engine, info } = this.volume;
    for (const query of queries) {
      if (!engine || this.asked.has(query) || ownTerms(query)) continue;
      this.asked.add(query);
      const ids = await engine.select(query).catch(() => null);
      if (ids && this.volume.info === info) this.learn(query, ids);
    }
  }

  private forget(): void {
    this.asked.clear();
    this.known = new Map();
  }
}
