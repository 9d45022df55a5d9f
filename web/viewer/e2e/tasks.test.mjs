// Ten tasks of visitors from begin to end, by mouse, by keyboard and on a phone, with the number of clicks, keys and taps
// (web/viewer/README.md lists them). SVT_SHOTS=FOLDER keeps a picture of the page after each task.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { serve, svt, svtServe, withModels } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const { at, drop } = scratch("svt-tasks-test-");
const visit = new Visit();
const { inPage, state, settled, eventually, stage } = visit;
let server, city;

/** The tower, and the house 60 m east of it. */
function buildCity() {
  mkdirSync(at("files"));
  svt("sample", "tower", "--storeys", "3", "-o", at("files/tower.gml"));
  const house = readFileSync(at("house.gml"), "utf8");
  writeFileSync(
    at("files/house.gml"),
    house.replace(/\b(?:499|500)\d{3}(?:\.\d+)?(?= 5[34]\d{5})/g, (east) => String(Number(east) + 60)),
  );
  svt("city", "plan", at("files"), "-o", at("town"), "--spacing", "0.3");
  svt("city", "run", at("town"));
}

before(async () => {
  for (const [sample, spacing] of [
    ["house", "0.12"],
    ["tower", "0.3"],
  ]) {
    svt("sample", sample, "-o", at(`${sample}.gml`));
    svt("build", at(`${sample}.gml`), "-o", at(`${sample}.svt`), "--spacing", spacing, "--vectors", "edges,meshes");
  }
  buildCity();
  server = await serve(withModels(["house", "tower"].map((name) => ({ name, path: at(`${name}.svt`), title: name }))));
  city = await svtServe(at("town"));
});
after(async () => {
  await visit.close();
  await server?.close();
  await city?.close();
  drop();
});

const kDesk = { viewport: { width: 1200, height: 640 } };
const kPhone = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 3, isMobile: true, hasTouch: true };
const kFolder = process.env.SVT_SHOTS ?? "";
let device = "desk";
/** The device and the model of the open page, and its first view. */
let opened = "",
  first = null;
/** Clicks, keys or taps of the task, besides typed words. */
let steps = 0;

/** Begins a task with a model as it was opened. The page stays, because opening one takes longer than a task. */
async function begin(model = "house") {
  if (opened !== `${device} ${model}`) {
    await visit.open(model === "town" ? city.url : `${server.url}?model=${model}`, device === "phone" ? kPhone : kDesk);
    if (model === "town") await visit.until("s.model.city?.isComplete");
    await settled();
    opened = `${device} ${model}`;
    first = await state();
    // Printing waits for a person.
    await visit.page.evaluate(() => {
      window.print = () => void (globalThis.printed = true);
    });
  } else {
    await inPage(
      `(() => {
        const app = document.querySelector("svt-app");
        s.view.endWalking();
        Object.assign(s.view, { tool: null, aim: null });
        s.selection.select([]);
        s.view.set(v);
        void s.view.fit(s.view.aspect);
        s.messages.message = null;
        app.renderRoot.querySelector("svt-tree")?.find("");
        Object.assign(app, { isTreeShown: !app.isNarrow, isSelectionShown: !app.isNarrow });
        for (let at = document; at?.activeElement; at = at.activeElement.shadowRoot) at.activeElement.blur();
      })()`,
      first,
    );
    await visit.page.waitForTimeout(50);
    await settled();
  }
  steps = 0;
}

/** The task is done: within a number of steps, without a message of an error, and with a picture. */
async function done(name, most, of = "clicks") {
  await settled();
  assert.equal(await inPage("s.messages.message"), null);
  assert.ok(steps <= most, `${steps} ${of}, at most ${most}`);
  if (kFolder) await visit.page.screenshot({ path: join(kFolder, `${device}-${name}.png`), scale: "css" });
}

