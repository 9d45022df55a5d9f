/** Compares two states in a worker, which ends with its memory afterwards. */

import { kCancelled, type EngineError, type FileBytes } from "../engine";
import { json } from "../engine/calls";
import type { Compared, Row, Summary, Wish } from "./compared";
import type { CompareAnswer, CompareRequest } from "./compare_worker";

/**
 * @param states  the old and the new one; their bytes are transferred
 * @param memory  limit of each volume that is built, bytes
 * @return rejects with an EngineError; its code is kCancelled after `signal`
 */
export function compareStates(
  states: [FileBytes[], FileBytes[]],
  wish: Wish & { memory: number },
  onProgress: (step: string, done: number) => void,
  signal: AbortSignal,
): Promise<Compared> {
  const worker = new Worker(new URL("./compare_worker.ts", import.meta.url), { type: "module", name: "svt comparison" });
  return new Promise<Compared>((resolve, reject) => {
    signal.addEventListener("abort", () => reject({ code: kCancelled, message: kCancelled } satisfies EngineError));
    worker.onerror = (event) => {
      event.preventDefault();
      reject({ code: "E999", message: `the comparison cannot run here (${event.message})` } satisfies EngineError);
    };
    worker.onmessage = ({ data }: MessageEvent<CompareAnswer>) => {
      if ("step" in data) return onProgress(data.step, data.done);
      if ("error" in data) return reject(data.error);
      resolve(comparedOf(data));
    };
    const buffers = new Set(states.flat().map(({ bytes }) => bytes));
    worker.postMessage({ states, wish } satisfies CompareRequest, [...buffers]);
  }).finally(() => worker.terminate());
}

function comparedOf(answer: Extract<CompareAnswer, { report: ArrayBuffer }>): Compared {
  const read = <T>(bytes: ArrayBuffer) => json<T>(new Uint8Array(bytes));
  const hasVolume = typeof answer.volume !== "string";
  return {
    report: read(answer.report),
    order: read(answer.order),
    ...read<{ rows: Row[]; summary: Summary }>(answer.file),
    file: new Blob([answer.file], { type: "application/json" }),
    volume: hasVolume ? new Blob([answer.volume]) : null,
    reason: hasVolume ? "" : (answer.volume as string),
  };
}
