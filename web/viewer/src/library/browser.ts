/** The library for browsers: runs in a worker. */

import { createEngine } from "../engine/client";
import { errorOf } from "../engine/errors";
import { bytesOf, fetched, sourcesOf, volumeOf, type OpenSettings, type Source, type Volume } from "./volume";

export { SvtError } from "../engine/errors";
export type * from "./types";

/** Opens a volume, a model, or several models as one. */
export async function open(source: Source | readonly Source[], settings: OpenSettings = {}): Promise<Volume> {
  const { onProgress, assets, ...options } = settings;
  const sources = sourcesOf(source);
  const engine = await createEngine(null, null, { mayUseThreads: true, ...(assets ? { assets } : {}) }).catch((error: unknown) => {
    throw errorOf(error);
  });
  try {
    const files = await Promise.all(
      sources.map(
        async (one) => (await bytesOf(one)) ?? fetched(new URL(one as string | URL, globalThis.document?.baseURI ?? location.href)),
      ),
    );
    const info = await engine.open(files, onProgress ?? (() => undefined), options);
    return volumeOf(
      info,
      (name, args) => (engine[name] as (...given: unknown[]) => Promise<unknown>)(...args),
      () => engine.close(),
    );
  } catch (error) {
    engine.close();
    throw errorOf(error);
  }
}
