/**
 * Loads the library: with threads if the page is isolated from other sites (headers COOP and COEP), else without. Both
 * modules give the same results.
 */
import createSvt, { type SvtModule, type SvtModuleOptions } from "../../../../build/web/svt.js";
import { kWithoutThreads } from "./protocol";

const kPlain = new URL("../../../../build/web/svt.wasm", import.meta.url);
/** Not bundled: each thread loads these files again. */
const kThreads: Record<string, URL> = {
  "svt_threads.js": new URL("../../../../build/web/svt_threads.js", import.meta.url),
  "svt_threads.wasm": new URL("../../../../build/web/svt_threads.wasm", import.meta.url),
  "svt_threads.worker.js": new URL("../../../../build/web/svt_threads.worker.js", import.meta.url),
};

type OnProgress = NonNullable<SvtModuleOptions["onProgress"]>;

export async function loadModule(onProgress: OnProgress): Promise<SvtModule> {
  const hasThreads = self.crossOriginIsolated && navigator.hardwareConcurrency > 1 && self.name !== kWithoutThreads;
  // If the module with threads cannot run, for example without enough address space, the one without threads may.
  return hasThreads ? withThreads(onProgress).catch(() => withoutThreads(onProgress)) : withoutThreads(onProgress);
}

async function withoutThreads(onProgress: OnProgress): Promise<SvtModule> {
  return made(createSvt, await compiled(kPlain), { onProgress });
}

async function withThreads(onProgress: OnProgress): Promise<SvtModule> {
  // Compiles while the script is still loading.
  const compiling = compiled(kThreads["svt_threads.wasm"]!);
  compiling.catch(() => undefined);
  const { default: create } = (await import(/* @vite-ignore */ kThreads["svt_threads.js"]!.href)) as { default: typeof createSvt };
  return made(create, await compiling, {
    onProgress,
    mainScriptUrlOrBlob: kThreads["svt_threads.js"]!.href,
    locateFile: (name) => kThreads[name]?.href ?? name,
  });
}

/** Compiles during the download. If a server sends the wrong type, compiles after the download, which is slower. */
async function compiled(url: URL): Promise<WebAssembly.Module> {
  return WebAssembly.compileStreaming(fetch(url)).catch(async () => WebAssembly.compile(await (await fetch(url)).arrayBuffer()));
}

/** Reports an error if the instance cannot be made. Emscripten's script would wait for it forever. */
function made(create: typeof createSvt, module: WebAssembly.Module, options: SvtModuleOptions): Promise<SvtModule> {
  return new Promise((resolve, reject) => {
    const instantiateWasm: SvtModuleOptions["instantiateWasm"] = (imports, receive) => {
      try {
        const instance = new WebAssembly.Instance(module, imports);
        receive(instance, module);
        return instance.exports;
      } catch (error) {
        reject(error);
        throw error;
      }
    };
    create({ ...options, instantiateWasm }).then(resolve, reject);
  });
}
