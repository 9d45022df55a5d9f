// Times of a city on the page over a slow line: node bench/city.mjs CITY...  Needs `make viewer`.
// Prints a table in Markdown: first picture, complete view, requests, bytes, memory; then frames of a flight over the city.
// Environment: SVT_LATENCY (ms, 50), SVT_MBITS (20).
import { basename } from "node:path";
import { browse, svtServe } from "../e2e/harness.mjs";

const latency = Number(process.env.SVT_LATENCY ?? 50),
  megabits = Number(process.env.SVT_MBITS ?? 20);
const kFlight = 12_000;

const fly = (page) =>
  page.evaluate(async (duration) => {
    const s = document.querySelector("svt-app").session;
    const [w, d] = s.volume.info.size;
    // From above one corner down to 60 m over the roofs, then across the city.
    const before = { ...s.model.city.files.traffic };
    const drawn = [];
    let last = s.picture.report,
      heap = 0,
      stepped = performance.now(),
      slowest = 0;
    const start = performance.now();
    for (let now = start; now - start < duration; now = performance.now()) {
      slowest = Math.max(slowest, now - stepped);
      stepped = now;
      const share = (now - start) / duration;
      const height = 60 + 600 * Math.max(0, 1 - 3 * share);
      /** @type {import("../src/engine").Point} */
      const eye = [w * (0.2 + 0.6 * share), d * (0.3 + 0.4 * share), height];
      s.view.turn({ ...s.view.state.camera, eye, target: [eye[0] + 300, eye[1] + 220, Math.max(5, height - 150)] });
      await new Promise(requestAnimationFrame);
      if (s.picture.report !== last) drawn.push(performance.now());
      last = s.picture.report;
      heap = Math.max(heap, s.model.city.look.heap);
    }
    const gaps = drawn
      .slice(1)
      .map((at, n) => at - drawn[n])
      .sort((a, b) => a - b);
    const { requests, bytes } = s.model.city.files.traffic;
    return {
      frames: drawn.length,
      median: gaps[gaps.length >> 1],
      p95: gaps[Math.floor(gaps.length * 0.95)],
      longest: gaps.at(-1),
      slowest,
      heap,
      requests: requests - before.requests,
      bytes: bytes - before.bytes,
      size: [last.width, last.height],
    };
  }, kFlight);

async function measure(city) {
  const server = await svtServe(city);
  const { context, close } = await browse({ viewport: { width: 1280, height: 720 }, locale: "en-US" });
  const page = await context.newPage();
  // The page itself is in the browser's cache, as of a second visit; the city never is.
  await page.goto(`${server.url}`);
  await page.waitForFunction(() => performance.getEntriesByName("svt-first-image").length > 0, null, { timeout: 120_000 });
  const client = await context.newCDPSession(page);
  await client.send("Network.enable");
  await client.send("Network.emulateNetworkConditions", {
    offline: false,
    latency,
    downloadThroughput: (megabits * 1e6) / 8,
    uploadThroughput: (megabits * 1e6) / 8,
  });
  await page.reload();
  await page.waitForFunction(() => performance.getEntriesByName("svt-first-image").length > 0, null, { timeout: 120_000 });
  const atFirst = await page.evaluate(() => {
    const ms = performance.getEntriesByName("svt-first-image")[0].startTime;
    const all = /** @type {PerformanceResourceTiming[]} */ (performance.getEntriesByType("resource"));
    const before = all.filter(({ name, responseEnd }) => /city\.json|\.bin$|\.svtp$/.test(name) && responseEnd > 0 && responseEnd <= ms);
    return { ms, requests: before.length, bytes: before.reduce((sum, { encodedBodySize }) => sum + encodedBodySize, 0) };
  });
  const isComplete = () => document.querySelector("svt-app").session.model.city.isComplete;
  await page.waitForFunction(isComplete, null, { timeout: 300_000, polling: 20 });
  const atEnd = await page.evaluate(() => {
    const { files, look } = document.querySelector("svt-app").session.model.city;
    return { ms: performance.now(), ...files.traffic, look: { ...look, info: null } };
  });
  await page.waitForTimeout(4_000);
  const flight = await fly(page);
  await page.waitForFunction(isComplete, null, { timeout: 300_000, polling: 50 });
  const after = await page.evaluate(() => ({ ...document.querySelector("svt-app").session.model.city.look, info: null }));
  const buildings = await page.evaluate(() => document.querySelector("svt-app").session.volume.info.buildings);
  // The same flight over what is here: what drawing alone costs.
  await page.evaluate(() => document.querySelector("svt-app").session.model.city.end());
  const fixed = await fly(page);
  await close();
  await server.close();
  return { fixed, name: basename(city), buildings, atFirst, atEnd, flight, after };
}

const kB = (bytes) => `${Math.round(bytes / 1000)} kB`,
  s = (ms) => `${(ms / 1000).toFixed(1)} s`,
  mb = (bytes) => `${Math.round(bytes / 1e6)} MB`;
const rows = [];
for (const city of process.argv.slice(2)) rows.push(await measure(city));
console.log(
  `Chromium, 1280 x 720, ${latency} ms and ${megabits} Mbit/s simulated, \`svt serve\` on the same machine; the page itself as of a second visit.\n`,
);
console.log("| buildings | first picture | complete view | tiles, details | memory of a worker |\n|---|---|---|---|---|");
for (const { buildings, atFirst, atEnd } of rows)
  console.log(
    `| ${buildings.toLocaleString("en")} | ${s(atFirst.ms)}, ${atFirst.requests} requests, ${kB(atFirst.bytes)} | ${s(atEnd.ms)}, ${atEnd.requests} requests, ${kB(atEnd.bytes)} | ${atEnd.look.tiles} of ${atEnd.look.coarsest} to ${atEnd.look.finest}, ${atEnd.look.pixels.toFixed(1)} pixels | ${mb(atEnd.look.heap)} |`,
  );
console.log(
  "\n| buildings | frames in 12 s of flight; without streaming | between two: median, 95 %, longest; without | longest wait of the page | requests, bytes | memory of a worker | where it ends |\n|---|---|---|---|---|---|---|",
);
const gaps = (f) => `${f.median?.toFixed(0)}, ${f.p95?.toFixed(0)}, ${f.longest?.toFixed(0)}`;
for (const { buildings, flight: f, fixed, after } of rows)
  console.log(
    `| ${buildings.toLocaleString("en")} | ${f.frames} of ${f.size.join(" x ")}; ${fixed.frames} | ${gaps(f)} ms; ${gaps(fixed)} ms | ${f.slowest.toFixed(0)} ms | ${f.requests}, ${kB(f.bytes)} | ${mb(Math.max(f.heap, after.heap))} | ${after.tiles} tiles of details ${after.coarsest} to ${after.finest}, ${kB(after.bytes)}, ${after.pixels.toFixed(1)} pixels |`,
  );
