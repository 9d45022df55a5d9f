// Times of the ten tasks of e2e/tasks.test.mjs, and of actions on many objects: node bench/tasks.mjs VOLUME|CITY...
// Needs `make viewer`; a machine that does nothing else. Prints tables in Markdown: the time until the page has answered,
// and until the picture shows it. SVT_SHOTS=FOLDER keeps a picture of the page after each task.
import { mkdirSync } from "node:fs";
import { basename, join } from "node:path";
import { browse, svtServe } from "../e2e/harness.mjs";

const kLimit = 60_000; // of a task
const kFolder = process.env.SVT_SHOTS ?? "";

/** A page with a model or a city, and what the tasks do with it. */
class Bench {
  /** @type {[string, string, string][]} */
  rows = [];
  /** @type {any} */
  first = null; // the view with which the page begins

  constructor(page) {
    this.page = page;
    this.button = (name) => page.getByRole("button", { name });
    this.found = page.getByRole("treeitem");
  }
  /** In the page, with its session as `s`. */
  inPage = (body, value) =>
    this.page.evaluate(
      ([text, v]) => new Function("s", "v", `return (async () => (${text}))()`)(document.querySelector("svt-app").session, v),
      [body, value],
    );
  /** Waits until an expression of the session `s` holds. */
  until = async (body) => {
    for (const end = Date.now() + kLimit; !(await this.inPage(`Boolean(${body})`)); await this.page.waitForTimeout(5))
      if (Date.now() > end) throw new Error(`does not hold: ${body}`);
  };
  isDrawn = () => this.until("['moving', 'full', 'fine'].includes(s.picture.quality)");
  isFinest = () => this.until("s.picture.quality === 'fine'");

  /** Times a task: `answered` ends when the page shows the answer beside the picture. */
  time = async (name, act, undo = async () => {}) => {
    const s = (ms) => (ms / 1000).toFixed(2);
    try {
      await this.isFinest();
      const begin = performance.now();
      await act();
      const answered = performance.now();
      await this.isDrawn();
      this.rows.push([name, s(answered - begin), s(performance.now() - begin)]);
      await this.isFinest();
      if (kFolder) await this.page.screenshot({ path: join(kFolder, `${name.replaceAll(" ", "-")}.png`) });
    } catch (error) {
      this.rows.push([
        name,
        `no: ${String(/** @type {any} */ (error).message)
          .split("\n")[0]
          .slice(0, 80)}`,
        "",
      ]);
    }
    const message = await this.inPage("s.messages.message?.text ?? ''");
    if (message) this.rows.push([name, message, "a message"]);
    await this.inPage(
      "(s.messages.message = null, s.view.endWalking(), s.selection.select([]), Object.assign(s.view, { tool: null, aim: null }))",
    );
    await undo();
    await this.inPage("(s.view.set(v), s.view.fit(s.view.aspect))", this.first).catch(() => {});
  };
  find = async (words) => {
    await this.page.fill("#search", words);
    await this.found.first().waitFor();
  };
  clickPicture = async (x, y, options = {}) => {
    const box = await this.page.locator("svt-picture").boundingBox();
    await this.page.mouse.click(box.x + box.width * x, box.y + box.height * y, options);
  };

  /** The tasks of models and of cities. Each argument is words that find objects. */
  tasksOfAll = async (component, alike) => {
    const { page } = this;
    const forget = () => page.fill("#search", "");
    await this.time(
      "compare two objects",
      async () => {
        await this.find(alike);
        await this.found.nth(0).click();
        await this.found.nth(1).click({ modifiers: ["Control"] });
        await page.locator("#comparison").waitFor();
      },
      forget,
    );
    await this.time("hide by the context menu", async () => {
      await this.clickPicture(0.5, 0.5, { button: "right" });
      await page.getByRole("menuitem", { name: "Hide" }).click();
      await this.until("s.view.state.hide.length > 0");
    });
    await this.time("look through a lens", async () => {
      await page.click("#tool-lens");
      await this.until("s.view.state.effect === 'lens'");
    });
    await this.time("three views as BCF", async () => {
      await page.click("#tool-share");
      for (let n = 1; n <= 3; ++n) {
        await page.click("#keep-view");
        await page
          .locator("svt-bookmark-list li")
          .nth(n - 1)
          .waitFor();
      }
      const saved = page.waitForEvent("download");
      await page.click("#export-bcf");
      await saved;
    });
    await this.time(
      "highlight an object",
      async () => {
        await this.find(component);
        await this.found.first().click();
        await this.button("Highlight").click();
        await this.until("s.view.state.effect === 'highlight'");
      },
      forget,
    );
  };

