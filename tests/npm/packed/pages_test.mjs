// The web component as a guest of a page: when it loads, what it leaves behind, and what its server must allow.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { cpus } from "node:os";
import { before, describe, it } from "node:test";
import { gzipSync } from "node:zlib";
import { repository, svt } from "../../../web/viewer/e2e/harness.mjs";
import { at, eventually, kElement, makeHouse, putShared, serve, Visitor } from "./site.mjs";

const visitor = new Visitor();
const kDist = kElement.replace(/[^/]*$/, "");
const kFar = '<div style="height: 4000px"></div>';
/** The policy of the manual. */
const kPolicy =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'; style-src 'self'; img-src 'self' data:";
let site;
before(async () => {
  makeHouse();
  putShared();
  site = await serve();
});

/** Files of the package that were asked for. */
const asked = (of = site) =>
  [...new Set(of.requests.filter((path) => path.startsWith(kDist)).map((path) => path.slice(kDist.length)))].sort();

/** The whole library, and the font that it may need without a connection. */
const kForFaces = ["DejaVuSans.ttf", "svt.wasm"];

describe("loading", () => {
  it("begins with one small file, and goes on near the visible part of the page", async () => {
    site.requests.length = 0;
    await visitor.show(site, `${kFar}<svt-viewer id="a" src="house.svt"></svt-viewer>`);
    await visitor.page.waitForFunction(() => customElements.get("svt-viewer"));
    await visitor.page.waitForTimeout(500);
    assert.deepEqual(asked(), ["svt-viewer.js"]);
    assert.ok(!site.requests.includes("/house.svt"));
    await visitor.page.evaluate(() => scrollTo(0, 4000));
    await visitor.loaded("a");
    const first = ["svt-viewer.js", "svt_view.wasm", "viewing.js", "worker.js"];
    assert.deepEqual(
      asked().filter((name) => !kForFaces.includes(name)),
      first,
    );
    await eventually(async () => assert.deepEqual(asked(), [...first, ...kForFaces].sort()));
    // Limits of what a visit transfers, compressed; the manual states the sizes.
    const size = (name) => gzipSync(readFileSync(at(`${kDist}${name}`))).length;
    assert.ok(size("svt-viewer.js") < 6_000, `svt-viewer.js: ${size("svt-viewer.js")} bytes`);
    assert.ok(size("viewing.js") + size("worker.js") < 66_500, `viewing.js and worker.js: ${size("viewing.js") + size("worker.js")} bytes`);
    assert.ok(size("svt_view.wasm") < 1_100_000, `svt_view.wasm: ${size("svt_view.wasm")} bytes`);
    assert.ok(size("svt.wasm") < 1_900_000, `svt.wasm: ${size("svt.wasm")} bytes`);
  });

  it("fetches the rest of the library only if pictures may have faces", async () => {
    site.requests.length = 0;
    await visitor.show(site, `<svt-viewer id="a" src="house.svt" surfaces="voxels"></svt-viewer>`);
    await visitor.loaded("a");
    await visitor.page.waitForTimeout(2000);
    assert.deepEqual(
      asked().filter((name) => kForFaces.includes(name)),
      [],
    );
    await visitor.ask("a", "e.removeAttribute('surfaces')");
    await eventually(async () => assert.ok(kForFaces.every((name) => asked().includes(name))));
  });

  it("begins at once if the page asks for it, and not without a model", async () => {
    site.requests.length = 0;
    await visitor.show(site, `<svt-viewer id="a"></svt-viewer>${kFar}<svt-viewer id="b" loading="eager" src="house.svt"></svt-viewer>`);
    await visitor.loaded("b");
    assert.equal(await visitor.ask("a", "e.loaded"), false);
    assert.equal(visitor.page.workers().length, 1);
    await visitor.ask("a", "(e.src = 'house.svt')");
    await visitor.loaded("a");
  });

  it("shows the poster until then", async () => {
    svt("render", at("house.svt"), "-o", at("poster.png"), "--size", "320x200", "--quiet");
    await visitor.show(site, `<svt-viewer id="a" poster="poster.png" alt="The house"></svt-viewer>`);
    const poster = () =>
      visitor.page.evaluate(() => {
        const image = document.querySelector("#a").shadowRoot.querySelector("img");
        return { hidden: image.hidden, width: image.naturalWidth, alt: image.alt };
      });
    await eventually(async () => assert.deepEqual(await poster(), { hidden: false, width: 320, alt: "The house" }));
    await visitor.ask("a", "(e.src = 'house.svt')");
    await visitor.loaded("a");
    assert.equal((await poster()).hidden, true);
  });
});

