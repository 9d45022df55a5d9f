/** Compiles and instantiates a module of the library. */

import type { SvtModule, SvtModuleOptions } from "../../../../build/web/svt.js";

/** The function of a module's script. */
export type Create = (options?: SvtModuleOptions) => Promise<SvtModule>;

/** Compiles during the download. If a server sends the wrong type, compiles after the download, which is slower. */
export function compiled(url: URL, response: Promise<Response> = fetch(url)): Promise<WebAssembly.Module> {
  return WebAssembly.compileStreaming(response).catch(async () => WebAssembly.compile(await (await fetch(url)).arrayBuffer()));
}

/** Reports an error if the instance cannot be made. Emscripten's script would wait for it forever. */
export function instantiated(create: Create, wasm: WebAssembly.Module, options: SvtModuleOptions): Promise<SvtModule> {
  return new Promise((resolve, reject) => {
    const instantiateWasm: SvtModuleOptions["instantiateWasm"] = (imports, receive) => {
      try {
        const instance = new WebAssembly.Instance(wasm, imports);
        receive(instance, wasm);
        return instance.exports;
      } catch (error) {
        reject(error);
        throw error;
      }
    };
    create({ ...options, instantiateWasm }).then(resolve, reject);
  });
}
