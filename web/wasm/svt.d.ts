/**
 * The library as a module; `make web` writes to build/web: svt.js, svt.wasm, and DejaVuSans.ttf for names. svt_view.js draws
 * volumes and cities, but reads no models and makes no drawings and sheets. svt_threads.js and svt_view_threads.js are
 * the same for pages that are isolated from other sites (COOP and COEP): their calls use all cores.
 */
export interface SvtModule {
  /**
   * Makes a call of web/wasm/module.cpp with its arguments. The reply, JSON as UTF-8 or bytes, is in the module's
   * memory: copy it before the next call. Throws { code, message } if the call fails, and a RuntimeError if the module
   * itself fails; the module is then unusable.
   */
  call(name: string, args: readonly unknown[], bytes?: Uint8Array): Uint8Array;
  /** Creates a WebGL2 context on the canvas and makes it current, for drawGl; false if WebGL2 is unavailable. */
  startGl(canvas: OffscreenCanvas): boolean;
  /** Ends the threads of the module, which is then unusable. */
  close(): void;
}

export interface SvtModuleOptions {
  /** Called while a volume is opened; `done` is 0..1. */
  onProgress?: (step: string, done: number) => void;
  /** svt.wasm, if already loaded; else it is fetched from the folder of svt.js. */
  wasmBinary?: ArrayBuffer;
  /** The address of a file of the module, by name; else in the folder of svt.js. */
  locateFile?: (name: string) => string;
  /** The address of svt_threads.js, for its threads; else next to svt_threads.worker.js. */
  mainScriptUrlOrBlob?: string;
  /** Instantiates a module whose compilation has begun, and passes the instance on. */
  instantiateWasm?: (imports: WebAssembly.Imports, receive: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void) => object;
}

export default function createSvt(options?: SvtModuleOptions): Promise<SvtModule>;
