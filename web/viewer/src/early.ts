/** Starts the slowest parts of a visit before all other parts of the page: the library in its worker, and the list of models. */

import { createEngine } from "./engine/client";
import type { EngineKind } from "./engine";
import { readModels } from "./opening";

export const canvas = document.createElement("canvas");
canvas.setAttribute("aria-hidden", "true");
/** The library in the browser. */
export const creating = createEngine(canvas, wantedEngine(), { mayUseThreads: mayUseThreads() });
creating.catch(() => undefined);
export const listing = readModels(new URLSearchParams(location.search).get("model"));

/** `?engine=cpu` or `webgl2` selects one renderer; by default the page determines the faster one. */
function wantedEngine(): EngineKind | null {
  const wanted = new URLSearchParams(location.search).get("engine");
  return wanted === "cpu" || wanted === "webgl2" ? wanted : null;
}

/** `?threads=no` disables threads, for comparison. */
function mayUseThreads(): boolean {
  return new URLSearchParams(location.search).get("threads") !== "no";
}
