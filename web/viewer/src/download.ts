/** A file that is being downloaded, with the number of bytes so far. */

import { Observable } from "./observable";
import { t } from "./texts";

/** Milliseconds between two changes of `done`. */
const kEvery = 100;

export class Download extends Observable {
  /** Bytes so far. */
  done = 0;
  /** All bytes; 0: unknown. */
  all: number;
  /** The whole file, which the browser may keep on disk. Rejects with a message for the user. */
  readonly blob: Promise<Blob>;
  private readonly abort = new AbortController();

  /** @param all  the size of the file, if it is known; 0: as the server announces it */
  constructor(
    readonly file: string,
    all: number,
  ) {
    super();
    this.all = all || 0;
    this.blob = this.fetched();
    this.blob.catch(() => undefined);
  }

  cancel(): void {
    this.abort.abort();
  }

  private async fetched(): Promise<Blob> {
    const { file } = this;
    const response = await fetch(file, { signal: this.abort.signal }).catch(() => {
      throw { message: t("notReached", { name: file }) };
    });
    if (!response.ok) throw { message: t("notLoaded", { name: file, status: response.status }) };
    this.all ||= lengthOf(response.headers);
    return response.body ? this.received(response.body) : response.blob();
  }

  private async received(body: ReadableStream<Uint8Array>): Promise<Blob> {
    const reader = body.getReader();
    const parts: Uint8Array<ArrayBuffer>[] = [];
    let size = 0,
      timer: ReturnType<typeof setTimeout> | undefined;
    const report = (): void => {
      timer = undefined;
      this.done = size;
    };
    try {
      for (;;) {
        const { done, value } = await reader.read();
        if (done) break;
        parts.push(value as Uint8Array<ArrayBuffer>);
        size += value.length;
        // Also if no further bytes come.
        timer ??= setTimeout(report, kEvery);
      }
    } finally {
      clearTimeout(timer);
    }
    this.done = this.all = size;
    return new Blob(parts);
  }
}

/** The announced number of bytes; 0: unknown, also if the connection compresses them. */
export function lengthOf(headers: Headers): number {
  return headers.get("Content-Encoding") ? 0 : Number(headers.get("Content-Length") ?? 0) || 0;
}
