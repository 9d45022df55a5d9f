/** The bytes that a visit begins with: the module of the library, and the chosen volume. */

import type { Download } from "./download";
import { Observable } from "./observable";

export class Arrival extends Observable {
  /** Bytes of the module. */
  module = { done: 0, all: 0 };
  /** null: a city, which has no volume; undefined: not chosen yet. */
  volume: Pick<Download, "done" | "all"> | null | undefined = undefined;

  /** The received share of all bytes, 0 to 1; null: how many they are is unknown. */
  get share(): number | null {
    const { module, volume } = this;
    if (volume === undefined || !(module.all > 0) || (volume && !(volume.all > 0))) return null;
    return Math.min(1, (module.done + (volume?.done ?? 0)) / (module.all + (volume?.all ?? 0)));
  }
}
