// What tests of the installed packages share: a static site of the folder where they are installed, and pages in a browser.
// The environment variable SVT_NPM_FOLDER names the folder (scripts/test_npm.sh).
import { createReadStream, existsSync, mkdirSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { dirname, extname, join, normalize } from "node:path";
import { after } from "node:test";
import { endBrowser, newContext, svt } from "../../../web/viewer/e2e/harness.mjs";

export const folder = process.env.SVT_NPM_FOLDER ?? "";
export const at = (name) => join(folder, name);
export const kElement = "/node_modules/@semantic-volume-texture/viewer/dist/svt-viewer.js";
/** Ends what hangs; no measure of speed. */
export const kHang = Number(process.env.SVT_HANG ?? 240_000);

const kTypes = {
  ".html": "text/html",
  ".css": "text/css",
  ".js": "text/javascript",
  ".mjs": "text/javascript",
  ".wasm": "application/wasm",
  ".json": "application/json",
  ".png": "image/png",
};

const servers = new Set();
// A failed test must not leave anything that keeps its process alive.
after(async () => {
  await endBrowser();
  for (const server of servers) server.closeAllConnections();
  for (const server of servers) server.close();
});

/** Writes a file of the site. */
export function put(name, text) {
  mkdirSync(dirname(at(name)), { recursive: true });
  writeFileSync(at(name), text);
}

/** The house as model and volume, made once. */
export function makeHouse() {
  if (existsSync(at("house.svt"))) return;
  svt("sample", "house", "-o", at("house.gml"));
  svt("build", at("house.gml"), "-o", at("house.svt"), "--spacing", "0.15", "--vectors", "edges,meshes");
}

/** Serves a folder, also with ranges. Resolves to { url, requests, close }; requests: the paths that were asked for. */
export async function serve({ root = folder, headers = {} } = {}) {
  const requests = [];
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://x").pathname);
    requests.push(path);
    const file = join(root, normalize(path));
    if (!file.startsWith(root) || !existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end("not here");
    const size = statSync(file).size;
    const [, first, last] = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "") ?? [];
    const part = first === undefined ? {} : { start: Number(first), end: last ? Math.min(Number(last), size - 1) : size - 1 };
    const range = "start" in part ? { "Content-Range": `bytes ${part.start}-${part.end}/${size}` } : { "Content-Length": size };
    response.writeHead("start" in part ? 206 : 200, {
      "Content-Type": kTypes[extname(file)] ?? "application/octet-stream",
      "Cache-Control": "no-cache",
      ...range,
      ...headers,
    });
    createReadStream(file, part).pipe(response);
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", () => done(null)));
  servers.add(server);
  const { port } = /** @type {import("node:net").AddressInfo} */ (server.address());
  return { url: `http://127.0.0.1:${port}/`, requests, close: () => (server.closeAllConnections(), new Promise((r) => server.close(r))) };
}

/** Tries again until it holds. */
export async function eventually(check) {
  for (const end = Date.now() + kHang; ; await new Promise((done) => setTimeout(done, 50))) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() > end) throw error;
    }
  }
}

/** A page with elements; `events` of the page are those of all elements, as {id, type, detail}. */
export function htmlOf(body, head = "") {
  return `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>Page</title>
<link rel="icon" href="data:,">
${
  head ||
  `<link rel="stylesheet" href="/page.css">
<script src="/events.js"></script>
<script type="module" src="${kElement}"></script>`
}
<main>${body}</main>
</html>
`;
}

export function putShared() {
  put("page.css", "body { margin: 8px } svt-viewer { width: 320px; height: 200px; aspect-ratio: auto }");
  put(
    "events.js",
    `window.events = [];
for (const type of ["load", "progress", "pick", "camerachange", "error"])
  document.addEventListener(type, (event) => {
    if (event.target.localName === "svt-viewer") events.push({ id: event.target.id, type, detail: event.detail });
  }, true);`,
  );
}

/** A visitor of a site. */
export class Visitor {
  page = null;
  problems = [];

  /** Opens a page with this body. */
  show = async (site, body, /** @type {any} */ { head = "", query = "", ...options } = {}) => {
    put("page.html", htmlOf(body, head));
    return this.visit(`${site.url}page.html${query}`, options);
  };
  visit = async (address, options = {}) => {
    await this.leave();
    const context = await newContext({ locale: "en-US", colorScheme: "light", reducedMotion: "reduce", ...options });
    context.setDefaultTimeout(kHang);
    const page = (this.page = await context.newPage());
    this.problems = [];
    page.on("pageerror", (error) => this.problems.push(`error: ${error.message}`));
    page.on("console", (message) => ["error", "warning"].includes(message.type()) && this.problems.push(message.text()));
    await page.goto(address);
    return page;
  };
  leave = async () => {
    await this.page
      ?.context()
      .close()
      .catch(() => {});
    this.page = null;
  };

  loaded = (...ids) =>
    this.page.waitForFunction((wanted) => wanted.every((id) => /** @type {any} */ (document.getElementById(id)).loaded), ids);
  events = (type, id = null) =>
    this.page.evaluate(
      ([t, i]) => /** @type {any} */ (window).events.filter((event) => event.type === t && (i === null || event.id === i)),
      [type, id],
    );
  /** An expression of the element `e`. */
  ask = (id, expression, value = null) =>
    this.page.evaluate(
      ([of, text, v]) => new Function("e", "v", `return (async () => (${text}))()`)(document.getElementById(of), v),
      [id, expression, value],
    );
  /** The bytes of snapshot(). */
  snapshot = async (id, size = {}) =>
    Buffer.from(
      await this.ask(
        id,
        "e.snapshot(v).then((b) => b.arrayBuffer()).then((b) => btoa(Array.from(new Uint8Array(b), (c) => String.fromCharCode(c)).join('')))",
        size,
      ),
      "base64",
    );
  /** What is on the screen at the place of an element. */
  screen = (id) => this.page.locator(`#${id}`).screenshot();
}