describe("several elements", () => {
  const body = `<svt-viewer id="a" src="house.svt" section="z>1.6"></svt-viewer><svt-viewer id="b" src="house.gml" look="dark"></svt-viewer>`;

  it("stand side by side, and go with all that they had", async () => {
    await visitor.show(site, body);
    await visitor.loaded("a", "b");
    assert.equal(visitor.page.workers().length, 2);
    const [a, b] = await Promise.all(["a", "b"].map((id) => visitor.ask(id, "e.scene()")));
    assert.deepEqual([a.passes[0].cut, a.look, b.passes[0].cut, b.look], ["z>1.6", undefined, undefined, "dark"]);
    await visitor.ask("a", "e.remove()");
    await eventually(async () => assert.equal(visitor.page.workers().length, 1));
    assert.equal(await visitor.ask("b", "e.loaded"), true);
    await visitor.ask("b", "(e.src = '')");
    await eventually(async () => assert.equal(visitor.page.workers().length, 0));
  });

  it("that are moved stay open; those that return open again", async () => {
    await visitor.show(site, `${body}<section></section>`);
    await visitor.loaded("a", "b");
    await visitor.ask("a", "document.querySelector('section').append(e)");
    await visitor.page.waitForTimeout(200);
    assert.equal(await visitor.ask("a", "e.loaded"), true);
    assert.equal((await visitor.events("load", "a")).length, 1);
    await visitor.page.evaluate(async () => {
      const element = document.querySelector("#a");
      element.remove();
      await new Promise((done) => setTimeout(done, 100));
      document.querySelector("section").append(element);
    });
    await eventually(async () => assert.equal((await visitor.events("load", "a")).length, 2));
    assert.equal(visitor.page.workers().length, 2);
  });

  it("that are removed while they load leave no worker, and send nothing", async () => {
    await visitor.show(site, `<section></section>`);
    for (const wait of [0, 30, 120, 400]) {
      await visitor.page.evaluate(async (milliseconds) => {
        const element = /** @type {any} */ (document.createElement("svt-viewer"));
        Object.assign(element, { id: "a", src: "house.gml", loading: "eager" });
        document.querySelector("section").append(element);
        await new Promise((done) => setTimeout(done, milliseconds));
        element.remove();
      }, wait);
      await eventually(async () => assert.equal(visitor.page.workers().length, 0, `after ${wait} ms`));
    }
    await visitor.page.waitForTimeout(500);
    assert.equal(visitor.page.workers().length, 0);
    assert.deepEqual(await visitor.events("error"), []);
  });
});

