/** Starts workers with the library, also for scripts of another site than the page (a content delivery network). */

import { kWithoutThreads } from "./protocol";

export interface WorkerPlace {
  /** Address of the folder with the worker and its files; absent: next to this script. */
  assets?: string;
  mayUseThreads: boolean;
}

/** Name of the worker's file in the packages (vite.packages.config.ts). */
const kWorkerFile = "worker.js";

export function startWorker({ assets, mayUseThreads }: WorkerPlace): Worker {
  const address = new URL(kWorkerFile, assets ? new URL(assets, location.href) : import.meta.url);
  // webpack replaces import.meta.url by a path of the machine that builds.
  const isElsewhere = /^https?:$/.test(address.protocol) && address.origin !== location.origin;
  // Threads are workers, too, which browsers start only from the page's own site.
  const name = mayUseThreads && !isElsewhere ? "svt" : kWithoutThreads;
  if (isElsewhere) return importing(address, name);
  if (assets) return new Worker(address, { type: "module", name });
  // Bundlers find the worker by this expression.
  return new Worker(new URL("./worker.ts", import.meta.url), { type: "module", name });
}

/** Browsers start workers only from the page's own site, but these may import scripts of other sites. */
function importing(address: URL, name: string): Worker {
  const script = URL.createObjectURL(new Blob([`import ${JSON.stringify(address.href)};`], { type: "text/javascript" }));
  const worker = new Worker(script, { type: "module", name });
  const forget = () => URL.revokeObjectURL(script);
  worker.addEventListener("message", forget, { once: true });
  worker.addEventListener("error", forget, { once: true });
  return worker;
}
