// The web component in a plain page, from the packed files: its pictures against those of the command.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { before, describe, it } from "node:test";
import { svt } from "../../../web/viewer/e2e/harness.mjs";
import { readPng } from "../../../web/viewer/e2e/png.mjs";
import { at, eventually, makeHouse, putShared, serve, Visitor } from "./site.mjs";

const visitor = new Visitor();
let site;
before(async () => {
  makeHouse();
  putShared();
  site = await serve();
});

const kCamera = ["--eye", "-9,-8,11", "--target", "6,5,2.5"];
const kPlaced = 'eye="-9,-8,11" target="6,5,2.5"';
/** The picture of the command. */
function drawn(...words) {
  svt("render", at("house.svt"), "-o", at("command.png"), "--quiet", ...words);
  return readFileSync(at("command.png"));
}
const quoted = (text) => text.replaceAll("&", "&amp;").replaceAll('"', "&quot;");

/** The pixels on the screen are those of a picture of the command. */
async function shows(id, png) {
  const wanted = readPng(png);
  await eventually(async () => {
    const seen = readPng(await visitor.screen(id));
    assert.deepEqual([seen.width, seen.height], [wanted.width, wanted.height]);
    let differing = 0;
    for (let n = 0; n < wanted.width * wanted.height; ++n)
      for (let c = 0; c < 3; ++c) differing += seen.data[n * seen.channels + c] === wanted.data[n * wanted.channels + c] ? 0 : 1;
    assert.equal(differing, 0, `${differing} samples of ${wanted.width * wanted.height * 3} differ`);
  });
}

describe("a page with one element", () => {
  it("shows the pixels of the command, and says that it has loaded", async () => {
    await visitor.show(
      site,
      `<svt-viewer id="a" src="house.svt" controls="off" ${kPlaced} section="y<5" hide="class=BuildingRoom"></svt-viewer>`,
    );
    await visitor.loaded("a");
    const [{ detail }] = await visitor.events("load");
    assert.equal(detail.threads, 1);
    assert.ok(detail.info.features.length > 50);
    assert.equal((await visitor.events("load")).length, 1);
    await shows("a", drawn("--size", "320x200", ...kCamera, "--section", "y<5", "--hide", "class=BuildingRoom"));
    assert.deepEqual(await visitor.events("error"), []);
    assert.deepEqual(visitor.problems, []);
  });

  it("shows other pixels when an attribute changes, without loading again", async () => {
    await visitor.ask("a", "(e.section = 'z>1.6', e.look = 'paper')");
    await shows("a", drawn("--size", "320x200", ...kCamera, "--section", "z>1.6", "--hide", "class=BuildingRoom", "--look", "paper"));
    assert.equal(await visitor.ask("a", "e.getAttribute('section')"), "z>1.6");
    assert.equal((await visitor.events("load")).length, 1);
  });

  it("gives the scene of its picture", async () => {
    await visitor.ask("a", "(e.camera = 'front', e.removeAttribute('eye'), e.removeAttribute('target'), e.ortho = true)");
    const scene = await eventually(async () => {
      const now = await visitor.ask("a", "e.scene({ width: 400 })");
      assert.equal(now.camera.parallel, true);
      return now;
    });
    assert.deepEqual(scene.size, [400, 250]);
    writeFileSync(at("a.scene.json"), JSON.stringify(scene));
    assert.ok((await visitor.snapshot("a", { width: 400 })).equals(drawn("--scene", at("a.scene.json"))));
    const { eye, target, parallel } = await visitor.ask("a", "e.getCamera()");
    assert.ok(parallel && Math.abs(eye[0] - target[0]) < 1e-6 && eye[1] < target[1], "from the front");
  });
});

