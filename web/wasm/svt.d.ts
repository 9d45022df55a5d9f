/** The library as a module; what `make web` leaves in build/web: svt.js, svt.wasm, and DejaVuSans.ttf for names. */
export interface SvtModule {
  /**
   * Runs a call of web/wasm/module.cpp with the arguments it names. The reply, JSON as UTF-8 or bytes, lies in the
   * module's memory: copy it before the next call. Throws { code, message } where the call fails, and a RuntimeError
   * where the module itself does, which cannot be used any more then.
   */
  call(name: string, args: readonly unknown[], bytes?: Uint8Array): Uint8Array;
  /** Makes a WebGL2 context on the canvas and makes it current, for drawGl; false where there is none. */
  startGl(canvas: OffscreenCanvas): boolean;
}

export interface SvtModuleOptions {
  /** Told while a volume is opened; `done` is 0..1. */
  onProgress?: (step: string, done: number) => void;
  /** svt.wasm, where it is at hand; else it is fetched from beside svt.js. */
  wasmBinary?: ArrayBuffer;
}

export default function createSvt(options?: SvtModuleOptions): Promise<SvtModule>;
