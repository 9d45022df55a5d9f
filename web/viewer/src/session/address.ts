/** Keeps a link to the current view in the address of the page. */

import { effect, untracked } from "../observable";
import { hashOf } from "../state/link";
import type { OpenVolume } from "./open_volume";
import type { View } from "./view";

/** Milliseconds after the last change. */
const kWriteAfter = 500;

export class Address {
  private timer = 0;

  constructor(
    private readonly volume: OpenVolume,
    private readonly view: View,
  ) {}

  /** Follows the view from now on. */
  keep(): void {
    effect(() => {
      const { measured } = this.view.now;
      if (this.view.revision || measured.length) untracked(() => this.writeSoon());
    });
  }

  private writeSoon(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.write(), kWriteAfter);
  }

  /** Updates the address at once. */
  async write(): Promise<void> {
    const { view } = this;
    const { state } = view;
    if (!this.volume.info || !state.camera) return;
    try {
      const hash = await hashOf(await view.composed(view.size), state, this.volume.isCity ? null : this.volume.index);
      if (view.state === state) history.replaceState(null, "", `${this.plain()}${hash}`);
    } catch {
      // A view that cannot be drawn has no link; the picture has already reported the reason.
    }
  }

  /** The address without the view: with the open model if there are several, or with the names of local or compared files. */
  private plain(): string {
    const { name, models, isLocal, file, compared } = this.volume;
    const url = new URL(location.href);
    const named = compared ?? { ...(name && models.length > 1 ? { model: name } : {}), ...(isLocal ? { file } : {}) };
    for (const key of ["model", "file", "old", "new"]) url.searchParams.delete(key);
    for (const [key, value] of Object.entries(named)) url.searchParams.set(key, value);
    return url.pathname + url.search;
  }
}