const found = (target) => (typeof target === "string" ? visit.page.locator(target).first() : target);
/** One click on an element, or on a place of the picture; a tap on a phone. */
const click = async (target, options = {}) => {
  ++steps;
  return device === "phone" ? found(target).tap(options) : found(target).click(options);
};
const clickAt = async (x, y, options = {}) => {
  ++steps;
  const box = await stage();
  const place = [box.x + box.width * x, box.y + box.height * y];
  return device === "phone" ? visit.page.touchscreen.tap(...place) : visit.page.mouse.click(...place, options);
};
/** A finger that rests for a moment, on an element or on a place of the window. */
async function hold(target, until = () => visit.page.waitForTimeout(700)) {
  ++steps;
  const box = Array.isArray(target) ? null : await found(target).boundingBox();
  const [x, y] = box ? [box.x + box.width / 2, box.y + box.height / 2] : target;
  const session = await visit.page.context().newCDPSession(visit.page);
  await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
  await until();
  await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await session.detach();
}
const holdAt = async (x, y) => {
  const box = await stage();
  await hold([box.x + box.width * x, box.y + box.height * y]);
};
const type = (words) => visit.page.keyboard.type(words);
const keys = async (...all) => {
  for (const key of all) {
    ++steps;
    await visit.page.keyboard.press(key);
  }
};
/** Finds an action in the palette: two keys besides the words. */
const act = async (words) => {
  await keys("Control+k");
  await visit.page.locator("svt-palette input:focus").waitFor();
  await type(words);
  await keys("Enter");
};
const button = (name) => visit.page.getByRole("button", { name, exact: true });
const row = (name) => visit.page.getByRole("treeitem", { name });
const item = (name) => visit.page.getByRole("menuitem", { name });
/** A place of the picture with an object of this name. */
const placeOf = (name) =>
  inPage(
    "(async () => { for (let y = 0.15; y < 0.9; y += 0.03) for (let x = 0.15; x < 0.9; x += 0.03) { const p = await s.volume.engine.pick(x, y); if (p?.name.startsWith(v)) return [x, y]; } })()",
    name,
  );
const hasEffect = (name) => eventually(async () => assert.equal((await state()).effect, name));
const isSelected = (...ids) => eventually(async () => assert.deepEqual((await state()).selection, ids));
const isMeasured = (n) => eventually(async () => assert.equal((await state()).measured.length, n));
const isKept = (n) => eventually(async () => assert.equal(await visit.page.locator("svt-bookmark-list li").count(), n));
const isComparison = async () => {
  await visit.page.locator("#comparison").waitFor();
  assert.equal((await state()).selection.length, 2);
};
/** The place of the eye changes while something acts. */
const isWalking = async (act) => {
  await eventually(async () => assert.equal((await state()).camera.fieldOfView, 65));
  const { eye } = (await state()).camera;
  await act(() => eventually(async () => assert.notDeepEqual((await state()).camera.eye, eye)));
};
/** The browser prints one page per sheet, of its size, small enough to send, and within the policy. */
async function isPrinted() {
  await visit.page.waitForFunction(() => globalThis.printed);
  const sheets = await visit.page.locator("#printed > img").count();
  assert.ok(sheets >= 3, `${sheets} sheets`);
  const pdf = (await visit.page.pdf({ preferCSSPageSize: true })).toString("latin1");
  assert.ok(pdf.length < 3_000_000, `${pdf.length} bytes`);
  assert.deepEqual(visit.problems, []);
  const boxes = [...pdf.matchAll(/\/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)\s*\]/g)].map(([, width, height]) => [width, height].map(Number));
  assert.equal(boxes.length, sheets);
  for (const [width, height] of boxes)
    assert.ok(Math.abs((width * 25.4) / 72 - 420) < 1 && Math.abs((height * 25.4) / 72 - 297) < 1, `${width} x ${height} points`);
}
const savedBcf = async (act) => assert.equal((await visit.saved(act)).name, "views.bcf");

/** Tasks that differ only in how a control is pressed. */
function tasksByPointing() {
  it("saves plans on sheets as PDF, by 2", async () => {
    await begin();
    await click("#tool-section");
    await click("#print-sheets");
    await isPrinted();
    await done("sheets", 2);
  });

  it("colours rooms by area, by 2", async () => {
    await begin();
    await click("#tool-look");
    ++steps;
    await visit.page.selectOption("#color-by", "area");
    await settled();
    assert.equal((await state()).colorBy, "area");
    await done("area", 2);
  });

  it("looks through a lens, by 1", async () => {
    await begin();
    await click("#tool-lens");
    await hasEffect("lens");
    await done("lens", 1);
  });

  it("passes three views on as BCF, by 7", async () => {
    await begin();
    await click("#tool-share");
    for (const [n, view] of [null, "1,0,0", "1,0,1"].entries()) {
      if (view) await click(`svt-view-cube path[data-direction="${view}"]`);
      await settled();
      await click("#keep-view");
      await isKept(n + 1);
    }
    await savedBcf(() => click("#export-bcf"));
    await done("bcf", 7);
  });

  it("measures a room in its plan, by 6", async () => {
    await begin();
    await click("#tool-section");
    await click(button("Cut Ground floor at 1.1 m"));
    await click('svt-view-cube path[data-direction="0,0,1"]');
    await click("#tool-measure");
    await settled();
    await clickAt(0.4, 0.4);
    await isMeasured(1);
    await clickAt(0.6, 0.4);
    await isMeasured(2);
    assert.match(await visit.page.locator("#measured-length").innerText(), / m$/);
    await done("measure", 6);
  });
}

