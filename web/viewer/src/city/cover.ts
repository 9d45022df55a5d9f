/** The share of a city that lists and counts of the page cover: the visible tiles. */

import type { Session } from "../session";
import { number } from "../texts";
import { toolText } from "../tool_texts";

/** null: everything, because no city is open. */
export function coverText({ volume }: Session): string | null {
  const { info, isCity, index } = volume;
  if (!isCity || !info) return null;
  // Coarse tiles have classes in place of buildings; their ids are the names of the classes.
  const n = index.features.reduce((sum, { parent, id, class: name }) => sum + (parent === "" && id !== name ? 1 : 0), 0);
  return toolText("cityCover", { n: number(n, 0), all: number(info.buildings ?? 0, 0) });
}
