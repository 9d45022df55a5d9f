/** The selection, its properties, and the objects along a ray. */

import type { Feature, FeatureProperties, Pick, Stretch } from "../engine";
import { effect } from "../observable";
import { labelOf } from "../state/feature_index";
import { t } from "../texts";
import { ViewPart, type ViewParts } from "./view_part";

export interface AlongList {
  x: number;
  y: number;
  stretches: Stretch[];
}

export class Selection extends ViewPart {
  /** Properties of the selected feature, if there is exactly one; null until they arrive. */
  properties: FeatureProperties | null = null;
  /** Properties of the selected features, if there are exactly two; null until they arrive. */
  pair: readonly [FeatureProperties, FeatureProperties] | null = null;
  along: AlongList | null = null;
  /** Each tap or click adds to the selection, as with Ctrl. */
  isMore = false;

  constructor(parts: ViewParts) {
    super(parts);
    effect(() => {
      // After this turn, in which the page requests the picture.
      if (this.view.now.selection && this.volume.info) queueMicrotask(() => void this.read());
    });
  }

  /** The selected feature, if there is exactly one. */
  get only(): Feature | null {
    const [id, second] = this.view.now.selection;
    const { byId, features } = this.volume.index;
    return id === undefined || second !== undefined ? null : (features[byId.get(id) ?? -1] ?? null);
  }
  get isEmpty(): boolean {
    return this.along === null && this.view.now.selection.length === 0;
  }

  /** @param query  that selects exactly these; empty: none is known */
  select(ids: string[], isAdded = false, query = ""): void {
    const { selection } = this.view.state;
    const given = new Set(ids);
    const before = new Set(isAdded ? selection : []);
    const kept = [...before].filter((id) => !given.has(id));
    const added = isAdded && ids.every((id) => before.has(id)) ? [] : ids;
    const selectedBy = isAdded && kept.length ? "" : query;
    if (selectedBy) this.view.answers.learn(selectedBy, ids);
    this.along = null;
    this.view.set({ selection: [...kept, ...added], selectedBy: added.length ? selectedBy : "" });
    if (!kept.length && !added.length) this.isMore = false;
    const { only } = this;
    if (only) this.messages.say(t("picked", { name: labelOf(only), class: only.class }));
    else this.messages.say(ids.length ? t("severalSelected", { n: this.view.state.selection.length }) : t("nothingSelected"));
  }

  picked(pick: Pick | null, isAdded: boolean): void {
    if (pick) return this.select([pick.id], isAdded);
    if (!isAdded) this.select([]);
    this.messages.say(t("pickedNothing"));
  }

  async listAlong(x: number, y: number): Promise<void> {
    const { engine, info } = this.volume;
    if (!engine || !info) return;
    try {
      this.along = { x, y, stretches: await engine.along(x, y) };
      this.messages.say(t("alongTitle"));
    } catch (error) {
      this.messages.fail(error);
    }
  }

  /** Called when another model is opened. */
  forget(): void {
    this.along = null;
    this.properties = null;
    this.pair = null;
  }

  /** Selects again by the query of a link. */
  async selectByQuery(query: string): Promise<void> {
    const ids = await this.volume.engine?.select(query).catch(() => []);
    if (ids?.length && !this.view.state.selection.length) this.select(ids, false, query);
  }

  private async read(): Promise<void> {
    const { selection } = this.view.state;
    if (this.properties?.id !== selection[0] || selection.length !== 1) this.properties = null;
    if (selection.length !== 2 || this.pair?.some(({ id }, n) => id !== selection[n])) this.pair = null;
    const { engine, isCity, index } = this.volume;
    if (!engine || selection.length < 1 || selection.length > 2) return;
    if (isCity && !selection.every((id) => index.byId.has(id))) return;
    try {
      const [first, second] = await Promise.all(selection.map((id) => engine.properties(id)));
      if (this.view.state.selection !== selection) return;
      if (second) this.pair = [first!, second];
      else this.properties = first!;
    } catch (error) {
      this.messages.fail(error);
    }
  }
}
