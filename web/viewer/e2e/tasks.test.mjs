// Tasks of visitors from begin to end, by mouse and by keyboard, with the number of clicks (web/viewer/README.md lists them).
import assert from "node:assert/strict";
import { after, before, describe, it } from "node:test";
import { serve, svt, withModels } from "./harness.mjs";
import { scratch, Visit } from "./visit.mjs";

const { at, drop } = scratch("svt-tasks-test-");
const visit = new Visit();
const { inPage, state, settled, eventually, stage } = visit;
let server;
before(async () => {
  for (const sample of ["house", "tower"]) {
    svt("sample", sample, "-o", at(`${sample}.gml`));
    svt(
      "build",
      at(`${sample}.gml`),
      "-o",
      at(`${sample}.svt`),
      "--spacing",
      sample === "house" ? "0.12" : "0.3",
      "--vectors",
      "edges,meshes",
    );
  }
  server = await serve(withModels(["house", "tower"].map((name) => ({ name, path: at(`${name}.svt`), title: name }))));
});
after(async () => {
  await visit.close();
  await server?.close();
  drop();
});

let clicks = 0;
/** One click on an element, or on a place of the picture. */
const click = async (target, options = {}) => {
  ++clicks;
  if (typeof target !== "string") return target.click(options);
  return visit.page.locator(target).first().click(options);
};
const clickAt = async (x, y, options = {}) => {
  ++clicks;
  const box = await stage();
  await visit.page.mouse.click(box.x + box.width * x, box.y + box.height * y, options);
};
const button = (name) => visit.page.getByRole("button", { name });
const keys = async (...all) => {
  for (const key of all) await visit.page.keyboard.press(key);
};
/** Finds an action in the palette. */
const act = async (words) => {
  await keys("Control+k");
  await visit.page.locator("svt-palette input:focus").waitFor();
  await visit.page.keyboard.type(words);
  await keys("Enter");
};
const begin = async (model = "house") => {
  await visit.open(`${server.url}?model=${model}`);
  await settled();
  clicks = 0;
};
const clicked = (most) => assert.ok(clicks <= most, `${clicks} clicks, at most ${most}`);
/** A place of the picture with an object of this name. */
const placeOf = (name) =>
  inPage(
    "(async () => { for (let y = 0.15; y < 0.9; y += 0.03) for (let x = 0.15; x < 0.9; x += 0.03) { const p = await s.volume.engine.pick(x, y); if (p?.name.startsWith(v)) return [x, y]; } })()",
    name,
  );

describe("by mouse", () => {
  it("finds the beam and cuts to it, by 3 clicks", async () => {
    await begin();
    await click("#search");
    await visit.page.keyboard.type("hidden beam");
    await click(visit.page.getByRole("treeitem", { name: "Hidden beam" }));
    await click(button("Cut away to it"));
    assert.equal((await state()).effect, "cutaway");
    await settled();
    assert.equal(await inPage("s.messages.message"), null);
    clicked(3);
  });

  it("compares two flats, by 3 clicks", async () => {
    await begin("tower");
    await click("#search");
    await visit.page.keyboard.type("BuildingUnit");
    const rows = visit.page.getByRole("treeitem", { name: "BuildingUnit" });
    await click(rows.nth(0));
    await click(rows.nth(1), { modifiers: ["Control"] });
    await visit.page.locator("#comparison").waitFor();
    clicked(3);
  });

  it("measures a room in its plan, by 6 clicks", async () => {
    await begin();
    await click("#tool-section");
    await click(button("Cut Ground floor at 1.1 m"));
    await click('svt-view-cube path[data-direction="0,0,1"]');
    await click("#tool-measure");
    await settled();
    await clickAt(0.4, 0.4);
    await eventually(async () => assert.equal((await state()).measured.length, 1));
    await clickAt(0.6, 0.4);
    await eventually(async () => assert.equal((await state()).measured.length, 2));
    assert.match(await visit.page.locator("#measured-length").innerText(), / m$/);
    clicked(6);
  });

  it("saves plans on sheets, by 2 clicks", async () => {
    await begin();
    await click("#tool-section");
    const { name } = await visit.saved(() => click("#draw-sheets"));
    assert.equal(name, "sheets.zip");
    clicked(2);
  });

  it("colours rooms by area, by 2 clicks", async () => {
    await begin();
    await click("#tool-look");
    ++clicks;
    await visit.page.selectOption("#color-by", "area");
    await settled();
    assert.equal((await state()).colorBy, "area");
    assert.equal(await inPage("s.messages.message"), null);
    clicked(2);
  });

  it("hides the roof, by 2 clicks", async () => {
    await begin();
    const [x, y] = await placeOf("Roof slab");
    await clickAt(x, y, { button: "right" });
    await click(visit.page.getByRole("menuitem", { name: "Hide" }));
    assert.equal((await state()).hide.length, 2);
    clicked(2);
  });

  it("walks, by 2 clicks", async () => {
    await begin();
    await click("#tool-views");
    await click("#walk");
    await eventually(async () => assert.equal((await state()).camera.fieldOfView, 65));
    const { eye } = (await state()).camera;
    await visit.page.keyboard.down("w");
    await eventually(async () => assert.notDeepEqual((await state()).camera.eye, eye));
    await visit.page.keyboard.up("w");
    clicked(2);
  });

  it("looks through a lens, by 1 click", async () => {
    await begin();
    await click("#tool-lens");
    assert.equal((await state()).effect, "lens");
    await settled();
    clicked(1);
  });

  it("passes three views on as BCF, by 7 clicks", async () => {
    await begin();
    await click("#tool-share");
    for (const [n, view] of [null, "1,0,0", "1,0,1"].entries()) {
      if (view) await click(`svt-view-cube path[data-direction="${view}"]`);
      await settled();
      await click("#keep-view");
      await eventually(async () => assert.equal(await visit.page.locator("svt-bookmark-list li").count(), n + 1));
    }
    const { name } = await visit.saved(() => click("#export-bcf"));
    assert.equal(name, "views.bcf");
    clicked(7);
  });

  it("shows one flat of a building, by 3 clicks", async () => {
    await begin("tower");
    await click("#search");
    await visit.page.keyboard.type("BuildingUnit");
    await click(visit.page.getByRole("treeitem", { name: "BuildingUnit" }).first());
    await click(button("Highlight"));
    await settled();
    assert.equal((await state()).effect, "highlight");
    clicked(3);
  });
});