  /** The tasks that need one building, rooms or storeys. */
  tasksOfModels = async (component) => {
    const { page } = this;
    await this.time(
      "find a component, cut to it",
      async () => {
        await this.find(component);
        await this.found.first().click();
        await this.button("Cut away to it").click();
        await this.until("s.view.state.effect === 'cutaway'");
      },
      () => page.fill("#search", ""),
    );
    await this.time("colour rooms by area", async () => {
      await page.click("#tool-look");
      await page.selectOption("#color-by", "area");
      await this.until("s.view.state.colorBy === 'area'");
    });
    await this.time("cut a storey, measure in its plan", async () => {
      await page.click("#tool-section");
      await page
        .getByRole("button", { name: /^Cut .* m$/ })
        .first()
        .click();
      await page.locator('svt-view-cube path[data-direction="0,0,1"]').click();
      await page.click("#tool-measure");
      await this.isDrawn();
      await this.clickPicture(0.4, 0.4);
      await this.until("s.view.state.measured.length === 1");
      await this.clickPicture(0.6, 0.4);
      await this.until("s.view.state.measured.length === 2");
    });
    await this.time("walk", async () => {
      await page.click("#tool-views");
      await page.click("#walk");
      await this.until("s.view.state.camera.fieldOfView === 65");
      const eye = await this.inPage("s.view.state.camera.eye");
      await page.keyboard.down("w");
      await this.until(`s.view.state.camera.eye.join() !== '${eye.join()}'`);
      await page.keyboard.up("w");
    });
    await this.time("plans on sheets as PDF", async () => {
      await page.evaluate(() => {
        window.print = () => void (globalThis.printed = true);
      });
      await page.click("#tool-section");
      await page.click("#print-sheets");
      await page.waitForFunction(() => globalThis.printed, null, { timeout: kLimit });
    });
  };

  /** Actions on many objects, as buttons and menus call them. */
  manyObjects = async () => {
    const counts = await this.inPage(
      "Object.entries(s.volume.index.features.reduce((c, f) => ((c[f.class] = (c[f.class] ?? 0) + 1), c), {})).sort((a, b) => b[1] - a[1])",
    );
    const [[name, count]] = counts;
    const select = `s.selection.selectByQuery('class=${name}')`;
    const shown = "document.querySelector('svt-app').updateComplete";
    const onSelected = async (task, action) => {
      await this.inPage(select);
      await this.time(`${task} ${count} ${name}`, () => this.inPage(`(${action}, ${shown})`));
    };
    await this.time(`select ${count} ${name}`, () => this.inPage(`(${select}, ${shown})`));
    await onSelected("hide", "s.view.hideSelected(true)");
    await onSelected("show only", "s.view.showOnlySelected()");
    const third = "s.selection.select(s.volume.index.features.filter((_, i) => i % 3 === 0).map((f) => f.id))";
    const thirds = await this.inPage("Math.ceil(s.volume.index.features.length / 3)");
    await this.time(`select every third, ${thirds}`, () => this.inPage(`(${third}, ${shown})`));
    await this.inPage(third);
    await this.time(`hide every third, ${thirds}`, () => this.inPage(`(s.view.hideSelected(true), ${shown})`));
  };

  /** Frames per second while the view turns, and the share of the width that they have. */
  turning = () =>
    this.page.evaluate(async () => {
      const s = document.querySelector("svt-app").session;
      const times = [];
      let last = s.picture.report;
      for (const end = performance.now() + 5000; performance.now() < end; await new Promise(requestAnimationFrame)) {
        const { camera } = s.view.state,
          [x, y] = [camera.eye[0] - camera.target[0], camera.eye[1] - camera.target[1]],
          [c, d] = [Math.cos(0.02), Math.sin(0.02)];
        s.view.turn({ ...camera, eye: [camera.target[0] + x * c - y * d, camera.target[1] + x * d + y * c, camera.eye[2]] });
        if (s.picture.report !== last) times.push(performance.now());
        last = s.picture.report;
      }
      return { rate: ((times.length - 1) * 1000) / (times.at(-1) - times[0]), share: last.width / s.view.size[0] };
    });
}

async function measure(path) {
  const server = await svtServe(path);
  const { context, close } = await browse({ viewport: { width: 1280, height: 720 }, locale: "en-US", reducedMotion: "reduce" });
  const page = await context.newPage();
  page.setDefaultTimeout(kLimit);
  const begin = performance.now();
  await page.goto(server.url);
  await page.waitForFunction(() => performance.getEntriesByName("svt-first-image").length > 0, null, { timeout: 600_000 });
  const first = performance.now() - begin;
  const bench = new Bench(page);
  await bench.isFinest();
  const finest = performance.now() - begin;
  await page.waitForFunction(() => document.querySelector("svt-app").session.model.city?.isComplete !== false, null, { timeout: 600_000 });
  bench.first = await bench.inPage("s.view.state");
  const features = await bench.inPage("s.volume.index.features.map((f) => f.class)");
  const has = (name) => features.includes(name);
  const component = has("BuildingConstructiveElement") ? "BuildingConstructiveElement" : "Building";
  const alike = ["BuildingUnit", "BuildingRoom"].find(has) ?? "Building";
  await bench.tasksOfAll(component, alike);
  const isCity = await bench.inPage("Boolean(s.model.city)");
  if (!isCity) await bench.tasksOfModels(component);
  await bench.manyObjects();
  const { rate, share } = await bench.turning();
  await close();
  await server.close();
  console.log(
    `\n${basename(path)}: ${features.length.toLocaleString("en")} features in the tree. First picture after ${(first / 1000).toFixed(1)} s, finest ` +
      `after ${(finest / 1000).toFixed(1)} s, ${rate.toFixed(1)} frames a second of ${share.toFixed(2)} of the width while turning.\n`,
  );
  console.log("| task | answer, s | picture, s |\n|---|---|---|");
  for (const row of bench.rows) console.log(`| ${row.join(" | ")} |`);
}

if (kFolder) mkdirSync(kFolder, { recursive: true });
for (const path of process.argv.slice(2)) await measure(path);
