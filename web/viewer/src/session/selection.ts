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
  along: AlongList | null = null;

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

  select(ids: string[], isAdded = false): void {
    const { selection } = this.view.state;
    const kept = isAdded ? selection.filter((id) => !ids.includes(id)) : [];
    const added = isAdded && ids.every((id) => selection.includes(id)) ? [] : ids;
    this.along = null;
    this.view.set({ selection: [...kept, ...added] });
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
  }

  private async read(): Promise<void> {
    const { selection } = this.view.state;
    const id = selection.length === 1 ? selection[0]! : null;
    if (this.properties?.id !== id) this.properties = null;
    const { engine, isCity, index } = this.volume;
    if (id === null || !engine || (isCity && !index.byId.has(id))) return;
    try {
      const properties = await engine.properties(id);
      if (this.view.state.selection[0] === id) this.properties = properties;
    } catch (error) {
      this.messages.fail(error);
    }
  }
}
