// How a visit begins: what is loaded, when the picture stands, from folders and from `svt serve`.
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { after, afterEach, before, beforeEach, describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { kTypes, page as pageFolder, repository, serve, svt, svtServe } from "./harness.mjs";
import { withHouse } from "./visit.mjs";

const { at, visit, open, address } = withHouse("start");
const { inPage, state, settled, firstImage, stage, eventually, drop } = visit;

const axe = readFileSync(join(repository, "web/viewer/node_modules/axe-core/axe.min.js"), "utf8");

/** Scripts that are fetched when they are first used, or after the first fine picture. */
const kOnRequest =
  /^(basemap_choice|bcf|city_search|class_terms|feature_groups|field_choice|probe|color_legend|late|section_panes|object_table|command_palette|context_menu|help_dialog|aim_layer|details|late_texts|picture_keys|walk_pad|print_sheets|changes_panel|quantities_panel|reports_module|table_rows|reports_worker|svt_reports|engine_server)-/;

describe("start", () => {
  it("keeps the budget of bytes", (t) => {
    // Without the font, which is fetched when names are drawn first.
    const files = readdirSync(join(pageFolder, "assets"))
      .filter((name) => !name.endsWith(".ttf") && !kOnRequest.test(name))
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
    // It also reads models, makes drawings and sheets, and shows fields. It comes after the first fine picture.
    assert.ok(Math.max(...wholes) <= 1_850_000, `the whole module: ${wholes} bytes compressed, at most 1850000`);
  });

  it("keeps the budget of bytes of comparisons and quantities, which no visit begins with", (t) => {
    const files = readdirSync(join(pageFolder, "assets")).filter((name) =>
      /^(changes_panel|quantities_panel|reports_module|reports_worker|svt_reports)-/.test(name),
    );
    assert.equal(files.length, 5, files.join());
    const bytes = files.reduce((sum, name) => sum + gzipSync(readFileSync(join(pageFolder, "assets", name)), { level: 9 }).length, 0);
    t.diagnostic(`${bytes} bytes, compressed`);
    // Both read models themselves, so one module has both.
    assert.ok(bytes <= 1_200_000, `the reports: ${bytes} bytes compressed, at most 1200000`);
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
      // Further scripts follow the first fine picture, so that the page then needs no connection.
      const fetched = await visit.page.evaluate(() => {
        const resources = performance.getEntriesByType("resource");
        const late = resources.find(({ name }) => /\/late-[^/]*$/.test(name))?.startTime ?? Infinity;
        const before = resources.filter(({ startTime }) => startTime < late);
        return before.map(({ name }) => name.slice(name.lastIndexOf("/") + 1));
      });
      assert.ok(
        fetched.some((name) => /^components-/.test(name)),
        "scripts are listed",
      );
      assert.deepEqual(
        fetched.filter((name) => kOnRequest.test(name)),
        [],
      );
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

describe("A published page", () => {
  const name = "preview-test";
  let site, holds, gates;

  /** @type {(name: string, bytes: Buffer) => import("node:http").OutgoingHttpHeaders} */
  const withLength = (_name, bytes) => ({ "Content-Length": bytes.length });

  /** Serves a folder; files whose names match `holds` come in half, until the gates open. */
  function serveFolder(folder, headers = withLength) {
    const server = createServer(async (request, response) => {
      const file = decodeURIComponent(new URL(request.url, "http://x").pathname).slice(1) || "index.html";
      const path = join(folder, file);
      if (!existsSync(path) || !statSync(path).isFile()) return response.writeHead(404).end();
      const bytes = readFileSync(path);
      response.writeHead(200, { "Content-Type": kTypes[extname(file)] ?? "application/octet-stream", ...headers(file, bytes) });
      if (!holds.test(file)) return response.end(bytes);
      response.write(bytes.subarray(0, bytes.length >> 1));
      await new Promise((done) => gates.push(done));
      response.end(bytes.subarray(bytes.length >> 1));
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
  const kLarge = /\.(wasm|svt)$/;
  const closeGates = (names) => (holds = names);
  /** Lets through those that wait and those that still come: a page may ask for a file later than its progress shows. */
  const openGates = () => ((holds = /$^/), gates.splice(0).forEach((open) => open()));
  const bar = () => visit.page.locator("#arriving");
  const percent = () => bar().getAttribute("aria-valuenow");

  before(() => svt("publish", at("house.svt"), "-o", at(name), "--viewer", pageFolder, "--force"));
  beforeEach(() => ((gates = []), closeGates(kLarge)));
  afterEach(async () => (openGates(), await site?.close(), (site = null)));

  it("shows its picture at once, and how many per cent have come", async () => {
    site = await serveFolder(at(name));
    for (const viewport of [
      { width: 1280, height: 800 },
      { width: 390, height: 844 },
    ]) {
      closeGates(kLarge);
      await visit.begin({ viewport });
      await visit.page.addInitScript(() => {
        globalThis.shifts = 0;
        new PerformanceObserver((list) => {
          for (const entry of /** @type {any[]} */ (list.getEntries())) if (!entry.hadRecentInput) globalThis.shifts += entry.value;
        }).observe({ type: "layout-shift", buffered: true });
      });
      await visit.page.goto(site.url);
      const image = visit.page.locator("svt-app #preview");
      await image.waitFor();
      await visit.page.waitForFunction(
        () =>
          /** @type {HTMLImageElement} */ (document.querySelector("svt-app").shadowRoot.querySelector("#preview")).naturalWidth === 1200,
      );
      const [seen, whole] = [await image.boundingBox(), await stage()];
      assert.deepEqual([seen.x, seen.y, seen.width], [whole.x, whole.y, whole.width], "it fills the place of the picture");
      await eventually(async () => assert.equal(await percent(), "49"));
      assert.match(await bar().innerText(), /49%/);
      assert.equal(await visit.page.evaluate(() => document.querySelectorAll("body > #preview").length), 0);
      await visit.page.evaluate(axe);
      const { violations } = await visit.page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
      assert.deepEqual(
        violations.map(({ id, nodes }) => [id, nodes.map(({ target }) => target)]),
        [],
      );
      openGates();
      await firstImage();
      await image.waitFor({ state: "detached" });
      assert.equal(await bar().count(), 0);
      await visit.page.waitForFunction(() => customElements.get("wa-split-panel") && customElements.get("svt-view-cube"));
      await settled();
      const shifts = await visit.page.evaluate(() => globalThis.shifts);
      assert.ok(shifts <= 0.05, `at ${viewport.width} px, parts move by ${shifts}`);
      assert.deepEqual(visit.problems, []);
    }
  });

  it("is seen before its scripts run, below the bar", async () => {
    closeGates(/assets\/.*\.js$/);
    site = await serveFolder(at(name));
    await visit.begin();
    await visit.page.goto(site.url, { waitUntil: "commit" });
    const early = { x: 0, y: 49, width: 1200, height: 591 };
    // The browser shows nothing before the style sheet, but measures it.
    await visit.eventually(async () => assert.deepEqual(await visit.page.locator("body > #preview").boundingBox(), early));
    openGates();
    closeGates(kLarge);
    const image = visit.page.locator("svt-app #preview");
    await image.waitFor();
    assert.deepEqual(await image.boundingBox(), early);
    openGates();
  });

  it("counts a compressed module by its true size, and shows no per cent without the size of the volume", async () => {
    /** @type {typeof withLength} */
    const packed = (file, bytes) => (file.endsWith(".wasm") ? { "Transfer-Encoding": "chunked" } : { "Content-Length": bytes.length });
    site = await serveFolder(at(name), packed);
    await visit.begin();
    await visit.page.goto(site.url);
    await eventually(async () => assert.equal(await percent(), "49"));
    openGates();
    await firstImage();
    await site.close();
    closeGates(kLarge);
    // Neither list nor server know the size.
    site = await serveFolder(at(name), () => ({ "Transfer-Encoding": "chunked" }));
    await visit.begin();
    await visit.page.route("**/models.json", async (route) => {
      const response = await route.fetch();
      const { models } = await response.json();
      await route.fulfill({ json: { models: models.map((model) => ({ ...model, bytes: 0 })) } });
    });
    await visit.page.goto(site.url);
    await bar().waitFor();
    await visit.until("s.model.opening !== null || s.messages.progress !== null");
    assert.equal(await percent(), null);
    openGates();
    await firstImage();
    assert.equal(await bar().count(), 0);
  });

  it("begins as before without a picture, and with another model than the one in it", async () => {
    site = await serveFolder(at(name));
    await visit.begin();
    await visit.page.route("**/preview.png", (route) => route.fulfill({ status: 404, body: "" }));
    await visit.page.goto(site.url);
    await visit.page.locator("main .progress").waitFor();
    await eventually(async () => assert.equal(await visit.page.locator("svt-app #preview").count(), 0));
    openGates();
    await firstImage();
    closeGates(kLarge);
    await visit.begin();
    await visit.page.route("**/models.json", async (route) => {
      const response = await route.fetch();
      const { models } = await response.json();
      await route.fulfill({ json: { models: [{ ...models[0], name: "first" }, ...models] } });
    });
    await visit.page.goto(`${site.url}?model=house`);
    await visit.page.locator("main .progress").waitFor();
    assert.equal(await visit.page.locator("#preview").count(), 0);
    openGates();
    await firstImage();
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
