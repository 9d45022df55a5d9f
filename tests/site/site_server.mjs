// A web server for the built site: compresses text as servers of static sites do, and answers ranges.
import { existsSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";

const kTypes = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".json": "application/json",
  ".webp": "image/webp",
  ".png": "image/png",
  ".xml": "application/xml",
};
const kPacked = new Set([".html", ".js", ".css", ".svg", ".json", ".xml", ".wasm"]);

/**
 * Serves a folder. `changed` has other contents for some paths, for tests of the tests. Resolves to { url, close }.
 * @param {string} folder
 * @param {Record<string, string>} changed
 */
export function serveSite(folder, changed = {}) {
  const server = createServer((request, response) => {
    let path = decodeURIComponent(new URL(request.url, "http://x").pathname).replace(/^\/+/, "");
    if (path === "" || path.endsWith("/")) path += "index.html";
    const file = join(folder, normalize(path));
    if (!(path in changed) && (!file.startsWith(folder) || !existsSync(file) || !statSync(file).isFile())) {
      response.writeHead(404, { "Content-Type": "text/plain" }).end("not here");
      return;
    }
    const bytes = path in changed ? Buffer.from(changed[path]) : readFileSync(file);
    const type = kTypes[extname(path)] ?? "application/octet-stream";
    const range = /^bytes=(\d+)-(\d*)$/.exec(request.headers.range ?? "");
    if (range) {
      const [begin, end] = [Number(range[1]), range[2] ? Math.min(Number(range[2]), bytes.length - 1) : bytes.length - 1];
      response.writeHead(206, { "Content-Type": type, "Content-Range": `bytes ${begin}-${end}/${bytes.length}` });
      response.end(bytes.subarray(begin, end + 1));
      return;
    }
    const isPacked = kPacked.has(extname(path));
    const body = isPacked ? gzipSync(bytes) : bytes;
    response.writeHead(200, { "Content-Type": type, "Content-Length": body.length, ...(isPacked ? { "Content-Encoding": "gzip" } : {}) });
    response.end(body);
  });
  return new Promise((done) =>
    server.listen(0, "127.0.0.1", () =>
      done({
        url: `http://127.0.0.1:${/** @type {import("node:net").AddressInfo} */ (server.address()).port}/`,
        close: () => new Promise((closed) => (server.closeAllConnections(), server.close(closed))),
      }),
    ),
  );
}
