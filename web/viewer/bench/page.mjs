// Times of the page in the browser that is here: `npm run bench`. Needs `make viewer`; a machine that does nothing else.
// Prints tables in Markdown: first and finest image after navigation, frames while the view turns, still pictures, by kind of
// engine, with and without threads in turns; with --json one object for scripts/bench.py. SVT_BENCH_PAGE=FOLDER: another built page, in turns with this one.
// Environment: SVT_BENCH_HEADED=1 shows the browser and leaves its graphics driver as it is, for machines with a graphics card.
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { browse, dataDir, svt, svtServe } from "../e2e/harness.mjs";

const kRounds = Number(process.env.SVT_BENCH_ROUNDS ?? 5);
const folder = mkdtempSync(join(tmpdir(), "svt-viewer-bench-"));
const fzk = join(dataDir, "fzk_haus_citygml3.gml");
const volume = join(folder, "house.svt");
let name = "FZK-Haus, 800 x 700 x 400";
if (existsSync(fzk)) {
  svt("build", fzk, "-o", volume, "--dimension", "800,700,400", "--vectors", "edges");
} else {
  name = "sample house at 0.02 m";
  svt("sample", "house", "-o", join(folder, "house.gml"));
  svt("build", join(folder, "house.gml"), "-o", volume, "--spacing", "0.02", "--vectors", "edges");
}
const server = await svtServe(volume);
const headed = process.env.SVT_BENCH_HEADED === "1";
const shape = { viewport: { width: 1280, height: 720 }, ...(headed ? { headless: false, args: ["--no-sandbox"] } : {}) };
const median = (numbers) => [...numbers].sort((a, b) => a - b)[numbers.length >> 1];
const ms = (number) => `${Math.round(number)} ms`;

const firstImage = async (page) => {
  await page.waitForFunction(() => performance.getEntriesByName("svt-first-image").length > 0, null, { timeout: 60_000 });
  return page.evaluate(() => performance.getEntriesByName("svt-first-image")[0].startTime);
};

/** The finest picture of the whole building stands, by the page's clock. */
const finest = async (page) => {
  await page.waitForFunction(() => document.querySelector("svt-app").session.picture.quality === "fine", null, {
    timeout: 60_000,
    polling: 20,
  });
  return page.evaluate(() => performance.now());
};

/** First and finest images in a browser that has not seen the page, by its clock and from outside; first when loaded again. */
async function start(url, into) {
  const { context, close } = await browse(shape);
  const page = await context.newPage();
  await page.waitForTimeout(1_500); // a browser that has started, and has never seen the page
  const begin = performance.now();
  await page.goto(url, { waitUntil: "commit" });
  const cold = await firstImage(page),
    outside = performance.now() - begin;
  const fine = await finest(page),
    fineOutside = performance.now() - begin;
  await page.reload();
  const warm = await firstImage(page);
  for (const [name, value] of Object.entries({ cold, outside, fine, fineOutside, warm })) (into[name] ??= []).push(value);
  await close();
}

/** Frames by one kind of engine; null where it does not draw here. */
async function frames(url, kind) {
  const { context, close } = await browse(shape);
  const page = await context.newPage();
  await page.goto(url);
  await firstImage(page);
  await page.waitForFunction(() => document.querySelector("svt-app").session.picture.quality === "fine", null, { timeout: 120_000 });
  const found = await page.evaluate(async () => {
    const s = document.querySelector("svt-app").session;
    const { engine, milliseconds: still } = s.picture.report,
      threads = s.volume.engine.threads ?? 1;
    const times = [];
    const start = performance.now();
    let last = s.picture.report,
      angle = 0;
    while (performance.now() - start < 6_000) {
      const { camera } = s.view.state,
        [x, y] = [camera.eye[0] - camera.target[0], camera.eye[1] - camera.target[1]];
      angle = 0.02;
      s.view.turn({
        ...camera,
        eye: [
          camera.target[0] + x * Math.cos(angle) - y * Math.sin(angle),
          camera.target[1] + x * Math.sin(angle) + y * Math.cos(angle),
          camera.eye[2],
        ],
      });
      await new Promise(requestAnimationFrame);
      if (s.picture.report !== last) times.push(performance.now());
      last = s.picture.report;
    }
    const fps = times.length < 2 ? 0 : ((times.length - 1) * 1000) / (times.at(-1) - times[0]);
    const context = new OffscreenCanvas(1, 1).getContext("webgl2");
    const info = context?.getExtension("WEBGL_debug_renderer_info");
    return {
      engine,
      threads,
      still,
      fps,
      byCpu: last.engine === "cpu",
      moving: [last.width, last.height],
      size: s.view.size,
      driver: info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : "none",
    };
  });
  await close();
  return found.engine === kind ? found : null;
}