describe("by mouse", () => {
  before(() => (device = "desk"));
  tasksByPointing();

  it("saves plans as SVG, by 2 clicks", async () => {
    await begin();
    await click("#tool-section");
    const { name } = await visit.saved(() => click("#draw-sheets"));
    assert.equal(name, "sheets.zip");
    await done("svg", 2);
  });

  it("finds the beam and cuts to it, by 3 clicks", async () => {
    await begin();
    await click("#search");
    await type("hidden beam");
    await click(row("Hidden beam"));
    await click(button("Cut away to it"));
    await hasEffect("cutaway");
    await done("beam", 3);
  });

  it("hides the roof, by 2 clicks", async () => {
    await begin();
    const [x, y] = await placeOf("Roof slab");
    await clickAt(x, y, { button: "right" });
    await click(item("Hide"));
    assert.equal((await state()).hide.length, 2);
    await done("roof", 2);
  });

  it("walks, by 2 clicks and a key", async () => {
    await begin();
    await click("#tool-views");
    await click("#walk");
    await isWalking(async (moved) => {
      ++steps;
      await visit.page.keyboard.down("w");
      await moved();
      await visit.page.keyboard.up("w");
    });
    await done("walk", 3);
  });

  it("compares two flats, by 3 clicks", async () => {
    await begin("tower");
    await click("#search");
    await type("BuildingUnit");
    await click(row("BuildingUnit").nth(0));
    await click(row("BuildingUnit").nth(1), { modifiers: ["Control"] });
    await isComparison();
    await done("flats", 3);
  });

  it("shows one flat of a city, by 3 clicks", async () => {
    await begin("town");
    await click("#search");
    await type("S01 Flat 2");
    await click(row("S01 Flat 2").first());
    await click(button("Highlight"));
    await hasEffect("highlight");
    await done("city", 3);
  });
});

