/** The module of comparisons and quantities, in a worker that ends with its memory. */

import { kCancelled, type EngineError, type FileBytes } from "../engine";
import { json } from "../engine/calls";
import type { ReportAnswer, ReportRequest } from "./reports_worker";

interface Waiting {
  resolve: (reply: ArrayBuffer) => void;
  reject: (error: EngineError) => void;
}

/** A worker that waits for its first call; null: none. */
let spare: Worker | null = null;

function newWorker(): Worker {
  return new Worker(new URL("./reports_worker.ts", import.meta.url), { type: "module", name: "svt reports" });
}

/** Loads the module for later calls, which then need no connection. Resolves when it is there, or cannot be loaded. */
export function prepareReports(): Promise<void> {
  const worker = (spare ??= newWorker());
  return new Promise((resolve) => {
    worker.onmessage = () => resolve();
    worker.onerror = (event) => {
      event.preventDefault();
      if (spare === worker) spare = null;
      resolve();
    };
  });
}

export class ReportsModule {
  private readonly worker = spare ?? newWorker();
  /** The calls without an answer; answers come in their order. */
  private waiting: Waiting[] = [];
  /** null: the worker runs. */
  private ended: EngineError | null = null;

  /** @param signal  ends the worker; then calls reject with kCancelled */
  constructor(onProgress: (step: string, done: number) => void, signal: AbortSignal) {
    spare = null;
    signal.addEventListener("abort", () => this.end());
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.end({ code: "E999", message: `the report cannot run here (${event.message})` });
    };
    this.worker.onmessage = ({ data }: MessageEvent<ReportAnswer>) => {
      if ("isReady" in data) return;
      if ("step" in data) return onProgress(data.step, data.done);
      const next = this.waiting.shift();
      if ("reply" in data) next?.resolve(data.reply);
      else next?.reject(data.error);
    };
  }

  /** @param files  their bytes are transferred. @return rejects with an EngineError */
  call(name: string, args: unknown[] = [], files: FileBytes[] = []): Promise<ArrayBuffer> {
    if (this.ended) return Promise.reject(this.ended);
    return new Promise((resolve, reject) => {
      this.waiting.push({ resolve, reject });
      const buffers = new Set(files.map(({ bytes }) => bytes));
      this.worker.postMessage({ name, args, files } satisfies ReportRequest, [...buffers]);
    });
  }

  async json<T>(name: string, args: unknown[] = [], files: FileBytes[] = []): Promise<T> {
    return json<T>(new Uint8Array(await this.call(name, args, files)));
  }

  end(reason: EngineError = { code: kCancelled, message: kCancelled }): void {
    this.ended ??= reason;
    this.worker.terminate();
    this.waiting.splice(0).forEach(({ reject }) => reject(reason));
  }
}