describe("the page around", () => {
  it("keeps its styles, names, title, address and scrolling", async () => {
    await visitor.show(site, `<p>Text</p><section></section>${kFar}`);
    const read = () =>
      visitor.page.evaluate(() => ({
        title: document.title,
        address: location.href,
        lang: document.documentElement.lang,
        classes: document.documentElement.className + document.body.className,
        sheets: document.styleSheets.length + document.adoptedStyleSheets.length,
        head: document.head.outerHTML,
        body: document.body.children.length,
        stored: Object.keys(localStorage).length,
        text: getComputedStyle(document.querySelector("p")).font + getComputedStyle(document.body).overflow,
        variable: getComputedStyle(document.documentElement).getPropertyValue("--accent"),
        names: Object.keys(globalThis).filter((name) => /svt|viewer/i.test(name)),
      }));
    const before = await read();
    await visitor.page.evaluate(() => {
      document.querySelector("section").innerHTML = '<svt-viewer id="a" src="house.svt"></svt-viewer>';
    });
    await visitor.loaded("a");
    assert.deepEqual(await read(), before);
    const box = await visitor.page.locator("#a").boundingBox();
    await visitor.page.mouse.move(box.x + 100, box.y + 100);
    await visitor.page.mouse.wheel(0, 300);
    await eventually(async () => assert.ok((await visitor.page.evaluate(() => scrollY)) > 200, "the wheel scrolls the page"));
    await visitor.page.evaluate(() => scrollTo(0, 0));
    await visitor.ask("a", "e.focus()");
    const camera = await visitor.ask("a", "e.getCamera()");
    await eventually(async () => {
      await visitor.page.mouse.wheel(0, -240);
      assert.notDeepEqual((await visitor.ask("a", "e.getCamera()")).eye, camera.eye);
    });
    assert.equal(await visitor.page.evaluate(() => scrollY), 0, "with the focus, the wheel zooms");
  });

  it("has a keyboard stop for it, with the keys of the page", async () => {
    await visitor.show(site, `<button>before</button><svt-viewer id="a" src="house.svt"></svt-viewer><button>after</button>`);
    await visitor.loaded("a");
    const focused = () => visitor.page.evaluate(() => document.activeElement.id || document.activeElement.textContent);
    await visitor.page.keyboard.press("Tab");
    await visitor.page.keyboard.press("Tab");
    assert.equal(await focused(), "a");
    const before = await visitor.ask("a", "e.getCamera()");
    await visitor.page.keyboard.press("ArrowLeft");
    await eventually(async () => assert.notDeepEqual((await visitor.ask("a", "e.getCamera()")).eye, before.eye));
    await visitor.page.keyboard.press("2");
    await eventually(async () => {
      const { eye, target } = await visitor.ask("a", "e.getCamera()");
      assert.ok(Math.abs(eye[0] - target[0]) < 1e-6 && eye[1] < target[1], "from the front");
    });
    await visitor.page.keyboard.press("Enter");
    await eventually(async () => assert.equal((await visitor.ask("a", "e.selection")).length, 1));
    await visitor.page.keyboard.press("Escape");
    await eventually(async () => assert.equal((await visitor.ask("a", "e.selection")).length, 0));
    await visitor.page.keyboard.press("Tab");
    assert.equal(await focused(), "after");
  });

  it("may change its size", async () => {
    await visitor.show(site, `<svt-viewer id="a" src="house.svt"></svt-viewer>`);
    await visitor.loaded("a");
    await visitor.ask("a", "Object.assign(e.style, { width: '500px', height: '150px' })");
    await eventually(async () => assert.deepEqual((await visitor.ask("a", "e.scene()")).size, [500, 150]));
  });

  it("finds no fault with it by axe", async () => {
    await visitor.show(
      site,
      `<h1>House</h1><svt-viewer id="a" src="house.svt" section="z>1.6"></svt-viewer><svt-viewer id="b" src="none.svt"></svt-viewer><svt-viewer id="c" src="house.svt" controls="off" alt="The house"></svt-viewer>`,
    );
    await visitor.loaded("a", "c");
    await eventually(async () => assert.equal((await visitor.events("error", "b")).length, 1));
    await visitor.page.evaluate(readFileSync(`${repository}/web/viewer/node_modules/axe-core/axe.min.js`, "utf8"));
    const { violations } = await visitor.page.evaluate(() => /** @type {any} */ (window).axe.run());
    assert.deepEqual(
      violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`),
      [],
    );
  });

  it("speaks German to it", async () => {
    await visitor.show(site, `<div lang="de"><svt-viewer id="a" src="none.svt"></svt-viewer></div>`);
    await eventually(async () => assert.match((await visitor.events("error"))[0].detail.message, /konnte nicht geladen werden/));
  });
});

describe("servers", () => {
  it("that allow only what the manual says are sufficient", async () => {
    const strict = await serve({ headers: { "Content-Security-Policy": kPolicy, "X-Content-Type-Options": "nosniff" } });
    await visitor.show(strict, `<svt-viewer id="a" src="house.svt" section="z>1.6" names="class=BuildingRoom"></svt-viewer>`);
    await visitor.loaded("a");
    assert.deepEqual(visitor.problems, []);
    await strict.close();
  });

  it("that do not allow WebAssembly get an error that says it", async () => {
    const strict = await serve({ headers: { "Content-Security-Policy": kPolicy.replace(" 'wasm-unsafe-eval'", "") } });
    await visitor.show(strict, `<svt-viewer id="a" src="house.svt"></svt-viewer>`);
    const [{ detail }] = await eventually(async () => {
      const found = await visitor.events("error");
      assert.ok(found.length > 0);
      return found;
    });
    assert.equal(detail.code, "E999");
    assert.match(detail.message, /WebAssembly/);
    await strict.close();
  });

  it("that isolate their pages get threads", async (t) => {
    if (cpus().length < 2) return t.skip("this machine has one core");
    const isolated = await serve({
      headers: { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" },
    });
    await visitor.show(isolated, `<svt-viewer id="a" src="house.svt"></svt-viewer>`);
    await visitor.loaded("a");
    assert.equal((await visitor.events("load"))[0].detail.threads, Math.min(8, cpus().length));
    assert.ok(asked(isolated).includes("svt_view_threads.wasm"));
    await isolated.close();
  });

  it("may get the scripts from another site, and the model from a third", async () => {
    const open = { "Access-Control-Allow-Origin": "*" };
    const [scripts, models] = [await serve({ headers: open }), await serve({ headers: open })];
    const head = `<link rel="stylesheet" href="/page.css"><script src="/events.js"></script>
      <script type="module" src="${scripts.url}${kElement.slice(1)}"></script>`;
    await visitor.show(site, `<svt-viewer id="a" src="${models.url}house.svt"></svt-viewer>`, { head });
    await visitor.loaded("a");
    assert.deepEqual(asked(scripts), ["svt-viewer.js", "svt_view.wasm", "viewing.js", "worker.js"]);
    assert.deepEqual(visitor.problems, []);
    const closed = await serve();
    await visitor.ask("a", "(e.src = v)", `${closed.url}house.svt`);
    await eventually(async () => assert.match((await visitor.events("error")).at(-1).detail.message, /CORS/));
    for (const server of [scripts, models, closed]) await server.close();
  });

  it("may deliver a city in ranges", async () => {
    svt("sample", "city", "-o", at("files"), "--buildings", "40", "--quiet");
    svt("city", "plan", at("files"), "-o", at("town"), "--spacing", "1", "--quiet");
    svt("city", "run", at("town"), "--quiet");
    await visitor.show(site, `<svt-viewer id="a" src="town/"></svt-viewer>`);
    await visitor.loaded("a");
    assert.equal((await visitor.ask("a", "e.info")).buildings, 40);
    assert.ok((await visitor.snapshot("a")).length > 2000);
  });
});
