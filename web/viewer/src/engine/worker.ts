/** The worker: holds the library and the volume that is open, and answers the page's requests one after the other. */
import createSvt, { type SvtModule } from "../../../../build/web/svt.js";
import type { EngineError, Scene } from "../engine";
import type { Answer, Calls, Drawn, Request } from "./protocol";

const loaded = createSvt({ onProgress: (step, done) => post({ id: current, step, done }) });
// Kept for whoever awaits it; alone it must not end the worker.
loaded.catch(() => undefined);

/** The request that is being answered. */
let current = 0;

function post(answer: Answer, transfer: Transferable[] = []): void {
  self.postMessage(answer, { transfer });
}

function json<T>(reply: Uint8Array): T {
  return JSON.parse(new TextDecoder().decode(reply)) as T;
}

/** The bytes by themselves; the reply lies in the module's memory. */
function copied(reply: Uint8Array): ArrayBuffer {
  return reply.slice().buffer as ArrayBuffer;
}

let hasFont = false;

/** The font is fetched when names are first drawn. */
async function prepare(svt: SvtModule, scene: Scene): Promise<void> {
  if (hasFont || !scene.names?.length) return;
  const response = await fetch(new URL("../../../../build/web/DejaVuSans.ttf", import.meta.url));
  if (!response.ok) throw { code: "E101", message: `the font of names cannot be fetched (${response.status})` };
  svt.call("font", [], new Uint8Array(await response.arrayBuffer()));
  hasFont = true;
}

async function draw(svt: SvtModule, args: Calls["draw"]["args"]): Promise<Drawn> {
  const [scene, width, height] = args;
  await prepare(svt, scene);
  const start = performance.now();
  const pixels = new Uint8ClampedArray(copied(svt.call("draw", [scene, width, height])));
  const bitmap = await createImageBitmap(new ImageData(pixels, width, height));
  return { bitmap, report: { width, height, milliseconds: performance.now() - start, engine: "cpu" } };
}

async function answer(request: Request): Promise<void> {
  const { id, name, args } = request;
  const svt = await loaded;
  current = id;
  switch (name) {
    case "start":
      return post({ id, result: "cpu" });
    case "open":
      return post({ id, result: json(svt.call(name, [args[1]], new Uint8Array(args[0]))) });
    case "draw": {
      const drawn = await draw(svt, args);
      return post({ id, result: drawn }, [drawn.bitmap]);
    }
    case "picture":
      await prepare(svt, args[0]);
    // falls through
    case "drawing": {
      const bytes = copied(svt.call(name, args));
      return post({ id, result: bytes }, [bytes]);
    }
    default:
      return post({ id, result: json(svt.call(name, args)) });
  }
}

function isEngineError(error: unknown): error is EngineError {
  return typeof error === "object" && error !== null && "code" in error && typeof error.code === "string";
}

/** Anything but an error of the library leaves the module in a state that nobody knows. */
function fail(id: number, error: unknown): void {
  if (isEngineError(error)) return post({ id, error: { code: error.code, message: error.message }, isDead: false });
  const message = error instanceof Error ? error.message : String(error);
  post({ id, error: { code: "E999", message: `the library has stopped (${message}); open the model again` }, isDead: true });
}

// One after the other, in order, though some answers take more than one turn.
let queue = Promise.resolve();
self.onmessage = (event: MessageEvent<Request>) => {
  const request = event.data;
  queue = queue.then(() => answer(request)).catch((error: unknown) => fail(request.id, error));
};
