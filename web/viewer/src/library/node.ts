/** The library for Node.js: the same module as in browsers, in this process. */

import { readFile } from "node:fs/promises";
import { basename } from "node:path";
import { fileURLToPath } from "node:url";
import type createSvtModule from "../../../../build/web/svt.js";
import type { SvtModule, SvtModuleOptions } from "../../../../build/web/svt.js";
import type { FileBytes } from "../engine";
import { makeCall, needsFont, openFiles } from "../engine/calls";
import { errorOf, isEngineError, SvtError } from "../engine/errors";
import { bytesOf, fetched, sourcesOf, volumeOf, type OpenSettings, type Source, type Volume } from "./volume";

export { SvtError };
export type * from "./types";

/** scripts/npm.sh puts the module next to this script. */
function moduleFile(name: string): URL {
  return new URL(name, import.meta.url);
}

/** Opens a volume, a model, or several models as one. Each call has a module of its own, with its memory. */
export async function open(source: Source | readonly Source[], settings: OpenSettings = {}): Promise<Volume> {
  const files = await Promise.all(sourcesOf(source).map(read));
  const options = { ...settings };
  delete options.onProgress;
  delete options.assets;
  const { module, font } = await loadModule(settings.onProgress);
  let svt: SvtModule | null = module;
  const answered = <Answer>(call: (svt: SvtModule) => Answer): Answer => {
    if (!svt) throw new SvtError("E904", "the volume is closed");
    try {
      return call(svt);
    } catch (error) {
      if (isEngineError(error)) throw errorOf(error);
      // A module that has stopped cannot be used any more.
      svt = null;
      const reason = error instanceof Error ? error.message : String(error);
      throw new SvtError("E999", `the library has stopped (${reason}); open the file again`);
    }
  };
  const info = answered((open) => openFiles(open, files, options));
  return volumeOf(
    info,
    async (name, args) => {
      if (needsFont(name, args)) await font();
      return answered((open) => makeCall(open, name, args));
    },
    () => (svt = null),
  );
}

async function read(source: Source): Promise<FileBytes> {
  const given = await bytesOf(source);
  if (given) return given;
  const address = source instanceof URL ? source : /^(https?|data|file):/i.test(String(source)) ? new URL(String(source)) : null;
  if (address && address.protocol !== "file:") return fetched(address);
  const path = address ? fileURLToPath(address) : String(source);
  const bytes = await readFile(path).catch((error: Error) => {
    throw new SvtError("E101", `${path}: it cannot be read (${error.message})`);
  });
  return { name: basename(path), bytes: bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer };
}

let compiled: Promise<WebAssembly.Module> | null = null;

async function loadModule(onProgress: SvtModuleOptions["onProgress"]): Promise<{ module: SvtModule; font: () => Promise<void> }> {
  compiled ??= readFile(moduleFile("svt.wasm")).then((bytes) => WebAssembly.compile(new Uint8Array(bytes)));
  const wasm = await compiled;
  const { default: createSvt } = (await import(/* @vite-ignore */ moduleFile("svt.js").href)) as { default: typeof createSvtModule };
  const module = await withSelf(() =>
    createSvt({
      ...(onProgress ? { onProgress } : {}),
      instantiateWasm: (imports, receive) => {
        const instance = new WebAssembly.Instance(wasm, imports);
        receive(instance, wasm);
        return instance.exports;
      },
    }),
  );
  let given: Promise<void> | null = null;
  const giveFont = async () => void module.call("font", [], await readFile(moduleFile("DejaVuSans.ttf")));
  return { module, font: () => (given ??= giveFont()) };
}

/** The module's script reads `self.location` of browsers while it is called. */
function withSelf<Result>(call: () => Result): Result {
  const before = Object.getOwnPropertyDescriptor(globalThis, "self");
  Object.defineProperty(globalThis, "self", { value: { location: { href: moduleFile("svt.js").href } }, configurable: true });
  try {
    return call();
  } finally {
    if (before) Object.defineProperty(globalThis, "self", before);
    else delete (globalThis as { self?: unknown }).self;
  }
}
