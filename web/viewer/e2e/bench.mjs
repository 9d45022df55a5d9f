// Times of the page in the browser that is here: `npm run bench`. Needs `make viewer`; a machine that does nothing else.
// Prints a table in Markdown, or with --json one object for scripts/bench.py: first image after navigation, frames while the view turns, still pictures, by kind of engine.
// Environment: SVT_BENCH_HEADED=1 shows the browser and leaves its graphics driver as it is, for machines with a graphics card.
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { browse, dataDir, svt, svtServe } from "./harness.mjs";

const kRounds = 5;
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

const fine = (page) =>
  page.waitForFunction(() => document.querySelector("svt-app").session.quality === "fine", null, { timeout: 120_000 });

/** First images: in a browser that has not seen the page (timed from outside, and its finest picture too), and loaded again. */
async function starts() {
  const cold = [], finest = [], warm = [];
  for (let n = 0; n < kRounds; ++n) {
    const { context, close } = await browse(shape);
    const page = await context.newPage();
    await page.waitForTimeout(3_000);  // a browser that has started, and has never seen the page
    const begin = performance.now();
    await page.goto(server.url, { waitUntil: "commit" });
    await firstImage(page);
    cold.push(performance.now() - begin);
    await fine(page);
    finest.push(performance.now() - begin);
    await page.reload();
    warm.push(await firstImage(page));
    await close();
  }
  return { cold: median(cold), finest: median(finest), warm: median(warm) };
}

/** Frames by one kind of engine; null where it does not draw here. */
async function frames(kind) {
  const { context, close } = await browse(shape);
  const page = await context.newPage();
  await page.goto(`${server.url}?engine=${kind}`);
  await firstImage(page);
  await fine(page);
  const found = await page.evaluate(async () => {
    const s = document.querySelector("svt-app").session;
    const { engine, milliseconds: still } = s.report;
    const times = [];
    const start = performance.now();
    let last = s.report, angle = 0;
    while (performance.now() - start < 6_000) {
      const { camera } = s.state, [x, y] = [camera.eye[0] - camera.target[0], camera.eye[1] - camera.target[1]];
      angle = 0.02;
      s.turn({ ...camera, eye: [camera.target[0] + x * Math.cos(angle) - y * Math.sin(angle), camera.target[1] + x * Math.sin(angle) + y * Math.cos(angle), camera.eye[2]] });
      await new Promise(requestAnimationFrame);
      if (s.report !== last) times.push(performance.now());
      last = s.report;
    }
    const fps = times.length < 2 ? 0 : ((times.length - 1) * 1000) / (times.at(-1) - times[0]);
    const context = new OffscreenCanvas(1, 1).getContext("webgl2");
    const info = context?.getExtension("WEBGL_debug_renderer_info");
    return {
      engine, still, fps, byCpu: last.engine === "cpu", moving: [last.width, last.height], size: s.pictureSize,
      driver: info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : "none",
    };
  });
  await close();
  return found.engine === kind ? found : null;
}

/** What scripts/bench.py reads: seconds, frames a second, and how much of the picture's width is cast while it turns. */
function figures({ cold, finest, warm }, cpu, webgl2) {
  return {
    first_image_s: cold / 1e3, finest_s: finest / 1e3, again_s: warm / 1e3, turning_fps: cpu.fps,
    turning_share: cpu.moving[0] / cpu.size[0], still_s: cpu.still / 1e3, ...(webgl2 ? { still_webgl2_s: webgl2.still / 1e3 } : {}),
  };
}

function table({ cold, finest, warm }, engines) {
  console.log(`${name}, page of 1280 x 720, \`svt serve\` on the same machine.\n`);
  console.log(`First image after navigation, median of ${kRounds}: ${ms(cold)} in a browser that has not seen the page, finest after ${ms(finest)}; ${ms(warm)} loaded again.\n`);
  console.log("| engine | driver | turning: frames a second | of pixels | still, 4 rays a pixel |\n| --- | --- | --- | --- | --- |");
  for (const [kind, found] of Object.entries(engines)) {
    if (!found) console.log(`| ${kind} | does not draw here | - | - | - |`);
    else console.log(`| ${kind} | ${kind === "cpu" ? "-" : found.driver} | ${found.fps.toFixed(1)}${kind !== "cpu" && found.byCpu ? " (coarse, by the CPU)" : ""} | ${found.moving.join(" x ")} | ${found.size.join(" x ")} in ${ms(found.still)} |`);
  }
}

const first = await starts(), engines = { cpu: await frames("cpu"), webgl2: await frames("webgl2") };
if (process.argv.includes("--json")) console.log(JSON.stringify(figures(first, engines.cpu, engines.webgl2)));
else table(first, engines);
await server.close();
rmSync(folder, { recursive: true, force: true });
