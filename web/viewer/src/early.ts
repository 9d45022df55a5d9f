/** Starts the slowest parts of a visit before all other parts of the page: the library in its worker, and the list of models. */

import { Arrival } from "./arrival";
import { createEngine } from "./engine/client";
import type { EngineKind } from "./engine";
import { readModels } from "./opening";

export const canvas = document.createElement("canvas");
canvas.setAttribute("aria-hidden", "true");
/** The received parts of the library and of the model. */
export const arrival = new Arrival();
/** The library in the browser. */
export const creating = createEngine(canvas, wantedEngine(), { mayUseThreads: mayUseThreads() }, null, (done, all) => {
  arrival.module = { done, all };
});
creating.catch(() => undefined);
const wanted = new URLSearchParams(location.search);
/** The old state of a comparison is opened first. */
export const listing = readModels(wanted.get("model") ?? wanted.get("old"));
void listing.then(({ bytes }) => (arrival.volume = bytes));

/** `?engine=cpu` or `webgl2` selects one renderer; by default the page determines the faster one. */
function wantedEngine(): EngineKind | null {
  const wanted = new URLSearchParams(location.search).get("engine");
  return wanted === "cpu" || wanted === "webgl2" ? wanted : null;
}

/** `?threads=no` disables threads, for comparison. */
function mayUseThreads(): boolean {
  return new URLSearchParams(location.search).get("threads") !== "no";
}
