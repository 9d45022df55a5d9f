// How a visit begins: what is loaded, when the picture stands, from folders and from `svt serve`.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { page as pageFolder, repository, serve, svtServe } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open, address } = withHouse("start");
const { inPage, state, settled, firstImage, stage, eventually, drop } = visit;

describe("start", () => {
  it("keeps the budget of bytes", (t) => {
    // Without the font, which is fetched when names are drawn first.
    const files = readdirSync(join(pageFolder, "assets"))
      .filter((name) => !name.endsWith(".ttf"))
      .map((name) => ({ name, size: gzipSync(readFileSync(join(pageFolder, "assets", name)), { level: 9 }).length }));
    const sum = (is) => files.filter(({ name }) => is.test(name)).reduce((all, { size }) => all + size, 0);
    const own = sum(/^(?!svt[-_]|worker)/),
      worker = sum(/^worker/);
    // A visit begins with one of two modules, and loads one of two others later.
    const views = [sum(/^svt_view-/), sum(/^svt_view_threads/)],
      wholes = [sum(/^svt-/), sum(/^svt_threads/)];
    const first = own + worker + Math.max(...views);
    t.diagnostic(`own ${own}, worker ${worker}, modules ${views} and ${wholes} bytes, compressed`);
    assert.ok(own <= 300_000, `own scripts and styles: ${own} bytes compressed, at most 300000`);
    assert.ok(first <= 1_200_000, `the start of a visit: ${first} bytes compressed, at most 1200000`);
    assert.ok(Math.max(...wholes) <= 1_750_000, `the whole module: ${wholes} bytes compressed, at most 1750000`);
  });

  it("says what of others it holds, with versions", () => {
    const { bomFormat, components } = JSON.parse(readFileSync(join(pageFolder, "sbom.cdx.json"), "utf8"));
    assert.equal(bomFormat, "CycloneDX");
    const listed = Object.fromEntries(components.map(({ name, version }) => [name, version]));
    for (const name of ["lit", "lit-html", "@awesome.me/webawesome", "@preact/signals-core"]) {
      const manifest = join(repository, "web/viewer/node_modules", name, "package.json");
      assert.equal(listed[name], JSON.parse(readFileSync(manifest, "utf8")).version, name);
    }
    for (const name of [
      "zlib",
      "libzstd",
      "libpng1.6",
      "pugixml",
      "simdjson",
      "highway",
      "freetype",
      "libglu",
      "fmtlib",
      "fonts-dejavu",
      "emscripten",
    ])
      assert.match(listed[name] ?? "none", /^\d/, name);
    assert.ok(!("vite" in listed) && !("cli11" in listed), "only what is in the page");
  });

  it("has the picture where it stays, before splitters and sliders have come", async () => {
    for (const [width, height] of [
      [900, 600],
      [1200, 640],
      [2800, 1400],
    ]) {
      await open("?model=house", { viewport: { width, height } });
      let release = () => {};
      const held = new Promise((done) => (release = () => done(null)));
      await visit.page.route(/components-.*\.js$/, async (route) => (await held, route.continue()));
      await visit.page.reload();
      await firstImage();
      const early = await stage();
      assert.equal(await visit.page.evaluate(() => Boolean(customElements.get("wa-split-panel"))), false);
      assert.equal(await visit.page.locator("svt-help dl").isVisible(), false);
      release();
      await visit.page.waitForFunction(() => customElements.get("wa-split-panel"));
      await settled();
      const late = await stage();
      for (const side of ["x", "y", "width", "height"])
        assert.ok(Math.abs(early[side] - late[side]) < 0.6, `at ${width}, ${side}: ${early[side]}, then ${late[side]}`);
    }
  });

  it("shifts nothing while it begins", async () => {
    for (const viewport of [
      { width: 1280, height: 800 },
      { width: 900, height: 600 },
      { width: 390, height: 844 },
    ]) {
      await visit.begin({ viewport });
      await visit.page.addInitScript(() => {
        globalThis.shifts = 0;
        new PerformanceObserver((list) => {
          for (const entry of /** @type {any[]} */ (list.getEntries())) if (!entry.hadRecentInput) globalThis.shifts += entry.value;
        }).observe({ type: "layout-shift", buffered: true });
      });
      await visit.page.goto(address());
      await firstImage();
      await visit.page.waitForFunction(() => customElements.get("wa-split-panel") && customElements.get("svt-view-cube"));
      await settled();
      const shifts = await visit.page.evaluate(() => globalThis.shifts);
      assert.ok(shifts <= 0.05, `at ${viewport.width} px, parts move by ${shifts}`);
    }
  });

  it("without a model invites to open one, and takes a dropped file", async () => {
    await open();
    const empty = await serve();
    await visit.page.goto(empty.url);
    await visit.page.getByRole("heading", { name: "Drop a building here" }).waitFor();
    await drop("house.svt", readFileSync(at("house.svt")));
    await firstImage();
    assert.equal(await inPage("s.volume.info.name"), "Sample house");
    await empty.close();
  });
});

describe("served by svt serve", () => {
  let site;
  before(async () => (site = await svtServe(at("house.svt"))));
  after(() => site?.close());

  it("opens, within its policy", async () => {
    await open();
    visit.problems.length = 0;
    await visit.page.goto(site.url);
    await firstImage();
    await settled();
    assert.equal(await inPage("s.volume.info.name"), "Sample house");
    assert.deepEqual(visit.problems, []);
  });

  it("shows the server's pictures where the library cannot run", async () => {
    await visit.page.context().route("**/*.wasm", (route) => route.abort());
    await visit.page.goto("about:blank");
    await visit.page.goto(site.url);
    await firstImage();
    await visit.page.getByText("Pictures come from the server").waitFor();
    await visit.page.keyboard.press("2");
    await eventually(async () => assert.equal((await state()).preset, "front"));
    await settled();
  });
});
