/** The worker that compares two states. It loads a module of its own, answers one request, and is then ended. */

import createCompare, { type SvtModule } from "../../../../build/web/svt_compare.js";
import type { EngineError, FileBytes } from "../engine";
import { isEngineError } from "../engine/errors";
import { compiled, instantiated } from "../engine/instantiate";
import type { Wish } from "./compared";

export interface CompareRequest {
  states: [FileBytes[], FileBytes[]];
  /** `memory`: limit of each volume that is built here, bytes. */
  wish: Wish & { memory: number };
}

export type CompareAnswer =
  | { step: string; done: number }
  | { error: EngineError }
  /** `file`: the bytes of `svt diff -o F.json`; `volume`: those of `-o F.svt`, or the reason why there are none. */
  | { report: ArrayBuffer; order: ArrayBuffer; file: ArrayBuffer; volume: ArrayBuffer | string };

const kModule = new URL("../../../../build/web/svt_compare.wasm", import.meta.url);

const post = (answer: CompareAnswer, transfer: Transferable[] = []) => self.postMessage(answer, { transfer });
const loading = load();
loading.catch(() => undefined);

async function load(): Promise<SvtModule> {
  return instantiated(createCompare, await compiled(kModule), { onProgress: (step, done) => post({ step, done }) });
}

self.onmessage = ({ data }: MessageEvent<CompareRequest>) => {
  void answered(data).catch((error: unknown) => {
    const message = error instanceof Error ? error.message : String(error);
    post({ error: isEngineError(error) ? error : { code: "E999", message: `the comparison has stopped (${message})` } });
  });
};

async function loaded(): Promise<SvtModule> {
  try {
    return await loading;
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    const message = `the part of the program that compares models cannot be loaded (${reason}); check the connection and try again. A page in one file does not have it`;
    throw { code: "E101", message } satisfies EngineError;
  }
}

async function answered({ states, wish }: CompareRequest): Promise<void> {
  const svt = await loaded();
  const files = states.flat();
  const bytes = new Uint8Array(files.reduce((sum, file) => sum + file.bytes.byteLength, 0));
  let at = 0;
  for (const file of files) {
    bytes.set(new Uint8Array(file.bytes), at);
    at += file.bytes.byteLength;
  }
  const of = <T>(value: (file: FileBytes) => T) => states.map((state) => state.map(value));
  const copy = (name: string, args: unknown[] = [], given?: Uint8Array) => svt.call(name, args, given).slice().buffer as ArrayBuffer;
  const report = copy("compare", [of(({ name }) => name), of((file) => file.bytes.byteLength), wish], bytes);
  const answer = { report, order: copy("order"), file: copy("rows"), volume: difference(copy) };
  post(
    answer,
    Object.values(answer).filter((part) => part instanceof ArrayBuffer),
  );
}

/** The reason, if the states have no common samples or too many objects. */
function difference(copy: (name: string) => ArrayBuffer): ArrayBuffer | string {
  try {
    return copy("difference");
  } catch (error) {
    if (isEngineError(error)) return error.message;
    throw error;
  }
}