describe("by keyboard", () => {
  it("finds the beam and cuts to it, hides it, boxes it", async () => {
    await begin();
    await keys("/");
    await visit.page.keyboard.type("hidden beam");
    await keys("Enter");
    await eventually(async () => assert.deepEqual((await state()).selection, ["house_hidden_beam"]));
    await act("cut away");
    assert.equal((await state()).effect, "cutaway");
    await act("section box");
    await eventually(async () => assert.equal((await state()).sections.length, 6));
    await keys("h");
    assert.equal((await state()).hide.length, 2);
    assert.equal(clicks, 0);
  });

  it("colours rooms by area, with 2 keys besides the words", async () => {
    await begin();
    await act("colour by floor area");
    await eventually(async () => assert.equal((await state()).colorBy, "area"));
    await act("colour by own colours");
    await eventually(async () => assert.equal((await state()).colorBy, ""));
    assert.equal(clicks, 0);
  });

  it("hides a roof by its name, with 3 keys besides the name", async () => {
    await begin();
    await keys("/");
    await visit.page.keyboard.type("roof slab");
    await keys("Enter");
    await eventually(async () => assert.deepEqual((await state()).selection, ["house_roof_south"]));
    await keys("h");
    await eventually(async () => assert.equal((await state()).hide.length, 2));
    assert.equal(clicks, 0);
  });

  it("highlights one unit of a building, with 5 keys besides the words", async () => {
    await begin("tower");
    await keys("/");
    await visit.page.keyboard.type("BuildingUnit");
    await keys("ArrowDown", "Enter");
    await eventually(async () => assert.equal((await state()).selection.length, 1));
    await act("highlight");
    await eventually(async () => assert.equal((await state()).effect, "highlight"));
    assert.equal(clicks, 0);
  });

  it("compares two flats, walks, looks through a lens, and keeps views as BCF", async () => {
    await begin("tower");
    await keys("/");
    await visit.page.keyboard.type("BuildingUnit");
    await keys("ArrowDown", "Enter", "Shift+ArrowDown");
    await visit.page.locator("#comparison").waitFor();
    await keys("g");
    await eventually(async () => assert.equal(await inPage("s.view.isWalking"), true));
    await keys("0", "c");
    assert.equal((await state()).effect, "lens");
    await keys("Escape");
    await act("bookmark this view");
    await eventually(async () => assert.equal(await visit.page.locator("svt-bookmark-list li").count(), 1));
    const { name } = await visit.saved(() => act("BCF 3.0"));
    assert.equal(name, "views.bcf");
    assert.equal(clicks, 0);
  });
});
