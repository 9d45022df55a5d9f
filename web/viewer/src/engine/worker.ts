/** The worker: holds the library and the volume that is open, and answers the page's requests one after the other. */
import createSvt, { type SvtModule } from "../../../../build/web/svt.js";
import { Drawer } from "./drawer";
import { isEngineError } from "./errors";
import type { Answer, Request } from "./protocol";

/** How long the page must have been still before what takes longer is done. */
const stillMilliseconds = 700;

const loaded = createSvt({ onProgress: (step, done) => post({ id: current, step, done }) });
// Kept for whoever awaits it; alone it must not end the worker.
loaded.catch(() => undefined);

let drawer: Drawer | null = null;
/** The request that is being answered. */
let current = 0;
/** What stopped the library while nobody waited for it; whoever asks next is told. */
let stopped: unknown = null;

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

function drawerOf(svt: SvtModule): Drawer {
  return (drawer ??= new Drawer(svt, null));
}

async function answer(request: Request): Promise<void> {
  const { id, name, args } = request;
  const svt = await loaded;
  if (stopped) throw stopped;
  current = id;
  switch (name) {
    case "start":
      drawer = new Drawer(svt, args[0]);
      return post({ id, result: drawer.kind });
    case "open": {
      const info = svt.call(name, [args[1]], new Uint8Array(args[0]));
      drawerOf(svt).forgetPicture();
      return post({ id, result: json(info) });
    }
    case "draw": {
      const drawn = await drawerOf(svt).draw(...args);
      return post({ id, result: drawn }, [drawn.bitmap]);
    }
    case "picture":
      await drawerOf(svt).prepare(args[0]);
    // falls through
    case "drawing": {
      const bytes = copied(svt.call(name, args));
      return post({ id, result: bytes }, [bytes]);
    }
    default:
      return post({ id, result: json(svt.call(name, args)) });
  }
}

/** Anything but an error of the library leaves the module in a state that nobody knows. */
function fail(id: number, error: unknown): void {
  if (isEngineError(error)) return post({ id, error: { code: error.code, message: error.message }, isDead: false });
  const message = error instanceof Error ? error.message : String(error);
  post({ id, error: { code: "E999", message: `the library has stopped (${message}); open the model again` }, isDead: true });
}

// One after the other, in order, though some answers take more than one turn.
let queue = Promise.resolve();
let stillTimer: ReturnType<typeof setTimeout> | undefined;
self.onmessage = (event: MessageEvent<Request>) => {
  const request = event.data;
  clearTimeout(stillTimer);
  queue = queue
    .then(() => answer(request))
    .catch((error: unknown) => fail(request.id, error))
    .then(() => {
      clearTimeout(stillTimer);
      if (drawer?.isWaiting) stillTimer = setTimeout(useStillness, stillMilliseconds);
    });
};

function useStillness(): void {
  try {
    drawer?.useStillness();
  } catch (error) {
    stopped = error;
  }
}
