/**
 * Loads the library. A visit begins with the module that draws volumes and cities. The whole module also reads models and
 * makes drawings and sheets; it is loaded when one of them is needed. Both exist with threads, for pages that are isolated
 * from other sites (headers COOP and COEP), and without. All give the same results.
 */
import createWhole from "../../../../build/web/svt.js";
import createView, { type SvtModule, type SvtModuleOptions } from "../../../../build/web/svt_view.js";
import { lengthOf } from "../download";
import type { EngineError } from "../engine";
import { compiled, instantiated, type Create } from "./instantiate";
import { kWithoutThreads } from "./protocol";

export type ModuleKind = "view" | "whole";

type OnProgress = NonNullable<SvtModuleOptions["onProgress"]>;
/** Told how many bytes of a module have come, of how many; 0: unknown. */
export type OnReceived = (done: number, all: number) => void;
/** Sizes of the modules by name, from vite.config.ts, for servers that compress them. */
declare const kModuleBytes: Record<string, number>;

/** Files of a module. Scripts with threads are not bundled: each thread loads the script again. */
interface Files {
  wasm: URL;
  script: URL | Create;
  /** The script of a thread. */
  worker?: [name: string, address: URL];
}

const kPlain: Record<ModuleKind, Files> = {
  view: { wasm: new URL("../../../../build/web/svt_view.wasm", import.meta.url), script: createView },
  whole: { wasm: new URL("../../../../build/web/svt.wasm", import.meta.url), script: createWhole },
};
const kThreads: Record<ModuleKind, Files> = {
  view: {
    wasm: new URL("../../../../build/web/svt_view_threads.wasm", import.meta.url),
    script: new URL("../../../../build/web/svt_view_threads.js", import.meta.url),
    worker: ["svt_view_threads.worker.js", new URL("../../../../build/web/svt_view_threads.worker.js", import.meta.url)],
  },
  whole: {
    wasm: new URL("../../../../build/web/svt_threads.wasm", import.meta.url),
    script: new URL("../../../../build/web/svt_threads.js", import.meta.url),
    worker: ["svt_threads.worker.js", new URL("../../../../build/web/svt_threads.worker.js", import.meta.url)],
  },
};

/** A module whose compilation has begun, with the function of its script. */
interface Begun {
  files: Files;
  wasm: WebAssembly.Module;
  create: Create;
}

const begun: Partial<Record<ModuleKind, Promise<Begun>>> = {};

/** Fetches and compiles a module, once. Begins anew after a failure. */
function begin(kind: ModuleKind, onReceived?: OnReceived): Promise<Begun> {
  const hasThreads = self.crossOriginIsolated && navigator.hardwareConcurrency > 1 && self.name !== kWithoutThreads;
  const plain = () => load(kPlain[kind], onReceived);
  const loading = (begun[kind] ??= hasThreads ? load(kThreads[kind], onReceived).catch(plain) : plain());
  loading.catch(() => delete begun[kind]);
  return loading;
}

async function load(files: Files, onReceived?: OnReceived): Promise<Begun> {
  // Compiles while the script is still loading.
  const response = fetch(files.wasm);
  if (onReceived) void response.then((given) => count(given.clone(), files.wasm, onReceived)).catch(() => undefined);
  const compiling = compiled(files.wasm, response);
  compiling.catch(() => undefined);
  const { script } = files;
  const create = script instanceof URL ? ((await import(/* @vite-ignore */ script.href)) as { default: Create }).default : script;
  return { files, wasm: await compiling, create };
}

export async function loadModule(kind: ModuleKind, onProgress: OnProgress, onReceived?: OnReceived): Promise<SvtModule> {
  const first = await begin(kind, onReceived);
  try {
    return await made(first, onProgress);
  } catch (error) {
    // A module with threads may lack address space where the one without threads has enough.
    if (first.files === kPlain[kind]) throw error;
    return made(await (begun[kind] = load(kPlain[kind])), onProgress);
  }
}

/** The whole module, or an EngineError that leaves the open volume as it is. */
export function loadWhole(onProgress: OnProgress): Promise<SvtModule> {
  return loadModule("whole", onProgress).catch((error: unknown) => {
    const reason = error instanceof Error ? error.message : String(error);
    const message = `the part of the program that reads models and makes drawings cannot be loaded (${reason}); check the connection and try again`;
    throw { code: "E101", message } satisfies EngineError;
  });
}

/** Loads the whole module for later. Resolves to false if it cannot be loaded, or if the browser is to save data. */
export async function prepareWhole(): Promise<boolean> {
  const { connection } = navigator as { connection?: { saveData?: boolean } };
  if (connection?.saveData) return false;
  return begin("whole").then(
    () => true,
    () => false,
  );
}

/** Counts the bytes of a copy of the response, so that the browser can keep the code that it compiles from the original. */
async function count(response: Response, url: URL, onReceived: OnReceived): Promise<void> {
  if (!response.ok || !response.body) return;
  const name = Object.keys(typeof kModuleBytes === "undefined" ? {} : kModuleBytes).find((key) =>
    new RegExp(`/${key}(-[^/]*)?\\.wasm$`).test(url.pathname),
  );
  const all = name ? kModuleBytes[name]! : lengthOf(response.headers);
  const reader = response.body.getReader();
  for (let done = 0; ;) {
    const { done: isEnd, value } = await reader.read();
    if (isEnd) return;
    done += value.length;
    onReceived(done, all);
  }
}

function made({ files, wasm, create }: Begun, onProgress: OnProgress): Promise<SvtModule> {
  const { script, worker } = files;
  const ofThreads: SvtModuleOptions = worker
    ? { mainScriptUrlOrBlob: (script as URL).href, locateFile: (name) => (name === worker[0] ? worker[1].href : name) }
    : {};
  return instantiated(create, wasm, { onProgress, ...ofThreads });
}