describe("attributes", () => {
  /**
   * Attributes, and the same as words of the command.
   * @type {[Record<string, string>, string[]][]}
   */
  const kSame = [
    [{ section: "z=1.6 or 1,1,0,-12" }, ["--section", "z=1.6", "--section", "1,1,0,-12"]],
    [{ section: "storey=Upper floor+1.2" }, ["--section", "storey=Upper floor+1.2"]],
    [{ cut: "ball(6,3,3,3)", section: "z>5" }, ["--section", "z>5", "--cut", "ball(6,3,3,3)"]],
    [{ show: "class=BuildingRoom", "color-by": "volume" }, ["--show", "class=BuildingRoom", "--color-by", "volume"]],
    [
      { show: "class=BuildingRoom", opacity: "class=BuildingRoom:0.8" },
      ["--show", "class=BuildingRoom", "--opacity", "class=BuildingRoom:0.8"],
    ],
    [{ opacity: "all:0.06", color: 'name="Hidden beam":red' }, ["--opacity", "all:0.06", "--color", 'name="Hidden beam":red']],
    [{ highlight: "class=Window", look: "dark" }, ["--highlight", "class=Window", "--look", "dark"]],
    [
      { highlight: "class=BuildingRoom and name~Living", context: "shell" },
      ["--highlight", "class=BuildingRoom and name~Living", "--context", "shell"],
    ],
    [{ cutaway: 'name="Hidden beam"', hide: "class=BuildingRoom" }, ["--cutaway", 'name="Hidden beam"', "--hide", "class=BuildingRoom"]],
    [
      { lens: "view(0.5,0.5,0.35)", section: "y<5", hide: "class=BuildingRoom" },
      ["--lens", "view(0.5,0.5,0.35)", "--section", "y<5", "--hide", "class=BuildingRoom"],
    ],
    [{ shell: "storey", section: "z>4" }, ["--shell", "storey", "--section", "z>4"]],
    [{ wireframe: "", "hidden-lines": "dashed" }, ["--hidden-lines", "dashed", "--wireframe"]],
    [{ hatch: "", section: "y<5", hide: "class=BuildingRoom" }, ["--hatch", "--section", "y<5", "--hide", "class=BuildingRoom"]],
    [{ names: "class=BuildingRoom", section: "z>1.6" }, ["--names", "class=BuildingRoom", "--section", "z>1.6"]],
    [{ background: "#cfe8ff", "north-arrow": "" }, ["--background", "#cfe8ff", "--north-arrow"]],
    [{ transparent: "" }, ["--transparent"]],
    [{ fov: "60" }, ["--fov", "60"]],
  ];

  it("draw the bytes of the options with the same names", async () => {
    await visitor.show(site, `<svt-viewer id="a" src="house.svt" ${kPlaced}></svt-viewer>`);
    await visitor.loaded("a");
    for (const [attributes, words] of kSame) {
      await visitor.ask("a", "Object.entries(v).forEach(([name, value]) => e.setAttribute(name, value))", attributes);
      const seen = await visitor.snapshot("a");
      assert.ok(seen.equals(drawn("--size", "320x200", ...kCamera, ...words)), JSON.stringify(attributes));
      await visitor.ask("a", "v.forEach((name) => e.removeAttribute(name))", Object.keys(attributes));
    }
    assert.ok((await visitor.snapshot("a")).equals(drawn("--size", "320x200", ...kCamera)), "and without them the plain picture");
    assert.deepEqual(await visitor.events("error"), []);
  });

  it("hold from the first picture on", async () => {
    const [[sections], [, , , , styles]] = [kSame, kSame];
    const text = (/** @type {[Record<string, string>, string[]]} */ [attributes]) =>
      Object.entries(attributes)
        .map(([name, value]) => `${name}="${quoted(value)}"`)
        .join(" ");
    await visitor.show(
      site,
      `<svt-viewer id="a" src="house.svt" ${kPlaced} controls="off" ${text(sections)}></svt-viewer>
       <svt-viewer id="b" src="house.svt" ${kPlaced} controls="off" ${text(styles)}></svt-viewer>`,
    );
    await visitor.loaded("a", "b");
    await shows("a", drawn("--size", "320x200", ...kCamera, ...sections[1]));
    await shows("b", drawn("--size", "320x200", ...kCamera, ...styles[1]));
  });

  it("are properties, also those set before the element is defined", async () => {
    await visitor.show(site, "", { head: '<link rel="stylesheet" href="/page.css"><script src="/events.js"></script>' });
    const seen = await visitor.page.evaluate(async (script) => {
      const element = /** @type {any} */ (document.createElement("svt-viewer"));
      element.id = "a";
      element.colorBy = "storey";
      element.scaleBar = true;
      element.src = "house.svt";
      document.querySelector("main").append(element);
      await import(script);
      const names = /** @type {any} */ (customElements.get("svt-viewer")).observedAttributes.filter((name) => name !== "lang");
      const untied = names.filter((name) => {
        const property = name.replace(/-(\w)/g, (_, letter) => letter.toUpperCase());
        const other = /** @type {any} */ (document.createElement("svt-viewer"));
        const isFlag = typeof other[property] === "boolean";
        other[property] = isFlag ? true : "x";
        const isSet = other.getAttribute(name) === (isFlag ? "" : "x");
        other.setAttribute(name, "y");
        const isGot = other[property] === (isFlag ? true : "y");
        other[property] = isFlag ? false : "";
        return !(isSet && isGot && !other.hasAttribute(name));
      });
      return { untied, colorBy: element.getAttribute("color-by"), scaleBar: element.hasAttribute("scale-bar"), count: names.length };
    }, "/node_modules/@semantic-volume-texture/viewer/dist/svt-viewer.js");
    assert.deepEqual(seen, { untied: [], colorBy: "storey", scaleBar: true, count: 34 });
    await visitor.loaded("a");
    assert.equal((await visitor.ask("a", "e.scene()")).colorBy, "storey");
  });

  it("of the theme follow the page around, or say it themselves", async () => {
    const body = `<svt-viewer id="a" src="house.svt"></svt-viewer>
      <div style="color-scheme: dark"><svt-viewer id="b" src="house.svt"></svt-viewer></div>
      <svt-viewer id="c" src="house.svt" theme="dark"></svt-viewer>`;
    await visitor.show(site, body);
    await visitor.loaded("a", "b", "c");
    const looks = () => Promise.all(["a", "b", "c"].map(async (id) => (await visitor.ask(id, "e.scene()")).look ?? "plain"));
    assert.deepEqual(await looks(), ["plain", "dark", "dark"]);
    await visitor.ask("c", "(e.theme = 'light')");
    assert.deepEqual(await looks(), ["plain", "dark", "plain"]);
  });
});

