// Times of a published page on slow networks, in a browser that has never seen it: node bench/network.mjs [VOLUME]. Needs
// `make viewer`; a machine that does nothing else. Prints a table in Markdown: until the preview, the first picture, and the
// finest one. The server sends the compressed modules of `svt publish`, and compresses texts by gzip, as most servers do.
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { browse, kTypes, page as pageFolder, svt } from "../e2e/harness.mjs";

const kRounds = Number(process.env.SVT_BENCH_ROUNDS ?? 3);
/** Round trip in milliseconds, megabits per second: those of the browser's own tools, as the network has them. */
const kNetworks = {
  "3G (150 ms, 1.6 Mbit/s)": [150, 1.6],
  "slow 3G (400 ms, 0.4 Mbit/s)": [400, 0.4],
  "4G (85 ms, 9 Mbit/s)": [85, 9],
};

const folder = mkdtempSync(join(tmpdir(), "svt-network-bench-"));
let volume = process.argv[2];
if (!volume) {
  volume = join(folder, "house.svt");
  svt("sample", "house", "-o", join(folder, "house.gml"));
  svt("build", join(folder, "house.gml"), "-o", volume, "--vectors", "edges,meshes");
}
svt("publish", volume, "-o", join(folder, "site"), "--viewer", pageFolder);

const server = createServer((request, response) => {
  const path = decodeURIComponent(new URL(request.url, "http://x").pathname).replace(/^\/+/, "") || "index.html";
  const file = join(folder, "site", path);
  if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
  const encodings = String(request.headers["accept-encoding"]);
  const packed = /\bbr\b/.test(encodings) && existsSync(`${file}.br`) ? "br" : existsSync(`${file}.gz`) ? "gz" : null;
  const isText = !packed && /\.(html|js|css|json|svg)$/.test(file);
  response.writeHead(200, {
    "Content-Type": kTypes[extname(file)] ?? "application/octet-stream",
    ...(packed || isText ? { "Content-Encoding": packed === "br" ? "br" : "gzip" } : {}),
  });
  const bytes = readFileSync(packed ? `${file}.${packed}` : file);
  response.end(isText ? gzipSync(bytes) : bytes);
});
await new Promise((done) => server.listen(0, "127.0.0.1", () => done(null)));
const address = `http://127.0.0.1:${/** @type {import("node:net").AddressInfo} */ (server.address()).port}/`;

async function visit(latency, megabits) {
  const { context, close } = await browse({ viewport: { width: 1280, height: 720 }, locale: "en-US" });
  const page = await context.newPage();
  const client = await context.newCDPSession(page);
  await client.send("Network.enable");
  const bytes = (megabits * 1e6) / 8;
  await client.send("Network.emulateNetworkConditions", { offline: false, latency, downloadThroughput: bytes, uploadThroughput: bytes });
  const begin = performance.now();
  await page.goto(address, { waitUntil: "commit" });
  const seconds = async (isThere) => {
    await page.waitForFunction(isThere, null, { timeout: 180_000, polling: 50 });
    return (performance.now() - begin) / 1000;
  };
  // The image of the first text of the page; the page takes it over later.
  const preview = await seconds(
    () =>
      [document.querySelector("body > #preview"), document.querySelector("svt-app")?.shadowRoot?.querySelector("#preview")].some(
        (image) => image instanceof HTMLImageElement && image.complete && image.naturalWidth > 0,
      ) || performance.getEntriesByName("svt-first-image").length > 0,
  );
  const first = await seconds(() => performance.getEntriesByName("svt-first-image").length > 0);
  const fine = await seconds(() => /** @type {any} */ (document.querySelector("svt-app")).session.picture.quality === "fine");
  await close();
  return [preview, first, fine];
}

const median = (numbers) => [...numbers].sort((a, b) => a - b)[numbers.length >> 1];
console.log(`${volume.split("/").pop()}, ${(statSync(volume).size / 1e3).toFixed(0)} kB; medians of ${kRounds}\n`);
console.log("| network | preview | first picture | finest picture |\n| --- | --- | --- | --- |");
for (const [name, [latency, megabits]] of Object.entries(kNetworks)) {
  const visits = [];
  for (let n = 0; n < kRounds; ++n) visits.push(await visit(latency, megabits));
  console.log(`| ${name} | ${[0, 1, 2].map((i) => `${median(visits.map((times) => times[i])).toFixed(1)} s`).join(" | ")} |`);
}
server.close();
rmSync(folder, { recursive: true, force: true });
