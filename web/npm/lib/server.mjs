// Serves a folder that the command has written: the page with its models. Other files are not accessible.
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, rmSync } from "node:fs";
import http from "node:http";
import net from "node:net";
import path from "node:path";

/** @type {Record<string, string>} by the ending of the name */
const TYPES = {
  ".css": "text/css; charset=utf-8",
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".json": "application/json",
  ".png": "image/png",
  ".svg": "image/svg+xml",
  ".ttf": "font/ttf",
  ".wasm": "application/wasm",
};

/**
 * Reads all files of a folder once. Requests are looked up by path, which is never joined to a folder.
 * @param {string} folder
 * @returns {Map<string, {bytes: Buffer, type: string, tag: string}>} by path: "/index.html" also as "/"
 */
export function readSite(folder) {
  const site = new Map();
  const visit = (/** @type {string} */ relative) => {
    for (const entry of readdirSync(path.join(folder, relative), { withFileTypes: true })) {
      const name = `${relative}/${entry.name}`;
      if (entry.isDirectory()) visit(name);
      else if (entry.isFile()) {
        const bytes = readFileSync(path.join(folder, name));
        const tag = `"${createHash("sha256").update(bytes).digest("hex").slice(0, 32)}"`;
        site.set(name, { bytes, type: TYPES[path.extname(name)] ?? "application/octet-stream", tag });
      }
    }
  };
  visit("");
  if (site.has("/index.html")) site.set("/", site.get("/index.html"));
  return site;
}

/**
 * Whether a Host header protects against DNS rebinding: an address, localhost, or a known name.
 * @param {string | undefined} header
 * @param {readonly string[]} names  in lower case
 */
export function isKnownHost(header, names) {
  const host = (header ?? "").toLowerCase().replace(/:\d+$/, "");
  return host === "localhost" || net.isIP(host.replace(/^\[|\]$/g, "")) !== 0 || names.includes(host);
}

/**
 * One range of bytes, "bytes=first-last", of content of `size` bytes.
 * @param {string | undefined} header
 * @param {number} size
 * @returns {{first: number, last: number} | "whole" | "none"} "whole": no range, several ranges, or an invalid one;
 *   "none": begins after the end
 */
export function byteRange(header, size) {
  const match = /^bytes=(\d*)-(\d*)$/.exec(header ?? "");
  if (!match || (match[1] === "" && match[2] === "")) return "whole";
  if (match[1] === "") return Number(match[2]) === 0 ? "none" : { first: Math.max(0, size - Number(match[2])), last: size - 1 };
  const first = Number(match[1]);
  const last = match[2] === "" ? size - 1 : Math.min(Number(match[2]), size - 1);
  if (match[2] !== "" && Number(match[2]) < first) return "whole";
  return first < size ? { first, last } : "none";
}

/**
 * The handler of requests.
 * @param {ReturnType<typeof readSite>} site
 * @param {readonly string[]} hostNames
 * @returns {http.RequestListener}
 */
export function handler(site, hostNames) {
  return (request, response) => {
    const refuse = (/** @type {number} */ status, /** @type {string} */ message, headers = {}) => {
      response.writeHead(status, { "Content-Type": "application/json", ...headers });
      response.end(JSON.stringify({ code: `HTTP${status}`, message }));
    };
    if (!isKnownHost(request.headers.host, hostNames)) return refuse(421, "this server has another name");
    if (request.method !== "GET" && request.method !== "HEAD") return refuse(405, "only GET and HEAD are possible", { Allow: "GET, HEAD" });
    let name;
    try {
      name = decodeURIComponent((request.url ?? "/").replace(/\?.*/s, ""));
    } catch {
      return refuse(400, "the address is not well formed");
    }
    const file = site.get(name);
    if (!file) return refuse(404, "there is no such file");
    /** @type {Record<string, string>} */
    const headers = {
      "Content-Type": file.type,
      ETag: file.tag,
      "Accept-Ranges": "bytes",
      "Cache-Control": "no-cache",
      "X-Content-Type-Options": "nosniff",
    };
    if (request.headers["if-none-match"] === file.tag) {
      response.writeHead(304, headers);
      return response.end();
    }
    const range = byteRange(request.headers.range, file.bytes.length);
    if (range === "none") return refuse(416, "the range begins after the end", { "Content-Range": `bytes */${file.bytes.length}` });
    const part = range === "whole" ? file.bytes : file.bytes.subarray(range.first, range.last + 1);
    if (range !== "whole") headers["Content-Range"] = `bytes ${range.first}-${range.last}/${file.bytes.length}`;
    response.writeHead(range === "whole" ? 200 : 206, { ...headers, "Content-Length": part.length });
    return response.end(request.method === "HEAD" ? undefined : part);
  };
}

/**
 * Serves the folder that the command has written until Ctrl-C, then removes the folder.
 * @param {{folder: string, host: string, port: number, mayTakeOtherPort: boolean, hostNames: string[],
 *   opensBrowser: boolean}} orders  from apps/cli/commands/serve_node.cpp
 * @param {(address: string) => void} openBrowser
 * @returns {Promise<number>} the exit code
 */
export function serve(orders, openBrowser) {
  const site = readSite(orders.folder);
  const names = [...orders.hostNames, orders.host].map((name) => name.toLowerCase());
  const server = http.createServer(handler(site, names));
  let port = orders.port;
  return new Promise((resolve) => {
    const end = (/** @type {number} */ code) => {
      rmSync(orders.folder, { recursive: true, force: true });
      resolve(code);
    };
    server.on("error", (/** @type {NodeJS.ErrnoException} */ error) => {
      if (error.code === "EADDRINUSE" && orders.mayTakeOtherPort && port < orders.port + 100) {
        port += 1;
        server.listen(port, orders.host);
        return;
      }
      process.stderr.write(`svt: error E904 BadArgument: the server cannot listen at ${orders.host}:${port}: ${error.message}\n`);
      end(1);
    });
    server.on("listening", () => {
      port = /** @type {net.AddressInfo} */ (server.address()).port;
      if (orders.port !== 0 && port !== orders.port) process.stderr.write(`svt: port ${orders.port} is in use; this is port ${port}\n`);
      const name = net.isIPv6(orders.host) ? `[${orders.host}]` : orders.host === "0.0.0.0" ? "127.0.0.1" : orders.host;
      const address = `http://${name}:${port}/`;
      process.stdout.write(`${address}\n`);
      if (orders.opensBrowser) openBrowser(address);
      process.stderr.write("svt: Ctrl-C stops\n");
    });
    for (const signal of ["SIGINT", "SIGTERM"])
      process.once(signal, () => {
        server.close();
        server.closeAllConnections?.();
        end(0);
      });
    server.listen(port, orders.host);
  });
}