describe("events", () => {
  before(async () => {
    await visitor.show(site, `<svt-viewer id="a" src="house.svt" ${kPlaced} hide="class=BuildingRoom"></svt-viewer>`);
    await visitor.loaded("a");
  });

  it("name the object under a click, which is the one that the command labels there", async () => {
    writeFileSync(at("a.scene.json"), JSON.stringify(await visitor.ask("a", "e.scene()")));
    svt("render", at("house.svt"), "-o", at("command.png"), "--quiet", "--scene", at("a.scene.json"), "--labels", at("labels.png"));
    const labels = readPng(readFileSync(at("labels.png")));
    const box = await visitor.page.locator("#a").boundingBox();
    let clicks = 0;
    for (const [x, y] of [
      [160, 100],
      [110, 90],
      [200, 80],
      [2, 2],
    ]) {
      await visitor.page.mouse.click(box.x + x, box.y + y);
      const picks = await eventually(async () => {
        const all = await visitor.events("pick");
        assert.ok(all.length > clicks);
        return all;
      });
      const { pick, x: px, y: py } = picks.at(-1).detail;
      assert.deepEqual([Math.round(px), Math.round(py)], [x, y]);
      assert.equal(pick?.scalar ?? 0, labels.data[y * labels.width + x], `at ${x}, ${y}`);
      const asked = await visitor.ask("a", "e.pick(v[0] + 0.5, v[1] + 0.5)", [x, y]);
      assert.equal(asked?.id ?? "", pick?.id ?? "");
      await eventually(async () => assert.deepEqual(await visitor.ask("a", "e.selection"), pick ? [pick.id] : []));
      ++clicks;
    }
  });

  it("of a click keep the selection if the page prevents it", async () => {
    await visitor.ask("a", "e.select('class=Window')");
    const before = await visitor.ask("a", "e.selection");
    assert.ok(before.length > 3);
    const count = (await visitor.events("pick")).length;
    await visitor.ask("a", "e.addEventListener('pick', (event) => event.preventDefault(), { once: true })");
    const box = await visitor.page.locator("#a").boundingBox();
    await visitor.page.mouse.click(box.x + 160, box.y + 100);
    await eventually(async () => assert.equal((await visitor.events("pick")).length, count + 1));
    assert.deepEqual(await visitor.ask("a", "e.selection"), before);
  });

  it("report the camera, which the mouse and programs move", async () => {
    const box = await visitor.page.locator("#a").boundingBox();
    const camera = await visitor.ask("a", "e.getCamera()");
    await visitor.page.mouse.move(box.x + 100, box.y + 100);
    await visitor.page.mouse.down();
    await visitor.page.mouse.move(box.x + 160, box.y + 110, { steps: 4 });
    await visitor.page.mouse.up();
    await eventually(async () => {
      const last = (await visitor.events("camerachange")).at(-1)?.detail.camera;
      assert.ok(last && last.eye.some((v, i) => Math.abs(v - camera.eye[i]) > 0.1));
    });
    await visitor.ask("a", "e.setCamera(v)", { eye: [1, -20, 3], target: [6, 5, 2] });
    assert.deepEqual((await visitor.ask("a", "e.getCamera()")).eye, [1, -20, 3]);
    await visitor.ask("a", "e.goTo('top', 'class=Window')");
    const above = await visitor.ask("a", "e.getCamera()");
    assert.ok(Math.abs(above.eye[0] - above.target[0]) < 1e-6 && above.eye[2] > above.target[2]);
  });

  it("report errors with code and message, which are visible until they are mended", async () => {
    const text = () =>
      visitor.page.evaluate(() => document.querySelector("#a").shadowRoot.querySelector("[role=alert]:not([hidden])")?.textContent ?? "");
    await visitor.ask("a", "(e.hide = 'class=')");
    const [query] = await eventually(async () => {
      const found = await visitor.events("error");
      assert.ok(found.length > 0);
      return found;
    });
    assert.match(query.detail.code, /^E\d+$/);
    assert.match(await text(), new RegExp(query.detail.code));
    await visitor.ask("a", "(e.hide = 'class=BuildingRoom')");
    await eventually(async () => assert.equal(await text(), ""));
    await visitor.ask("a", "(e.look = 'fancy')");
    await eventually(async () => assert.match(await text(), /look="fancy": use one of plain, paper, blueprint, dark/));
    assert.equal((await visitor.events("error")).at(-1).detail.code, "E904");
  });

  it("report a file that is not there, and the next one that is", async () => {
    const loads = (await visitor.events("load")).length;
    await visitor.ask("a", "(e.removeAttribute('look'), e.src = 'none.svt')");
    await eventually(async () =>
      assert.match((await visitor.events("error")).at(-1).detail.message, /none\.svt could not be loaded \(404\)/),
    );
    assert.equal(await visitor.ask("a", "e.loaded"), false);
    assert.equal(await visitor.ask("a", "e.snapshot().catch((error) => error instanceof Error && error.code)"), "E904");
    await visitor.ask("a", "(e.src = 'events.js')");
    await eventually(async () => assert.match((await visitor.events("error")).at(-1).detail.code, /^E\d+$/));
    await visitor.ask("a", "(e.src = 'house.gml')");
    await eventually(async () => assert.equal((await visitor.events("load")).length, loads + 1));
    assert.ok((await visitor.events("progress")).some(({ detail }) => detail.share > 0 && detail.text !== ""));
    assert.equal((await visitor.ask("a", "e.info")).hasEdges, true);
  });

  it("report the properties, drawings and files that programs ask for", async () => {
    const [id] = await visitor.ask("a", "e.select('class=BuildingRoom')");
    assert.equal((await visitor.ask("a", "e.properties(v)", id)).id, id);
    const drawing = await visitor.ask("a", "e.drawing('z=1.2').then((b) => b.text())");
    svt("section", at("house.gml"), "--plane", "z=1.2", "-o", at("plan.svg"), "--quiet");
    assert.equal(drawing, readFileSync(at("plan.svg"), "utf8"));
    await visitor.ask("a", "fetch('house.svt').then((r) => r.blob()).then((b) => e.open(new File([b], 'mine.svt')))");
    await visitor.loaded("a");
    assert.equal((await visitor.ask("a", "e.info")).spacing[0].toFixed(2), "0.15");
    await visitor.ask("a", "e.open(new File(['x'], 'notes.txt'))");
    assert.match((await visitor.events("error")).at(-1).detail.message, /notes\.txt is not a volume or building model/);
  });
});
