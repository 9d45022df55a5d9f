/** The worker of comparisons and quantities. It loads a module of its own, and answers the calls of the page one after the other. */

import createReports, { type SvtModule } from "../../../../build/web/svt_reports.js";
import type { EngineError, FileBytes } from "../engine";
import { joined } from "../engine/calls";
import { isEngineError } from "../engine/errors";
import { compiled, instantiated } from "../engine/instantiate";

/** A call of the module. `files`: their bytes, one after the other, are the bytes of the call. */
export interface ReportRequest {
  name: string;
  args: unknown[];
  files: FileBytes[];
}

/** Once, whether the module has come; then each call has one reply or one error, after any number of steps. */
export type ReportAnswer = { isReady: boolean } | { step: string; done: number } | { error: EngineError } | { reply: ArrayBuffer };

const kModule = new URL("../../../../build/web/svt_reports.wasm", import.meta.url);

const post = (answer: ReportAnswer, transfer: Transferable[] = []) => self.postMessage(answer, { transfer });
const compiling = compiled(kModule);
compiling.then(
  () => post({ isReady: true }),
  () => post({ isReady: false }),
);
/** Made by the first call; a worker that only waits has no memory of the library. */
let loading: Promise<SvtModule> | null = null;
/** The answer to the last call. */
let last = Promise.resolve();

async function load(): Promise<SvtModule> {
  return instantiated(createReports, await compiling.catch(() => compiled(kModule)), { onProgress: (step, done) => post({ step, done }) });
}

self.onmessage = ({ data }: MessageEvent<ReportRequest>) => {
  last = last.then(() => answered(data)).catch(failed);
};

function failed(error: unknown): void {
  const message = error instanceof Error ? error.message : String(error);
  post({ error: isEngineError(error) ? error : { code: "E999", message: `the report has stopped (${message})` } });
}

async function loaded(): Promise<SvtModule> {
  try {
    return await (loading ??= load());
  } catch (error) {
    loading = null;
    const reason = error instanceof Error ? error.message : String(error);
    const message = `the part of the program that compares and measures models cannot be loaded (${reason}); check the connection and try again. A page in one file does not have it`;
    throw { code: "E101", message } satisfies EngineError;
  }
}

async function answered({ name, args, files }: ReportRequest): Promise<void> {
  const svt = await loaded();
  // Copies the reply, which is in the module's memory.
  const reply = svt.call(name, args, joined(files)).slice().buffer as ArrayBuffer;
  post({ reply }, [reply]);
}