const other = process.env.SVT_BENCH_PAGE ? await svtServe(volume, "--viewer", process.env.SVT_BENCH_PAGE) : null;
const kinds = [
  ["threads", `${server.url}?engine=cpu`, "cpu"],
  ["one thread", `${server.url}?engine=cpu&threads=no`, "cpu"],
  ...(other ? [["other page", `${other.url}?engine=cpu`, "cpu"]] : []),
];
/** @type {Record<string, number[]>[]} */
const times = kinds.map(() => ({}));
for (let n = 0; n < kRounds; ++n) for (const [i, [, url]] of kinds.entries()) await start(url, times[i]);
if (process.env.SVT_BENCH_GL !== "0") kinds.push(["webgl2", `${server.url}?engine=webgl2`, "webgl2"]);
const engines = [];
for (const [label, url, kind] of kinds) engines.push([label, kind, await frames(url, kind)]);

/** What scripts/bench.py reads, of the page as it is served: seconds, frames a second, and how much of the picture's width is cast while it turns. */
function figures() {
  const cpu = engines[0][2],
    webgl2 = engines.find(([label]) => label === "webgl2")?.[2];
  return {
    first_image_s: median(times[0].outside) / 1e3,
    finest_s: median(times[0].fineOutside) / 1e3,
    again_s: median(times[0].warm) / 1e3,
    turning_fps: cpu.fps,
    turning_share: cpu.moving[0] / cpu.size[0],
    still_s: cpu.still / 1e3,
    ...(webgl2 ? { still_webgl2_s: webgl2.still / 1e3 } : {}),
  };
}

function table() {
  console.log(`${name}, page of 1280 x 720, \`svt serve\` on the same machine; medians of ${kRounds}, in turns.\n`);
  console.log(
    "| CPU caster | first image, unseen browser | from outside | finest | from outside | first image, loaded again |\n| --- | --- | --- | --- | --- | --- |",
  );
  for (const [i, taken] of times.entries())
    console.log(
      `| ${kinds[i][0]} | ${["cold", "outside", "fine", "fineOutside", "warm"].map((of) => ms(median(taken[of]))).join(" | ")} |`,
    );
  console.log("\n| engine | driver | turning: frames a second | of pixels | still, 4 rays a pixel |\n| --- | --- | --- | --- | --- |");
  for (const [label, kind, found] of engines) {
    if (!found) console.log(`| ${label} | does not draw here | - | - | - |`);
    else
      console.log(
        `| ${label}${kind === "cpu" ? ` (${found.threads})` : ""} | ${kind === "cpu" ? "-" : found.driver} | ${found.fps.toFixed(1)}${kind !== "cpu" && found.byCpu ? " (coarse, by the CPU)" : ""} | ${found.moving.join(" x ")} | ${found.size.join(" x ")} in ${ms(found.still)} |`,
      );
  }
}

if (process.argv.includes("--json")) console.log(JSON.stringify(figures()));
else table();
await other?.close();
await server.close();
rmSync(folder, { recursive: true, force: true });