describe("by keyboard", () => {
  before(() => (device = "keys"));

  it("finds the beam and cuts to it, with 4 keys besides the words", async () => {
    await begin();
    await keys("/");
    await type("hidden beam");
    await keys("Enter");
    await isSelected("house_hidden_beam");
    await act("cut away");
    await hasEffect("cutaway");
    await done("beam", 4, "keys");
    await act("section box");
    await eventually(async () => assert.equal((await state()).sections.length, 6));
    await keys("h");
    assert.equal((await state()).hide.length, 2);
  });

  it("measures a room in its plan by a cross, with 9 keys", async () => {
    await begin();
    await act("cut ground floor");
    await keys("6");
    await settled();
    await keys("m");
    await visit.page.locator("svt-aim .layer:focus").waitFor();
    await keys("Enter");
    await isMeasured(1);
    await keys("ArrowRight", "ArrowRight", "ArrowRight", "Enter");
    await isMeasured(2);
    const [from, to] = (await state()).measured;
    assert.ok(to[0] - from[0] > 0.5, `${to} is right of ${from}`);
    await done("measure", 9, "keys");
    // The first Escape gives the keys back to the picture, the second ends the tool.
    await keys("Escape");
    await visit.page.locator("svt-picture .stage:focus").waitFor();
    assert.equal(await inPage("s.view.tool"), "measure");
    await keys("Escape");
    assert.equal(await inPage("s.view.tool"), null);
  });

  it("saves plans on sheets as PDF, with 2 keys besides the words", async () => {
    await begin();
    await act("print");
    await isPrinted();
    await done("sheets", 2, "keys");
  });

  it("colours rooms by area, with 2 keys besides the words", async () => {
    await begin();
    await act("colour by floor area");
    await eventually(async () => assert.equal((await state()).colorBy, "area"));
    await done("area", 2, "keys");
    await act("colour by own colours");
    await eventually(async () => assert.equal((await state()).colorBy, ""));
  });

  it("gives the keys to the picture after an action", async () => {
    await begin();
    const eye = async () => (await state()).camera.eye;
    const begun = await eye();
    await act("views: front");
    await eventually(async () => assert.notDeepEqual(await eye(), begun));
    await visit.page.locator("svt-picture .stage:focus").waitFor();
    const front = await eye();
    await keys("ArrowLeft");
    assert.notDeepEqual(await eye(), front);
  });

  it("enters a tool by its key, and comes back by Escape", async () => {
    await begin();
    await keys("k");
    await visit.page.locator("svt-look-tool [role=radio]:focus").first().waitFor();
    await keys("ArrowRight");
    assert.equal((await state()).look, "paper");
    await keys("Escape");
    await visit.page.locator("svt-picture .stage:focus").waitFor();
  });

  it("hides a roof by its name, with 3 keys besides the name", async () => {
    await begin();
    await keys("/");
    await type("roof slab");
    await keys("Enter");
    await isSelected("house_roof_south");
    await keys("h");
    await eventually(async () => assert.equal((await state()).hide.length, 2));
    await done("roof", 3, "keys");
  });

  it("replaces the words of the last search", async () => {
    await begin();
    await keys("/");
    await type("roof slab");
    await keys("Enter", "/");
    await type("hidden beam");
    await keys("Enter");
    await isSelected("house_hidden_beam");
  });

  it("walks, with 2 keys", async () => {
    await begin();
    await keys("g");
    await isWalking(async (moved) => {
      ++steps;
      await visit.page.keyboard.down("w");
      await moved();
      await visit.page.keyboard.up("w");
    });
    await done("walk", 2, "keys");
  });

  it("looks through a lens, with 1 key", async () => {
    await begin();
    await keys("c");
    await hasEffect("lens");
    await done("lens", 1, "keys");
  });

  it("passes three views on as BCF, with 8 keys besides the words", async () => {
    await begin();
    await keys("b", "Enter");
    await isKept(1);
    for (const view of [2, 3]) {
      await keys(String(view));
      await settled();
      await keys("Enter");
      await isKept(view);
    }
    await savedBcf(() => act("BCF 3.0"));
    await done("bcf", 8, "keys");
  });

  it("compares two flats, with 3 keys besides the words", async () => {
    await begin("tower");
    await keys("/");
    await type("BuildingUnit");
    await keys("Enter", "Shift+ArrowDown");
    await isComparison();
    await done("flats", 3, "keys");
  });

  it("shows one flat of a city, with 4 keys besides the words", async () => {
    await begin("town");
    await keys("/");
    await type("S01 Flat 2");
    await keys("Enter");
    await eventually(async () => assert.equal((await state()).selection.length, 1));
    await act("highlight");
    await hasEffect("highlight");
    await done("city", 4, "keys");
  });
});

describe("on a phone", () => {
  before(() => (device = "phone"));
  tasksByPointing();

  it("finds the beam and cuts to it, by 4 taps", async () => {
    await begin();
    await click(button("Show or hide: Parts"));
    await click("#search");
    await type("hidden beam");
    await hold(row("Hidden beam"));
    await click(item("Cut away to it"));
    await hasEffect("cutaway");
    await done("beam", 4, "taps");
  });

  it("hides the roof, by 2 taps", async () => {
    await begin();
    const [x, y] = await placeOf("Roof slab");
    await holdAt(x, y);
    await click(item("Hide"));
    assert.equal((await state()).hide.length, 2);
    await done("roof", 2, "taps");
  });

  it("walks, by 3 taps", async () => {
    await begin();
    await click("#tool-views");
    await click("#walk");
    await isWalking((moved) => hold("svt-walk-pad [data-key=w]", moved));
    await done("walk", 3, "taps");
  });

  it("compares two flats, by 6 taps", async () => {
    await begin("tower");
    await click(button("Show or hide: Parts"));
    await click("#search");
    await type("BuildingUnit");
    await hold(row("BuildingUnit").nth(0));
    await click(item("Select several"));
    await click(row("BuildingUnit").nth(1));
    await click(button("Show or hide: Selection"));
    await isComparison();
    await done("flats", 6, "taps");
    await click("#more button");
    assert.equal(await inPage("s.selection.isMore"), false);
  });

  it("shows one flat of a city, by 4 taps", async () => {
    await begin("town");
    await click(button("Show or hide: Parts"));
    await click("#search");
    await type("S01 Flat 2");
    await hold(row("S01 Flat 2").first());
    await click(item("Highlight"));
    await hasEffect("highlight");
    await done("city", 4, "taps");
  });
});
