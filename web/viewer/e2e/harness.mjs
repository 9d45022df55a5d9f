// A static server and a browser for tests of the built page. The headers are as strict as `svt serve` sends them.
import { spawn, spawnSync } from "node:child_process";
import { createReadStream, existsSync, mkdtempSync, rmSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const here = fileURLToPath(new URL(".", import.meta.url));
export const repository = resolve(here, "../../..");
export const page = process.env.SVT_VIEWER_DIR ?? join(repository, "build/release/share/svt/viewer");
export const command = process.env.SVT_COMMAND ?? join(repository, "build/release/bin/svt");
export const dataDir = process.env.SVT_DATA_DIR ?? resolve(repository, "../shared/data");
/**
 * Milliseconds by which scripts and style sheets come late, half to twice as many by chance; requests of the page reach its workers
 * after a quarter of that. It finds tests that do not wait for them.
 */
const delay = Number(process.env.SVT_DELAY ?? 0);
/** Without the windows of Chromium, which take a third of the processor time of a visit. */
export const browserPath = process.env.SVT_CHROMIUM ?? "/usr/bin/chromium-headless-shell";

export const kTypes = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".json": "application/json",
};
export const policy =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; connect-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/** Serves the page and, from `files`, named files beside it; `isIsolated`: as `svt serve`, so that threads can be used. Resolves to { url, close }. */
export function serve(files = {}, isIsolated = false) {
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://x").pathname).replace(/^\/+/, "") || "index.html";
    const file = path in files ? files[path] : join(page, normalize(path));
    const isText = typeof file === "object";
    if (!isText && ((!file.startsWith(page) && !(path in files)) || !existsSync(file) || !statSync(file).isFile())) {
      response.writeHead(404).end("not here");
      return;
    }
    response.writeHead(200, {
      "Content-Type": kTypes[extname(path)] ?? "application/octet-stream",
      "Content-Security-Policy": policy,
      "X-Content-Type-Options": "nosniff",
      "Cache-Control": "no-cache",
      ...(isIsolated ? { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" } : {}),
    });
    if (isText) response.end(JSON.stringify(file));
    else if (delay && /\.(js|css)$/.test(path))
      setTimeout(() => createReadStream(file).pipe(response), delay * 2 ** (2 * Math.random() - 1));
    else createReadStream(file).pipe(response);
  });
  return new Promise((done) =>
    server.listen(0, "127.0.0.1", () =>
      done({
        url: `http://127.0.0.1:${/** @type {import("node:net").AddressInfo} */ (server.address()).port}/`,
        close: () => new Promise((r) => (server.closeAllConnections(), server.close(r))),
      }),
    ),
  );
}

/** A model list as `svt serve` makes it. */
export function withModels(models) {
  const files = {
    "models.json": {
      models: models.map(({ name, path, title }) => ({ name, title, file: `data/${name}.svt`, bytes: statSync(path).size })),
    },
  };
  for (const { name, path } of models) files[`data/${name}.svt`] = path;
  return files;
}

/** What a browser is started with: software graphics, and nothing that asks the network. */
const kBrowser = {
  executablePath: browserPath,
  headless: true,
  args: [
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
  ],
};
const kPage = { viewport: { width: 1200, height: 640 }, acceptDownloads: true };

/** A new browser with a profile of its own, which keeps compiled modules between visits: for measurements. */
export async function browse(options = {}) {
  const profile = mkdtempSync(join(tmpdir(), "svt-viewer-"));
  const context = await chromium.launchPersistentContext(profile, { ...kBrowser, ...kPage, ...options });
  return { context, close: async () => (await context.close(), rmSync(profile, { recursive: true, force: true })) };
}

// Without a second compilation of modules, and with pages composed by the CPU instead of a simulated graphics card, which WebGL
// still has, a visit takes less than half of the processor time (17 instead of 40 s for six). Drawing takes longer.
const kQuick = ["--js-flags=--liftoff-only", "--disable-gpu-compositing"];

let started = null;
/** A context of the one browser of this process, in which nothing is kept: to start a browser takes seconds. */
export async function newContext(options = {}) {
  started ??= chromium.launch({ ...kBrowser, args: [...kBrowser.args, ...kQuick], timeout: 0 });
  const context = await (await started).newContext({ ...kPage, ...options });
  await context.addInitScript(watchWorkers, delay / 4);
  return context;
}

/** In the page: counts the cameras for which it has asked a worker (`svtAwaitedCameras`), and delays each request. */
function watchWorkers(delay) {
  /** @type {Map<Worker, Set<number>>} ids of the requests without an answer */
  const awaited = new Map();
  const ends = new WeakMap();
  Object.defineProperty(globalThis, "svtAwaitedCameras", { get: () => [...awaited.values()].reduce((sum, ids) => sum + ids.size, 0) });
  const { postMessage, terminate } = Worker.prototype;
  Worker.prototype.postMessage = function (request, transfer) {
    const ids = awaited.get(this) ?? new Set();
    if (!awaited.has(this)) this.addEventListener("message", ({ data }) => "step" in data || ids.delete(data.id));
    awaited.set(this, ids);
    if (request.name === "view") ids.add(request.id);
    const post = () => postMessage.call(this, request, transfer);
    if (!delay) return post();
    const late = new Promise((done) => setTimeout(done, delay * 2 ** (2 * Math.random() - 1)));
    ends.set(this, Promise.all([ends.get(this), late]).then(post));
  };
  Worker.prototype.terminate = function () {
    terminate.call(this);
    awaited.delete(this);
  };
}
export const endBrowser = async () => {
  await (await started)?.close();
  started = null;
};

/** Runs `svt`; throws with what it said where it fails. */
export function svt(...words) {
  const done = spawnSync(command, words, { encoding: "buffer", maxBuffer: 64 << 20 });
  if (done.status !== 0) throw new Error(`svt ${words.join(" ")}: exit ${done.status}: ${done.stderr}`);
  return done.stdout;
}

/** The JSON that `svt` prints. */
export const svtJson = (...words) => JSON.parse(svt(...words).toString());

/** `svt serve` with the built page. Resolves to { url, close }. */
export function svtServe(...words) {
  const child = spawn(command, ["serve", ...(words.includes("--viewer") ? words : [...words, "--viewer", page]), "--port", "0"], {
    stdio: ["ignore", "pipe", "pipe"],
  });
  return new Promise((resolve, reject) => {
    let said = "";
    const heard = (chunk) => {
      said += chunk;
      const url = /http:\/\/[\d.]+:\d+\//.exec(said)?.[0];
      if (url) resolve({ url, close: () => new Promise((done) => (child.once("exit", done), child.kill("SIGTERM"))) });
    };
    child.stdout.on("data", heard);
    child.stderr.on("data", heard);
    child.once("exit", (code) => reject(new Error(`svt serve: exit ${code}: ${said}`)));
  });
}
