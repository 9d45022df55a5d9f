/** Compares two states in a worker, which ends with its memory afterwards. */

import { kCancelled, type EngineError, type FileBytes } from "../engine";
import { json } from "../engine/calls";
import { ReportsModule } from "../reports/reports_module";
import { isFatal } from "../session/model";
import type { Compared, Report, Row, Summary, Wish } from "./compared";

/**
 * @param states  the old and the new one; their bytes are transferred
 * @param memory  limit of each volume that is built, bytes
 * @return rejects with an EngineError; its code is kCancelled after `signal`
 */
export async function compareStates(
  states: [FileBytes[], FileBytes[]],
  wish: Wish & { memory: number },
  onProgress: (step: string, done: number) => void,
  signal: AbortSignal,
): Promise<Compared> {
  const svt = new ReportsModule(onProgress, signal);
  const of = <T>(value: (file: FileBytes) => T) => states.map((state) => state.map(value));
  try {
    const sizes = of(({ bytes }) => bytes.byteLength);
    const report = await svt.json<Report>("compare", [of(({ name }) => name), sizes, wish], states.flat());
    const order = await svt.json<number[]>("order");
    const file = await svt.call("rows");
    const volume = await svt.call("difference").catch(reasonOf);
    const hasVolume = typeof volume !== "string";
    return {
      report,
      order,
      ...json<{ rows: Row[]; summary: Summary }>(new Uint8Array(file)),
      file: new Blob([file], { type: "application/json" }),
      volume: hasVolume ? new Blob([volume]) : null,
      reason: hasVolume ? "" : volume,
    };
  } finally {
    svt.end();
  }
}

/** The reason for a missing difference volume: the states share no samples, or have too many objects. */
function reasonOf(error: EngineError): string {
  const { code, message } = error;
  if (code === kCancelled || isFatal(error)) throw error;
  return message;
}
